// SPDX-License-Identifier: Apache-2.0
#pragma once
// Between the wire's types and the cycle's: nothing but copying.

#include <cstdint>

#include "idl/layout.h"
#include "monitor/cycle/cycle_result.h"
#include "monitor/data/sample.h"
#include "monitor/design/design.h"

namespace ehm::monitor {

/// Identity and time stamps that every message of a sample carries.
struct Stamp {
  std::uint32_t engine_id = 0, source_id = 0;
  std::uint64_t sequence = 0;
  std::int64_t source_time_ns = 0, publish_time_ns = 0;
};

/// Real-time safe: yes, all of them.
void convert(const EngineSensors& wire, Sample& sample) noexcept;
void convert(const estimation::Estimate& estimate, std::uint32_t flags, const Stamp& stamp,
             EngineHealth& wire) noexcept;
void convert(const estimation::Estimate& estimate, std::uint32_t flags, const Stamp& stamp,
             EngineAuxiliary& wire) noexcept;
void convert(const CycleResult& result, const Stamp& stamp, EngineResiduals& wire) noexcept;

/// What this monitor estimates from what; may allocate.
EngineDescription describe(const design::Design& design, std::uint32_t engine_id, std::uint32_t source_id);

}  // namespace ehm::monitor
