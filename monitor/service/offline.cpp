// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/offline.h"

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>

#include "deploy/runtime/config/config_error.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/recording/file_reader.h"
#include "deploy/runtime/recording/row_source.h"
#include "deploy/runtime/recording/writer.h"
#include "deploy/runtime/service/stop_signal.h"
#include "idl/wire_names.h"
#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/source_fit.h"
#include "monitor/design/design_file.h"
#include "monitor/design/make_estimator.h"
#include "monitor/history/flight_keeper.h"
#include "monitor/history/history_text.h"
#include "monitor/realtime/clock.h"
#include "monitor/record/record_row.h"
#include "monitor/service/event_text.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

using files::FileError;
using recording::Row;
using recording::RowKind;

namespace {

/// How the estimates agree with those in the input.
struct Comparison {
  std::uint64_t identical = 0, different = 0;
  std::string first_difference;
};

/// Everything that was decided and estimated, but not when; bits, so that NaN equals NaN.
bool same_result(const Row& a, const Row& b) {
  const auto same = [](const auto& x, const auto& y) { return std::memcmp(&x, &y, sizeof x) == 0; };
  return a.a.accepted == b.a.accepted && a.a.estimates == b.a.estimates && a.a.flags == b.a.flags &&
         a.a.sensors_used == b.a.sensors_used && a.a.fused == b.a.fused && a.a.rejected == b.a.rejected &&
         same(a.innovation, b.innovation) && same(a.x_v, b.x_v) && same(a.x_v_sigma, b.x_v_sigma) &&
         same(a.x_v_sigma_filter, b.x_v_sigma_filter) && same(a.t, b.t) && same(a.t_sigma, b.t_sigma) &&
         same(a.t_sigma_filter, b.t_sigma_filter);
}

class OfflineRun {
 public:
  OfflineRun(const MonitorConfig& config, EngineTable& engines)
      : config_(config),
        engines_(engines),
        flights_(std::make_unique<FlightKeeper>(config, engines, notices_, summed_)),
        rows_(recording::open_rows(config.offline.file, config.offline.column_map)),
        shadows_(fmt::format("{}", fmt::join(all_shadow_names(config), ","))) {
    for (const design::Design* design : engines.designs()) {
      require_sample_time(*design);
      require_channels(*design);
    }
    recording::FileInfo info = rows_->info();
    info.recording_id = wall_clock_ns();
    info.part = 1;
    info.monitor_source_id = config.source_id;
    info.sample_time_s = engines.designs().front()->model.sample_time_s;
    info.created_by = "monitor --offline";
    info.published = config.cycle.estimator.published;
    info.shadows = shadows_;
    info.channels = recorded_channels(*engines.designs().front());
    writer_.emplace(config.offline.out, info);
    if (rows_->info().part != 1)
      spdlog::warn("{} is part {} of its recording: the filters start cold, where they did not online",
                   config.offline.file, rows_->info().part);
  }

  void run() {
    const service::StopSignal stop;
    Row row;
    while (!stop.requested() && rows_->next(row)) take(row);
    writer_->commit(true);
    flights_.reset();  // once it has summed up what has landed
    say_flights();
    summarise();
  }

 private:
  /// A column map may state the time between rows; a recording says when each came, whatever its design was made for.
  void require_sample_time(const design::Design& design) const {
    const double stated_s = config_.offline.column_map.empty() ? 0.0 : rows_->info().sample_time_s;
    const double needed_s = design.model.sample_time_s;
    if (stated_s == 0.0 || std::abs(stated_s / needed_s - 1.0) <= SampleTimeWatch::tolerance) return;
    throw FileError(
        fmt::format("{}: 'file.sample_time_s' is {}, the design {:.12s} is made for {} s, allowed is {:.0f} % more or "
                    "less: correct it, resample the table, or design for that sample time",
                    config_.offline.column_map, stated_s, design.hash, needed_s, 100.0 * SampleTimeWatch::tolerance));
  }

  /// Names must be the design's, in its order; units may be others that convert.
  void require_channels(const design::Design& design) {
    const auto expected = recorded_channels(design);
    if (expected.actuators != recorded_channels(*engines_.designs().front()).actuators ||
        expected.sensors != recorded_channels(*engines_.designs().front()).sensors)
      throw FileError(config_.offline.out + ": the designs " + engines_.designs().front()->hash.substr(0, 12) +
                      " and " + design.hash.substr(0, 12) +
                      " have different channels, a recording has one set of them");
    const auto compare = [&](const char* what, const auto& have, const auto& want) {
      bool same = have.size() == want.size();
      for (std::size_t i = 0; same && i < have.size(); ++i) same = have[i].name == want[i].name;
      if (!same)
        throw FileError(config_.offline.file + ": has the " + what + " " + list(have) + ", the design needs " +
                        list(want));
    };
    const auto& channels = rows_->info().channels;
    compare("actuators", channels.actuators, expected.actuators);
    compare("sensors", channels.sensors, expected.sensors);
    fit("actuator", channels.actuators, design.model.controls, fit_.actuators);
    fit("sensor", channels.sensors, design.model.sensors, fit_.sensors);
  }

  template <class Fits>
  void fit(const char* what, const std::vector<recording::Channel>& have,
           const std::vector<linear_model::Channel>& want, Fits& fits) const {
    for (std::size_t i = 0; i < have.size(); ++i) {
      fits[i] = fit_channel({have[i].name, have[i].unit}, want, i);
      if (!fits[i].used())
        throw FileError((config_.offline.column_map.empty() ? config_.offline.file : config_.offline.column_map) +
                        ": " + what + " " + have[i].name + " is in '" + have[i].unit + "', the design has it in '" +
                        want[i].unit + "', which cannot be converted: " + units::why_not(have[i].unit, want[i].unit));
      if (fits[i].conversion.changes())
        spdlog::info("{} {} is converted from {} to the design's {}", what, have[i].name, have[i].unit, want[i].unit);
    }
  }

  static std::string list(const std::vector<recording::Channel>& channels) {
    std::string text;
    for (const auto& channel : channels) text += (text.empty() ? "" : ", ") + channel.name;
    return text.empty() ? "none" : text;
  }

  EngineSlot& slot_of(const Row& row) {
    const auto engine_id = static_cast<std::uint32_t>(row.a.unit);
    if (EngineSlot* slot = engines_.find(engine_id)) return *slot;
    if (EngineSlot* slot = engines_.join(engine_id)) return *slot;
    throw FileError(config_.offline.file + ": engine " + std::to_string(engine_id) +
                    " finds no filter: name it in an [[engine]] table or raise monitor.max_engines (now " +
                    std::to_string(config_.max_engines) + ")");
  }

  void take(const Row& row) {
    EngineSlot& slot = slot_of(row);
    Row result;
    if (row.shadow() >= 0) return compare_shadow(row, slot);
    if (row.kind() == RowKind::sample) {
      sample_of(row, slot.sample);
      fit_.apply(slot.sample);
      if (slot.cycle.counters().received == 0) flights_->begin(slot, false);
      const bool accepted = slot.cycle.process(slot.sample);
      fill_row(slot, accepted, result);
      if (accepted) flights_->follow(slot);
      flights_->hand_over(slot);
      ++samples_;
      estimates_ += result.a.estimates != 0 && result.a.accepted != 0 ? 1 : 0;
      compare(row, result);
    } else {
      fill_marker(slot, row.kind(), row.a.age_ns, result);
      obey_marker(row, slot);
    }
    lost_ = row.a.lost_before;
    write(row, result, slot);
    for (int i = 0; result.a.accepted != 0 && i < slot.cycle.shadows(); ++i) {
      fill_shadow(slot, i, result);
      write(row, result, slot);
    }
    say_events(slot);
  }

  void write(const Row& row, Row& result, const EngineSlot& slot) {
    result.a.received_ns = row.a.received_ns;
    result.a.lost_before = row.a.lost_before;
    writer_->append(result, writer_->design_index(slot.cycle.design().hash));
    if (writer_->pending() >= commit_rows) writer_->commit(false);
  }

  /// The row of a shadow estimator follows its sample's; without the same shadows there is nothing to compare with.
  void compare_shadow(const Row& row, const EngineSlot& slot) {
    if (rows_->info().shadows != shadows_) return;
    const auto place = std::ranges::find(slot.shadow_place, row.shadow());
    if (place == slot.shadow_place.end()) return;
    Row result;
    fill_shadow(slot, static_cast<int>(place - slot.shadow_place.begin()), result);
    compare(row, result);
  }

  void obey_marker(const Row& row, EngineSlot& slot) {
    if (row.kind() == RowKind::input_lost)
      slot.cycle.no_input(1e-9 * static_cast<double>(row.a.age_ns));
    else if (row.kind() == RowKind::reset)
      slot.cycle.reset();
    else if (row.kind() == RowKind::described_anew)
      slot.cycle.reset(RestartReason::described_anew);
    else if (row.kind() == RowKind::left && engines_.may_leave(slot))
      engines_.leave(slot);
    else if (row.kind() == RowKind::chosen)
      slot.cycle.publish(named(row));
    else if (row.kind() == RowKind::rested)
      rest(row, slot);
    else
      spdlog::warn("engine {}: the filter was resumed or reloaded here, which the recording cannot repeat",
                   slot.engine_id);
  }

  /// The estimator that a marker speaks of; empty: none that this version knows.
  static std::string_view named(const Row& row) {
    const bool known = row.a.age_ns >= 0 && row.a.age_ns < static_cast<std::int64_t>(idl::estimator_names.size());
    return known ? idl::estimator_names[as_size(row.a.age_ns)] : std::string_view();
  }

  static void rest(const Row& row, EngineSlot& slot) {
    const int companion = slot.cycle.companions().find(named(row));
    if (companion >= 0) slot.cycle.rest(as_size(companion), 0.0, 0.0);
  }

  void compare(const Row& recorded, const Row& result) {
    const std::string hash = rows_->design_hash(recorded);
    if (hash.empty()) return;
    if (same_result(recorded, result)) {
      ++comparison_.identical;
    } else if (comparison_.different++ == 0) {
      comparison_.first_difference = fmt::format("engine {}, sequence {}{}", recorded.a.unit, recorded.a.sequence,
                                                 engines_.designs().front()->hash == hash ? "" : ", another design");
    }
  }

  void say_events(EngineSlot& slot) {
    for (const Event& event : slot.cycle.events())
      spdlog::info("engine {}, sequence {}: {}", slot.engine_id, slot.sample.sequence,
                   event_text(event, slot.cycle.design().model));
    slot.cycle.clear_events();
  }

  void say_flights() {
    for (const Notice& notice : notices_.take()) spdlog::warn("engine {}: {}", notice.engine_id, notice.text);
    for (const SummedFlight& summed : summed_.take())
      std::cout << fmt::format("engine {}: {}\n", summed.engine_id, flight_line(summed.flight));
  }

  void summarise() const {
    std::cout << fmt::format("{} samples, {} with estimates, in {}\n", samples_, estimates_, config_.offline.out);
    if (comparison_.identical + comparison_.different > 0)
      std::cout << fmt::format("estimates of the input: {} identical to the bit, {} different{}\n",
                               comparison_.identical, comparison_.different,
                               comparison_.different == 0 ? "" : ", first: " + comparison_.first_difference);
    if (lost_ > 0) std::cout << fmt::format("the input lacks {} rows that its recorder lost\n", lost_);
  }

  static constexpr std::size_t commit_rows = 16 * recording::Writer::chunk_rows;
  const MonitorConfig& config_;
  EngineTable& engines_;
  NoticeBoard notices_;
  FlightBoard summed_;
  std::unique_ptr<FlightKeeper> flights_;
  std::unique_ptr<recording::RowSource> rows_;
  std::optional<recording::Writer> writer_;
  SourceFit fit_;  ///< of the file's channels, to the designs'
  Comparison comparison_;
  std::string shadows_;  ///< of all engines, with commas between
  std::uint64_t samples_ = 0, estimates_ = 0;
  std::int64_t lost_ = 0;
};

}  // namespace

void choose_offline_estimator(MonitorConfig& config, bool named) {
  if (!config.offline.column_map.empty()) return;
  const std::string recorded = recording::FileReader(config.offline.file).info().published;
  EstimatorOptions& estimator = config.cycle.estimator;
  if (recorded.empty() || recorded == estimator.published) return;
  if (named) {
    spdlog::warn("{} was recorded with estimator.published = {}, {} flies as configured: other estimates than recorded",
                 config.offline.file, recorded, estimator.published);
    return;
  }
  if (design::known_name(recorded).empty())
    throw FileError(config.offline.file + ": attribute 'published' is '" + recorded + "', allowed is one of " +
                    design::known_names() + "; --estimator-published NAME flies another");
  estimator.published = recorded;
  try {
    design::shadow_names(estimator);
  } catch (const std::invalid_argument& e) {
    throw config::ConfigError("'estimator.shadow': " + std::string(e.what()) + ", since " + config.offline.file +
                              " was recorded so; --estimator-published NAME flies another");
  }
  spdlog::info("{} flies, as {} was recorded", recorded, config.offline.file);
}

static_assert(design::max_shadows == std::size_t{recording::max_shadows}, "every shadow has a kind of row");

void choose_all_estimators(MonitorConfig& config) {
  if (!config.offline.all_estimators) return;
  std::vector<design::Design> designs;
  if (!config.design.empty()) designs.push_back(design::read_design(config.design));
  for (const auto& assignment : config.engines) designs.push_back(design::read_design(assignment.design));
  std::vector<std::string> able;
  for (const design::EstimatorKind& kind : design::estimator_kinds()) {
    try {
      for (const design::Design& design : designs)
        design::make_estimator(kind.name, design, config.cycle.estimator, config.cycle.validity);
      able.emplace_back(kind.name);
    } catch (const std::invalid_argument& e) {
      spdlog::info("{} does not fly: {}", kind.name, e.what());
    }
  }
  const auto all_but = [&](const std::string& published) {
    std::vector<std::string> others = able;
    std::erase(others, published);
    return fmt::format("{}", fmt::join(others, ","));
  };
  config.cycle.estimator.shadow = all_but(config.cycle.estimator.published);
  for (EngineAssignment& assignment : config.engines)
    assignment.shadow = all_but(assignment.published.value_or(config.cycle.estimator.published));
}

void run_offline(const MonitorConfig& config, EngineTable& engines) {
  OfflineRun(config, engines).run();
}

}  // namespace ehm::monitor
