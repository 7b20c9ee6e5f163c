// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine's checkpoint: the state of its cycle, and to which engine, design and moment it belongs.
//
// As a file: JSON, schema "ehm-checkpoint/3", numbers in shortest exact form, and the SHA-256 of the content without
// the hash itself, as in a design file. Anyone may read it; nobody should edit it. Earlier versions are
// read too: "ehm-checkpoint/2", without bias_return and in which no companion has a key learned, and
// "ehm-checkpoint/1", which has no companions and no held_samples.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "monitor/cycle/cycle_state.h"

namespace ehm::monitor {

inline constexpr std::array<std::string_view, 3> checkpoint_schemas{"ehm-checkpoint/1", "ehm-checkpoint/2",
                                                                    "ehm-checkpoint/3"};
inline constexpr std::string_view checkpoint_schema = checkpoint_schemas.back();

struct Checkpoint {
  std::uint32_t engine_id = 0;
  std::string design_hash;        ///< of the design that flew
  std::int64_t wall_time_ns = 0;  ///< our clock when the state was taken, nanoseconds since 1970
  CycleState state;
};

std::string to_text(const Checkpoint& checkpoint);

/// `file` is only named in messages. What it returns is finite and within capacity, whatever the text; whether it fits
/// a design is for MonitorCycle::resume to say.
/// @throws files::FileError (file, key, value, allowed) if the text is not complete JSON, of another schema, damaged
///         (hash), or a value is out of its range.
Checkpoint parse_checkpoint(std::string_view text, const std::string& file);

}  // namespace ehm::monitor
