#pragma once
// A user's mistake with a file, as one message: file, line or key, value, what is allowed. Programs end with
// exit_usage.

#include <stdexcept>

namespace ehm::files {

class FileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace ehm::files
