// SPDX-License-Identifier: Apache-2.0
#pragma once
// Between the cycle and the recording's rows: nothing but copying.

#include "deploy/runtime/recording/layout.h"
#include "monitor/shared/engine_slot.h"

namespace ehm::monitor {

/// The row of the slot's latest sample; estimates only if it was `accepted` and led to some. When it was received is
/// for the caller to fill in. Real-time safe: yes.
void fill_row(const EngineSlot& slot, bool accepted, recording::Row& row) noexcept;
/// What the slot's shadow estimator of that index made of that sample, which was accepted. Real-time safe: yes.
void fill_shadow(const EngineSlot& slot, int shadow, recording::Row& row) noexcept;
/// A marker of the slot's engine; `value` stands in the column age_ns. Real-time safe: yes.
void fill_marker(const EngineSlot& slot, recording::RowKind kind, std::int64_t value, recording::Row& row) noexcept;
/// The sample that a row was made of.
void sample_of(const recording::Row& row, Sample& sample) noexcept;

/// Names and units of what a design measures and estimates.
recording::Channels recorded_channels(const design::Design& design);

}  // namespace ehm::monitor
