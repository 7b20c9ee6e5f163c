// SPDX-License-Identifier: Apache-2.0
#pragma once
// A user's mistake with a file, as one message: file, line or key, value, what is allowed. Programs end with
// exit_usage.

#include <stdexcept>
#include <string>

namespace ehm::files {

class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// "FILE: KEY is VALUE; allowed: ALLOWED. REMEDY."
[[noreturn]] inline void throw_defect(const std::string& file, const std::string& key, const std::string& value,
                                      const std::string& allowed, const std::string& remedy) {
  throw FileError(file + ": " + key + " is " + value + "; allowed: " + allowed + ". " + remedy + ".");
}

}  // namespace ehm::files
