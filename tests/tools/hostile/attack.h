// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a peer that means ill, or is simply broken, may put on the wire in place of a sound sensor sample. Each kind
// spoils one thing in an otherwise plausible sample, drawn from the caller's generator.

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine_health.h"

namespace ehm::test {

enum class Attack : std::size_t {
  schema,    ///< another wire schema
  counts,    ///< sensor and actuator counts that do not fit, up to the largest integer
  flight,    ///< flight condition not finite
  actuator,  ///< actuators not finite or huge
  sensor,    ///< sensors not finite, huge or denormal
  engine,    ///< engine ids that nobody serves
  sequence,  ///< sequence numbers at random and at their ends
  time,      ///< source times at random and at their ends
  bits,      ///< every field but the engine id is noise
  command,   ///< MonitorCommand of unknown kind or schema
  text,      ///< EngineDescription whose names steer terminals, with counts beyond the arrays
  reset      ///< MonitorCommand as an operator sends it, again and again
};

struct AttackName {
  Attack attack;
  const char* name;
  bool by_default = true;  ///< else only when named: what it sends is believed, and has its effect
};
const std::vector<AttackName>& attack_names();
std::optional<Attack> attack_of(const std::string& name);

/// Spoils the sample; what is no attack on samples leaves it alone.
void spoil(EngineSensors& sample, Attack attack, std::mt19937_64& random);
/// An order that no monitor should obey.
MonitorCommand bad_command(std::uint32_t engine_id, std::mt19937_64& random);
/// An order that each monitor obeys.
MonitorCommand reset_command(std::uint32_t engine_id);
/// Channels of a source, with names that clear screens, set titles, end lines, or are no UTF-8.
EngineDescription bad_description(std::uint32_t engine_id, std::uint32_t source_id, std::mt19937_64& random);

}  // namespace ehm::test
