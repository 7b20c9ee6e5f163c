// SPDX-License-Identifier: Apache-2.0
#pragma once
// Are the files of an identity what they should be, and do they belong together? Everything that DDS Security would
// find out later, without the name of a file: a certificate outside its time, a key of another certificate, an
// authority or a list that cannot be read, rules that the authority has not signed.
//
// @throws DdsError naming the file, what is wrong with it, and the remedy.

#include <cstdint>
#include <string>

namespace ehm::idl {

struct IdentityFacts {
  std::int64_t expires_s = 0;  ///< seconds since 1970: the certificate's notAfter
  std::string fingerprint;     ///< SHA-256 in hex of all files: another one means another identity, rule or revocation
};

/// Reads and verifies all files of `directory`.
IdentityFacts examine_identity(const std::string& directory);
}  // namespace ehm::idl
