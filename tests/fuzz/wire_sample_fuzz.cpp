// SPDX-License-Identifier: Apache-2.0
// The path of a sample from the bytes on the wire: whatever deserialises as EngineSensors is converted and flown, and
// what the cycle makes of it is converted back.

#include "idl/dds/guarded_type.h"
#include "monitor/dds/convert.h"
#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/published.h"
#include "tests/fuzz/small_design.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  constexpr std::uint32_t largest = 1024;  // a message of the type has 256 bytes
  const auto design = fuzz::small_design();
  static const monitor::MonitorCycle fresh(design, monitor::CycleOptions{});
  monitor::MonitorCycle cycle = fresh;
  static idl::GuardedType<EngineSensorsPubSubType> type;
  eprosima::fastrtps::rtps::SerializedPayload_t payload(largest);
  EngineSensors message;
  monitor::Sample sample;
  fuzz::ByteReader bytes(data, size);
  while (!bytes.empty()) {
    // Each message: its length, then encapsulation and fields.
    const auto body = bytes.rest(std::min<std::size_t>(bytes.take<std::uint16_t>(), largest));
    payload.length = static_cast<std::uint32_t>(body.size());
    std::copy(body.begin(), body.end(), payload.data);
    if (!type.deserialize(&payload, &message)) continue;
    monitor::convert(message, sample);
    if (cycle.process(sample)) {
      EngineHealth health;
      EngineAuxiliary auxiliary;
      EngineResiduals residuals;
      const monitor::Stamp stamp{message.engine_id(), 1, sample.sequence, sample.source_time_ns, 0};
      monitor::convert(cycle.result().estimate, cycle.result().flags, stamp, health);
      monitor::convert(cycle.result().estimate, cycle.result().flags, stamp, auxiliary);
      monitor::convert(cycle.result(), stamp, residuals);
    }
    fuzz::require_promises(cycle);
    cycle.clear_events();
  }
  return 0;
}
