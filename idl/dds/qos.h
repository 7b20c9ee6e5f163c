// SPDX-License-Identifier: Apache-2.0
#pragma once
// The project's delivery classes as DDS policies, one place for both services, the demo and the examples.
//
// Streams are reliable and keep last; a reader that falls further behind than the depth loses the oldest, and sees it
// by the gap in sequence_number. Ownership is shared unless redundancy is asked for (architecture.md, Fixed contracts).

#include <fastdds/rtps/common/InstanceHandle.h>
#include <cstdint>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "idl/topics.h"

namespace ehm::idl {

/// How the estimates of several monitors for one engine are told apart.
struct Redundancy {
  bool exclusive = false;  ///< exclusive ownership on the estimate topics: readers see the strongest live monitor only
  std::uint32_t strength = 1;  ///< of this monitor; the higher wins
};

inline constexpr int stream_depth = 256;  ///< samples kept a key: 3.8 s at 15 ms
/// Of readers of EngineSensors. All writers of an engine share one history: a burst of another one's messages, whether
/// they can be read or not, pushes the source's samples out of it while the cycle is held up. 31 s at 15 ms.
inline constexpr int input_depth = 2048;
inline constexpr double offered_deadline_s = 0.1;  ///< readers may ask for this or longer
inline constexpr double offered_lease_s = 1.0;     ///< liveliness, automatic
inline constexpr double redundant_lease_s = 0.06;  ///< redundant profile; StandbyTest.FiftyKills prints take-overs

eprosima::fastdds::dds::DataWriterQos writer_qos(Delivery delivery, bool estimate, const Redundancy& redundancy);
eprosima::fastdds::dds::DataReaderQos reader_qos(Delivery delivery, bool estimate, const Redundancy& redundancy);

/// Asks for a deadline and for signs of life; 0 asks for nothing.
void ask(eprosima::fastdds::dds::DataReaderQos& qos, double deadline_s, double lease_s);

/// The engine of an instance: its key is short enough to be the handle itself, big endian.
std::uint32_t engine_id_of(const eprosima::fastrtps::rtps::InstanceHandle_t& instance);
/// A number that tells one writer from another; not 0.
std::uint64_t writer_number(const eprosima::fastrtps::rtps::InstanceHandle_t& publication);
/// The same for the participant that it belongs to.
std::uint64_t participant_number(const eprosima::fastrtps::rtps::InstanceHandle_t& publication);

}  // namespace ehm::idl
