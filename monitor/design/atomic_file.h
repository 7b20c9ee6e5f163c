#pragma once
// Replaces a file as a whole: a reader sees the old content or the new one, never a part.

#include <string>

namespace ehm::design {

/// Writes `content` to a temporary file beside `path`, flushes it to the disk and renames it.
/// @throws FileError with the system's reason if any step fails; the temporary file is then removed.
void write_file_atomically(const std::string& path, const std::string& content);

}  // namespace ehm::design
