#pragma once
// A user's mistake in a file, as one message: file, key, value, what is allowed, what to do.

#include <string>

#include "deploy/files/file_error.h"

namespace ehm::design {

using files::FileError;

/// "FILE: KEY is VALUE; allowed: ALLOWED. REMEDY."
[[noreturn]] inline void throw_defect(const std::string& file, const std::string& key, const std::string& value,
                                      const std::string& allowed, const std::string& remedy) {
  throw FileError(file + ": " + key + " is " + value + "; allowed: " + allowed + ". " + remedy + ".");
}

}  // namespace ehm::design
