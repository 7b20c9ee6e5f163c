// SPDX-License-Identifier: Apache-2.0
#pragma once
// Design file, JSON, schema "ehm-design/3": everything in a Design, numbers in shortest exact form (they round-trip bit
// by bit), and the SHA-256 of the content without the hash itself. Whitespace and key order do not matter to the hash.

#include <string>

#include "monitor/design/design.h"

namespace ehm::design {

inline constexpr const char* design_schema = "ehm-design/3";

/// @throws FileError (one message: file, key, value, allowed, what to do)
///         if the file is absent, not JSON, truncated, of another schema or changed by hand (hash),
///         or if a matrix has the wrong shape or a gain is unstable.
Design read_design(const std::string& path);

/// Writes to a temporary file beside `path` and renames it, so that a reader sees the old file or the new one.
/// @returns the hash that was written.
/// @throws FileError if the file cannot be written or a number is not finite.
std::string write_design(const Design& design, const std::string& path);

}  // namespace ehm::design
