// SPDX-License-Identifier: Apache-2.0
#pragma once
// SHA-256 (FIPS 180-4) of a text, as 64 hexadecimal digits.

#include <string>

namespace ehm::files {

/// @throws std::runtime_error if the cryptographic library refuses.
std::string sha256_hex(const std::string& text);

}  // namespace ehm::files
