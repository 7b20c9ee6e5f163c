// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which type travels on which topic, and how: the table of topics in the README, as code.

#include "engine_healthPubSubTypes.h"

namespace ehm::idl {

/// How a topic is delivered; idl/dds/qos.h turns it into DDS policies.
enum class Delivery {
  stream,   ///< reliable, keep last, deadline and liveliness offered; exclusive ownership where redundancy is asked for
  command,  ///< reliable, keep all that was sent while matched
  state     ///< reliable, transient local: a late joiner gets the last value of each key
};

/// What a topic is to the monitor.
enum class Role {
  input,     ///< what it reads; the reader may ask for deadline and liveliness (InputRequest)
  estimate,  ///< written by redundant monitors under exclusive ownership
  other
};

template <class T>
struct Topic;

#define EHM_TOPIC(TYPE, DELIVERY, ROLE)                      \
  template <>                                                \
  struct Topic<TYPE> {                                       \
    using PubSubType = TYPE##PubSubType;                     \
    static constexpr const char* name = #TYPE;               \
    static constexpr Delivery delivery = Delivery::DELIVERY; \
    static constexpr bool estimate = ROLE == Role::estimate; \
    static constexpr bool input = ROLE == Role::input;       \
  };

EHM_TOPIC(EngineSensors, stream, Role::input)
EHM_TOPIC(EngineHealth, stream, Role::estimate)
EHM_TOPIC(EngineAuxiliary, stream, Role::estimate)
EHM_TOPIC(EngineResiduals, stream, Role::estimate)
EHM_TOPIC(EngineTruth, stream, Role::other)
EHM_TOPIC(EngineDescription, state, Role::other)
EHM_TOPIC(MonitorStatus, state, Role::other)
EHM_TOPIC(HealthEvent, state, Role::other)
EHM_TOPIC(FlightSummary, state, Role::other)
EHM_TOPIC(SimCommand, command, Role::other)
EHM_TOPIC(MonitorCommand, command, Role::other)
EHM_TOPIC(CommandReply, command, Role::other)

#undef EHM_TOPIC

}  // namespace ehm::idl
