// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a sample that has just come in may not bring along, put right once, before anybody looks at it:
//
//   counts   a count larger than its array can hold describes nothing: it becomes 0, so that no loop leaves the array
//            and no such sample passes for a whole one
//   texts    control characters and broken UTF-8 become '?' (idl/printable.h)
//
// Real-time safe: yes for the types without texts.

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine_health.h"
#include "idl/printable.h"

namespace ehm::idl {

namespace tidying {

template <class Count, std::size_t Size, class Element>
void limit(Count& count, const std::array<Element, Size>&) {
  if (count > Size) count = 0;
}

template <class FixedString>
void clean(FixedString& text) {
  const std::string received = text.c_str();
  if (std::string tidy = printable(received); tidy != received) text = tidy.c_str();
}

template <class Channels>
void clean_all(Channels& channels) {
  for (auto& channel : channels) {
    clean(channel.name());
    clean(channel.unit());
  }
}

}  // namespace tidying

template <class Sample>
void tidy(Sample& s) {
  using namespace tidying;
  if constexpr (requires { s.sensor(); }) limit(s.sensor_count(), s.sensor());
  if constexpr (requires { s.actuator(); }) limit(s.actuator_count(), s.actuator());
  if constexpr (requires { s.health(); }) limit(s.health_count(), s.health());
  if constexpr (requires { s.auxiliary(); }) limit(s.auxiliary_count(), s.auxiliary());
  if constexpr (requires { s.tuner(); }) limit(s.tuner_count(), s.tuner());
  if constexpr (requires { s.innovation(); }) limit(s.sensor_count(), s.innovation());
  if constexpr (requires { s.sensors(); }) {
    limit(s.sensor_count(), s.sensors());
    limit(s.actuator_count(), s.actuators());
    clean_all(s.sensors());
    clean_all(s.actuators());
    clean_all(s.health());
    clean_all(s.auxiliary());
    clean(s.engine_type());
    clean(s.design_hash());
  }
  if constexpr (requires { s.message(); }) clean(s.message());
  if constexpr (requires { s.channel_name(); }) clean(s.channel_name());
}

}  // namespace ehm::idl
