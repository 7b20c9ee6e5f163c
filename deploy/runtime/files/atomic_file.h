// SPDX-License-Identifier: Apache-2.0
#pragma once
// Replaces a file as a whole: a reader sees the old content or the new one, never a part.
// The content goes to a temporary file beside the target, which commit() flushes to the disk and renames. Without
// commit() the target stays as it was and the temporary file is removed; one that a killed process has left is removed
// by the next that writes to the same target. A link is followed to its target; what is no regular file (a device, a
// pipe) cannot be replaced and is written as it is.

#include <string>
#include <string_view>

namespace ehm::files {

class AtomicFile {
 public:
  /// @throws FileError with the system's reason if it cannot be opened
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// @throws FileError with the system's reason, as does commit()
  void write(std::string_view content);
  void commit();
  /// For a program that writes to it by itself.
  int descriptor() const { return descriptor_; }

 private:
  [[noreturn]] void fail(int reason) const;

  std::string path_;       ///< as the user named it
  std::string target_;     ///< behind links
  std::string temporary_;  ///< empty: the target is written as it is
  int descriptor_ = -1;
};

/// Writes `content` to a temporary file beside `path`, flushes it to the disk and renames it.
/// @throws FileError with the system's reason if any step fails; the temporary file is then removed.
void write_file_atomically(const std::string& path, std::string_view content);

}  // namespace ehm::files
