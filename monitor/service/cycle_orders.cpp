// SPDX-License-Identifier: Apache-2.0
// The part of the cycle thread that obeys MonitorCommands, between two samples, and says what became of each.

#include "idl/wire_names.h"
#include "monitor/realtime/clock.h"
#include "monitor/service/cycle_thread.h"

namespace ehm::monitor {

void CycleThread::obey(const MonitorCommand& command) {
  OrderOutcome outcome{OrderOutcome::Kind::done, command.request(), command.kind()};
  outcome.kind = carry_out(command, outcome);
  if (command.request() == 0) return;
  CycleReport report{.kind = CycleReport::Kind::reply, .engine_id = command.engine_id()};
  report.outcome = outcome;
  reports_.push(report);
}

OrderOutcome::Kind CycleThread::carry_out(const MonitorCommand& command, OrderOutcome& outcome) {
  if (command.schema() != idl::schema_version) return OrderOutcome::Kind::other_schema;
  const std::string_view estimator = idl::ordered_estimator(command.kind());
  if (command.kind() != static_cast<std::uint32_t>(idl::MonitorCommandKind::reset) && estimator.empty())
    return OrderOutcome::Kind::unknown_kind;
  const auto carry_out_for = [&](EngineSlot& slot) {
    if (!estimator.empty()) return choose(estimator, slot);
    return reset(slot) ? OrderOutcome::Kind::done : OrderOutcome::Kind::too_soon;
  };
  OrderOutcome::Kind said = OrderOutcome::Kind::done;  // of several refusals the last one's reason
  engines_->for_each([&](EngineSlot& slot) {
    if (command.engine_id() != 0 && command.engine_id() != slot.engine_id) return;
    ++outcome.engines;
    const OrderOutcome::Kind kind = carry_out_for(slot);
    if (kind == OrderOutcome::Kind::done) return;
    ++outcome.refused;
    said = kind;
  });
  return outcome.engines == 0 ? OrderOutcome::Kind::not_served : said;
}

OrderOutcome::Kind CycleThread::choose(std::string_view estimator, EngineSlot& slot) {
  const Publishing became = slot.cycle.publish(estimator);
  if (became == Publishing::not_flying) return OrderOutcome::Kind::not_flying;
  if (became == Publishing::no_answer) return OrderOutcome::Kind::no_answer;
  if (became == Publishing::done && records_)
    records_->marker(slot, recording::RowKind::chosen, idl::estimator_number(estimator));
  report_events(slot);
  return OrderOutcome::Kind::done;
}

bool CycleThread::reset(EngineSlot& slot) {
  EventList changes;
  const bool obeyed = slot.resets.ask(monotonic_ns(), changes);
  for (const Event& event : changes) report_event(slot, event);
  if (!obeyed) return false;
  slot.cycle.reset();
  if (records_) records_->marker(slot, recording::RowKind::reset);
  report_events(slot);
  return true;
}

}  // namespace ehm::monitor
