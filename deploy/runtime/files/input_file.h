// SPDX-License-Identifier: Apache-2.0
#pragma once
// The one way in which inputs are opened: configurations, designs, models, tables, MATLAB files, recordings,
// certificates, profiles. A path is whatever a user, a script or an attacker names, and what it leads to must neither
// block a service nor cost it its memory:
//
//   regular file   a pipe, a device, a socket or a folder is refused by name; nothing waits for who would write to it
//   size           each kind of file has its limit, also where it grows while it is read
//   time           a file that cannot be read within `patience` (a hung mount) is refused; the thread that waits for it
//                  is left behind
//
// @throws FileError "PATH: what is wrong. What to do."

#include <chrono>
#include <cstdint>
#include <string>

namespace ehm::files {

/// What kind of file is expected, and how large it may be.
struct InputKind {
  const char* name;  ///< "a configuration", for messages
  std::uint64_t most_bytes;
};
inline constexpr InputKind configuration_file{"a configuration (TOML)", 4'000'000};
inline constexpr InputKind json_file{"a JSON file", 64'000'000};
inline constexpr InputKind table_file{"a table", 4'000'000'000};
inline constexpr InputKind matlab_file{"a MATLAB file", 256u << 20u};
inline constexpr InputKind security_file{"a certificate, key or permission", 1'000'000};
inline constexpr InputKind profiles_file{"Fast DDS profiles (XML)", 4'000'000};
inline constexpr InputKind recording_file{"a recording (HDF5)", UINT64_MAX};

inline constexpr std::chrono::seconds patience{10};

/// All bytes of the file.
std::string read_input_file(const std::string& path, const InputKind& kind);

/// Verifies the same of a file that a library will open by its path.
void require_input_file(const std::string& path, const InputKind& kind);

}  // namespace ehm::files
