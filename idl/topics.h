#pragma once
// Which type travels on which topic, and how: the table of DESIGN.md as code.

#include "engine_healthPubSubTypes.h"

namespace ehm::wire {

/// How a topic is delivered; idl/dds/qos.h turns it into DDS policies.
enum class Delivery {
  stream,   ///< reliable, keep last, deadline and liveliness offered; exclusive ownership where redundancy is asked for
  command,  ///< reliable, keep all that was sent while matched
  state     ///< reliable, transient local: a late joiner gets the last value of each key
};

template <class T>
struct Topic;

#define EHM_TOPIC(TYPE, DELIVERY, ESTIMATE)                  \
  template <>                                                \
  struct Topic<TYPE> {                                       \
    using PubSubType = TYPE##PubSubType;                     \
    static constexpr const char* name = #TYPE;               \
    static constexpr Delivery delivery = Delivery::DELIVERY; \
    static constexpr bool estimate = ESTIMATE;               \
  };

// The last column: written by redundant monitors under exclusive ownership.
EHM_TOPIC(EngineSensors, stream, false)
EHM_TOPIC(EngineHealth, stream, true)
EHM_TOPIC(EngineAuxiliary, stream, true)
EHM_TOPIC(EngineResiduals, stream, true)
EHM_TOPIC(EngineTruth, stream, false)
EHM_TOPIC(EngineDescription, state, false)
EHM_TOPIC(MonitorStatus, state, false)
EHM_TOPIC(HealthEvent, state, false)
EHM_TOPIC(SimCommand, command, false)
EHM_TOPIC(MonitorCommand, command, false)

#undef EHM_TOPIC

}  // namespace ehm::wire
