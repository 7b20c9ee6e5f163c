// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/reporter.h"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <chrono>

#include "deploy/runtime/service/last_catch.h"
#include "deploy/runtime/service/notify.h"
#include "idl/printable.h"
#include "idl/wire_values.h"
#include "monitor/dds/convert.h"
#include "monitor/dds/convert_flight.h"
#include "monitor/dds/misfit_text.h"
#include "monitor/dds/order_reply.h"
#include "monitor/history/history_text.h"
#include "monitor/realtime/clock.h"
#include "monitor/service/event_text.h"

namespace ehm::monitor {

namespace {
constexpr std::chrono::milliseconds poll{5};  // how late an event may be reported
constexpr double drain_s = 0.25;              // how long a stop waits for subscribers to hear the last status

void say_malformed(const CycleReport& report) {
  const Malformed& m = report.malformed;
  const auto& model = report.design->model;
  spdlog::warn(
      "engine {}: a sample of source {} cannot be used: schema {} with {} sensors and {} actuators; needed are schema "
      "{}, {} sensors and {} actuators ({} so far)",
      report.engine_id, m.source_id, m.schema, m.sensor_count, m.actuator_count, idl::schema_version,
      model.sensors.size(), model.controls.size(), m.so_far);
}

const linear_model::Channel& design_channel(const SourceChannel& c, const linear_model::LinearModel& model) {
  return c.channel < EHM_MAX_SENSORS ? model.sensors.at(c.channel) : model.controls.at(c.channel - EHM_MAX_SENSORS);
}

/// What takes the published estimator away is an error, any other condition that begins a warning.
spdlog::level::level_enum severity(const HealthEvent& event) {
  const auto kind = static_cast<idl::EventKind>(event.kind());
  if (event.raised() == 0 || kind == idl::EventKind::estimator_chosen) return spdlog::level::info;
  const bool estimator = kind == idl::EventKind::estimator_fallback || kind == idl::EventKind::estimator_overrun;
  return estimator ? spdlog::level::err : spdlog::level::warn;
}

std::string channel_text(const SourceChannel& c, const linear_model::LinearModel& model) {
  const bool sensor = c.channel < EHM_MAX_SENSORS;
  const char* what = sensor ? "sensor" : "actuator";
  if (!c.raised)
    return fmt::format("{} {} of source {} fits the design", what, design_channel(c, model).name, c.source_id);
  return misfit_text(what, sensor ? c.channel : c.channel - EHM_MAX_SENSORS, c.said.words(),
                     "source " + std::to_string(c.source_id), sensor ? model.sensors : model.controls, c.misfit) +
         (c.misfit == Misfit::name ? "; it is used" : "; it is not used");
}

std::string engine_text(const SourceChannel& c, const linear_model::LinearModel& model) {
  if (!c.raised) return fmt::format("the engine of source {} is the design's, {}", c.source_id, model.engine_type);
  return fmt::format("the engine is {} by source {}, {} by the design: what is estimated is another engine's",
                     c.said.words().name, c.source_id, model.engine_type);
}

}  // namespace

Reporter::Reporter(idl::Participant& participant, std::uint32_t source_id, CycleReportQueue& queue,
                   NoticeBoard& notices, FlightBoard& flights, InputWatch& input, StatusBoard& board,
                   service::TurnCounter& turns)
    : unreadable_(participant.unreadable()),
      source_id_(source_id),
      queue_(queue),
      notices_(notices),
      flights_(flights),
      input_(input),
      board_(board),
      turns_(turns),
      events_(participant),
      status_(participant),
      descriptions_(participant),
      summaries_(participant),
      replies_(participant),
      thread_([this] { run(); }) {}

Reporter::~Reporter() {
  stop_.store(true, std::memory_order_release);
  thread_.join();
  if (status_.drain(drain_s)) events_.drain(drain_s);  // a reader that does not answer is waited for once
}

void Reporter::run() {
  // The flag is read before the queue: what was queued before the stop is still reported.
  for (bool last = false; !last;) {
    last = stop_.load(std::memory_order_acquire);
    service::survive("reporter", [this] {
      while (report_next()) {
      }
      report_notices();
      report_overflow();
    });
    turns_.turned();
    if (!last) std::this_thread::sleep_for(poll);
  }
}

void Reporter::await_reported(const service::TurnCounter& turns) {
  // The turn that ends next may have looked at the queue before; the one after it has not.
  const std::uint64_t enough = turns.turns() + 2;
  while (turns.turns() < enough) std::this_thread::sleep_for(poll);
}

bool Reporter::report_next() {
  CycleReport report;
  if (!queue_.pop(report)) return false;
  switch (report.kind) {
    case CycleReport::Kind::event:
      report_event(report);
      break;
    case CycleReport::Kind::status:
      // Before the status: who has heard of it on DDS finds both in the metrics.
      board_.post(report.engine_id, report.design->model, report.estimates);
      report_status(report.status);
      break;
    case CycleReport::Kind::malformed:
      say_malformed(report);
      break;
    case CycleReport::Kind::source_channel:
      report_source_channel(report);
      break;
    case CycleReport::Kind::new_engine:
      report_new_engine(report);
      break;
    case CycleReport::Kind::engine_left:
      report_left(report);
      break;
    case CycleReport::Kind::reply:
      report_reply(report);
      break;
    case CycleReport::Kind::unknown_engine:
      spdlog::warn(
          "engine {}: no design serves it ({} samples refused so far); name it in an [[engine]] table or raise "
          "monitor.max_engines",
          report.engine_id, report.sequence);
      break;
  }
  return true;
}

void Reporter::report_new_engine(const CycleReport& report) {
  const EngineDescription description = describe(*report.design, report.engine_id, source_id_);
  descriptions_.write(description);
  board_.post(description);
  spdlog::info("engine {}: samples arrive, design {:.12s} flies", report.engine_id, report.design->hash);
  if (left_.erase(report.engine_id) == 0) return;
  CycleReport back = report;
  back.event = {.kind = idl::EventKind::engine_left};
  report_event(back);
}

/// Its event stays for who joins late; status and description end.
void Reporter::report_left(const CycleReport& report) {
  constexpr std::size_t most_left = 65536;  // engines come and go for years
  if (left_.size() < most_left) left_.insert(report.engine_id);
  board_.remove(report.engine_id);
  MonitorStatus status;
  status.engine_id(report.engine_id);
  status.source_id(source_id_);
  status_.release(status);
  descriptions_.release(describe(*report.design, report.engine_id, source_id_));
}

void Reporter::report_reply(const CycleReport& report) {
  const CommandReply reply = reply_to(report.engine_id, report.outcome, source_id_);
  replies_.write(reply);
  const bool accepted = reply.accepted() != 0;
  const std::int64_t now_ns = monotonic_ns();
  refusals_ += !accepted;
  if (!accepted && now_ns - refusal_told_ns_ < 1'000'000'000) return;  // whoever floods us must not fill the log
  if (!accepted) refusal_told_ns_ = now_ns;
  spdlog::log(accepted ? spdlog::level::info : spdlog::level::warn, "order {} for engine {} is {}: {}{}",
              reply.request(), reply.engine_id(), accepted ? "carried out" : "refused", reply.message().c_str(),
              accepted || refusals_ == 1 ? "" : fmt::format(" ({} refused since the last of these lines)", refusals_));
  if (!accepted) refusals_ = 0;
}

void Reporter::report_event(const CycleReport& report) {
  const Event& event = report.event;
  const std::string text = event_text(event, report.design->model);
  HealthEvent wire_event;
  wire_event.engine_id(report.engine_id);
  wire_event.kind(static_cast<std::uint32_t>(event.kind));
  wire_event.channel(event.channel);
  wire_event.raised(event.raised ? 1 : 0);
  wire_event.sequence_number(report.sequence);
  wire_event.source_time_ns(report.source_time_ns);
  wire_event.value(event.value);
  wire_event.threshold(event.threshold);
  wire_event.channel_name() = channel_name(event, report.design->model).c_str();
  wire_event.message() = text.c_str();
  publish(wire_event);
}

void Reporter::report_source_channel(const CycleReport& report) {
  const SourceChannel& c = report.source_channel;
  const auto& model = report.design->model;
  if (c.converted > 0) {
    const linear_model::Channel& own = design_channel(c, model);
    spdlog::info("engine {}: {} channels of source {} are converted to the design's units, the first {} from {} to {}",
                 report.engine_id, c.converted, c.source_id, own.name, idl::printable(std::string(c.said.words().unit)),
                 own.unit);
    return;
  }
  HealthEvent event;
  event.engine_id(report.engine_id);
  event.kind(static_cast<std::uint32_t>(idl::EventKind::source_channels));
  event.channel(c.channel);
  event.raised(c.raised ? 1 : 0);
  event.sequence_number(report.sequence);
  event.source_time_ns(report.source_time_ns);
  event.value(static_cast<double>(c.source_id));
  const bool channel = c.channel != SourceChannel::engine_type;
  if (channel) event.channel_name() = design_channel(c, model).name.c_str();
  event.message() = idl::printable(channel ? channel_text(c, model) : engine_text(c, model)).c_str();
  publish(event);
}

void Reporter::report_notices() {
  const std::int64_t now_ns = monotonic_ns();
  input_.settle(now_ns);
  if (now_ns - unreadable_told_ns_ >= 1'000'000'000) {
    unreadable_told_ns_ = now_ns;
    unreadable_.tell();
  }
  for (const Notice& notice : notices_.take()) say(notice);
  for (const SummedFlight& summed : flights_.take()) report_flight(summed);
}

void Reporter::report_flight(const SummedFlight& summed) {
  FlightSummary summary;
  convert(summed.flight, summary);
  summary.engine_id(summed.engine_id);
  summary.source_id(source_id_);
  board_.post(summary);  // before the wire: who has heard of it finds it in the metrics
  summaries_.write(summary);
  spdlog::info("engine {}: {}", summed.engine_id, flight_line(summed.flight));
}

void Reporter::report_status(MonitorStatus& status) {
  status.input_deadline_misses(input_.deadline_misses());
  status.input_liveliness_losses(input_.liveliness_losses());
  status.reports_lost(status.reports_lost() + notices_.lost());
  const bool changed = board_.post(status);  // before the wire: who has heard of it finds it in the metrics
  status_.write(status);
  if (changed) service::notify_status(board_.summary());
}

void Reporter::say(const Notice& notice) {
  HealthEvent event;
  event.engine_id(notice.engine_id);
  event.kind(static_cast<std::uint32_t>(notice.kind));
  event.raised(notice.raised ? 1 : 0);
  event.source_time_ns(wall_clock_ns());
  event.value(notice.value);
  event.threshold(notice.threshold);
  event.message() = idl::printable(notice.text).c_str();
  publish(event);
}

void Reporter::publish(HealthEvent& event) {
  event.source_id(source_id_);
  event.schema(idl::schema_version);
  board_.post(event);  // before the wire: who has heard of it finds it in the metrics
  events_.write(event);
  const std::string whom =
      event.engine_id() == 0 ? std::string() : "engine " + std::to_string(event.engine_id()) + ": ";
  spdlog::log(severity(event), "{}{}", whom, event.message().c_str());
}

void Reporter::report_overflow() {
  if (const std::uint64_t overflow = queue_.overflow(); overflow != overflow_said_) {
    spdlog::error("{} events did not fit the queue and are lost; the reporter thread is starved", overflow);
    overflow_said_ = overflow;
  }
}

}  // namespace ehm::monitor
