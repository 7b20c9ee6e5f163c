// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/qos.h"

namespace ehm::idl {

namespace dds = eprosima::fastdds::dds;
using eprosima::fastrtps::Duration_t;

namespace {

constexpr int command_depth = 1000;
/// Keys that a reader keeps apart; each costs it some 230 bytes for good while its writer lives, so that whoever writes
/// under made-up keys must not make us grow. Four of the largest fleets, and all their events.
constexpr int stream_keys = 4096, state_keys = 65536;
constexpr int state_depth = 16;  // the last changes of a condition, for who joins late

Duration_t seconds(double s) {
  return Duration_t(static_cast<long double>(s));
}

/// The policies that a writer and a reader share.
template <class Qos>
void apply_common(Qos& qos, Delivery delivery, bool exclusive) {
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind =
      delivery == Delivery::state ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = delivery == Delivery::stream    ? stream_depth
                        : delivery == Delivery::command ? command_depth
                                                        : state_depth;
  qos.resource_limits().max_instances = 0;  // 0 is unlimited
  qos.resource_limits().max_samples = 0;
  qos.resource_limits().max_samples_per_instance = 0;
  qos.ownership().kind = exclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
  // Data sharing rejects keyed types; saying so keeps the middleware from trying.
  qos.data_sharing().off();
  // Preallocated at the largest size of the type: strings are bounded, so nothing grows while running.
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_MEMORY_MODE;
}

}  // namespace

dds::DataWriterQos writer_qos(Delivery delivery, bool estimate, const Redundancy& redundancy) {
  const bool exclusive = estimate && redundancy.exclusive;
  dds::DataWriterQos qos;
  apply_common(qos, delivery, exclusive);
  // A dead reader must not stop a service: after this the oldest sample goes, and the reader sees a gap.
  qos.reliability().max_blocking_time = seconds(0.001);
  qos.publish_mode().kind = dds::SYNCHRONOUS_PUBLISH_MODE;
  qos.reliable_writer_qos().times.heartbeatPeriod = seconds(0.02);
  if (delivery == Delivery::stream) {
    qos.deadline().period = seconds(offered_deadline_s);
    qos.liveliness().kind = exclusive ? dds::MANUAL_BY_TOPIC_LIVELINESS_QOS : dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = seconds(exclusive ? redundant_lease_s : offered_lease_s);
    qos.liveliness().announcement_period = seconds((exclusive ? redundant_lease_s : offered_lease_s) / 3.0);
  }
  // Who unregisters an instance leaves it; the instance itself may go on with another writer.
  qos.writer_data_lifecycle().autodispose_unregistered_instances = false;
  if (exclusive) qos.ownership_strength().value = redundancy.strength;
  return qos;
}

dds::DataReaderQos reader_qos(Delivery delivery, bool estimate, const Redundancy& redundancy) {
  const bool exclusive = estimate && redundancy.exclusive;
  dds::DataReaderQos qos;
  apply_common(qos, delivery, exclusive);
  qos.resource_limits().max_instances = delivery == Delivery::state ? state_keys : stream_keys;
  if (exclusive) {
    // By the estimates themselves: a monitor whose cycle hangs is passed over like one that is dead.
    qos.liveliness().kind = dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = seconds(redundant_lease_s);
  }
  return qos;
}

void ask(dds::DataReaderQos& qos, double deadline_s, double lease_s) {
  if (deadline_s > 0.0) qos.deadline().period = seconds(deadline_s);
  if (lease_s > 0.0) {
    qos.liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = seconds(lease_s);
  }
}

std::uint32_t engine_id_of(const eprosima::fastrtps::rtps::InstanceHandle_t& instance) {
  std::uint32_t id = 0;
  for (std::size_t i = 0; i < sizeof id; ++i) id = id << 8 | instance.value[i];
  return id;
}

namespace {

/// FNV-1a over the first bytes of a GUID: 12 of the participant, 4 of the writer.
std::uint64_t number_of(const eprosima::fastrtps::rtps::InstanceHandle_t& publication, std::size_t bytes) {
  std::uint64_t number = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < bytes; ++i) number = (number ^ publication.value[i]) * 0x100000001b3u;
  return number | 1u;
}

}  // namespace

std::uint64_t writer_number(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) {
  return number_of(publication, 16);
}

std::uint64_t participant_number(const eprosima::fastrtps::rtps::InstanceHandle_t& publication) {
  return number_of(publication, 12);
}

}  // namespace ehm::idl
