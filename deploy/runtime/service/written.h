// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a command prints is its result: where standard output does not take it (a full disk), the command has failed.

#include <ostream>

#include "deploy/runtime/service/exit_code.h"

namespace ehm::service {

/// `code`, or exit_failed with a line on `err` if that is success and `out` could not be written.
inline int written(int code, std::ostream& out, std::ostream& err, const char* program) {
  out.flush();
  if (out || code != exit_ok) return code;
  err << program << ": standard output cannot be written; is the disk full?\n";
  return exit_failed;
}

}  // namespace ehm::service
