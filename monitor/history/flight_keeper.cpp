// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/flight_keeper.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/service/last_catch.h"
#include "monitor/checkpoint/checkpoint_folder.h"
#include "monitor/design/make_estimator.h"
#include "monitor/design/make_on_board.h"
#include "monitor/history/sum_flight.h"

namespace ehm::monitor {

namespace {

constexpr std::chrono::milliseconds poll{20};

/// What maintenance since the latest flight leaves of what was known; nothing after a replacement.
void maintain(const FlightHistory& history, std::size_t health_count, estimation::Learned& learned) {
  for (auto it = history.entries.rbegin(); it != history.entries.rend() && it->maintenance; ++it) {
    if (it->maintenance->kind == Maintenance::Kind::replacement) learned = {};
    if (learned.empty()) return;
    learned.covariance.diagonal().head(as_index(health_count)).array() += wash_percent * wash_percent;
  }
}

std::uint32_t last_flight(const FlightHistory& history) {
  std::uint32_t last = 0;
  for (const HistoryEntry& entry : history.entries)
    if (entry.flight) last = std::max(last, entry.flight->number);
  return last;
}

}  // namespace

FlightKeeper::FlightKeeper(const MonitorConfig& config, const EngineTable& engines, NoticeBoard& notices,
                           FlightBoard& summaries)
    : options_(config.history), estimator_(config.cycle.estimator), notices_(notices), summaries_(summaries) {
  add_designs(engines);
  if (!options_.directory.empty()) load(engines);
  known_.reserve(known_.size() + as_size(config.max_engines) + engines.size());
  thread_ = std::thread([this] { run(); });
}

FlightKeeper::~FlightKeeper() {
  stop_.store(true, std::memory_order_release);
  thread_.join();
}

void FlightKeeper::add_designs(const EngineTable& engines) {
  const std::lock_guard lock(prepared_mutex_);
  for (const design::Design* design : engines.designs()) {
    if (prepared_.contains(design->hash)) continue;
    Prepared prepared{*design, nullptr};
    if (design::publishes_on_board(estimator_)) prepared.model = design::make_on_board_model(*design, estimator_);
    prepared_.emplace(design->hash, std::move(prepared));
  }
}

const FlightKeeper::Prepared* FlightKeeper::prepared(const std::string& design_hash) {
  const std::lock_guard lock(prepared_mutex_);
  const auto it = prepared_.find(design_hash);
  return it == prepared_.end() ? nullptr : &it->second;
}

void FlightKeeper::load(const EngineTable& engines) {
  try {
    require_writable_folder(options_.directory, "history.directory");
    for (const std::uint32_t id : engines_in(options_.directory)) {
      const FlightHistory history = readable_history(id);
      known_.push_back({id, last_flight(history), {}});
      try {
        load_baseline(engines, history, known_.back());
      } catch (const files::FileError& error) {
        refused_.insert(id);
        say(id, true, error.what());
      }
    }
  } catch (const files::FileError& error) {
    tell(true, error.what());
  }
}

/// Without what cannot be read of it; flights are added behind all the same.
FlightHistory FlightKeeper::readable_history(std::uint32_t engine_id) {
  try {
    FlightHistory history = read_what_can_be(options_.directory, engine_id);
    if (!history.damaged.empty()) {
      const std::size_t more = history.damaged.size() - 1;
      say(engine_id, true,
          history.damaged.front() + (more == 0 ? "" : "; and " + std::to_string(more) + " lines more of it"));
    }
    return history;
  } catch (const files::FileError& error) {
    say(engine_id, true, error.what());
    FlightHistory unknown;
    unknown.damaged_since_flight = true;
    return unknown;
  }
}

void FlightKeeper::load_baseline(const EngineTable& engines, const FlightHistory& history, Known& known) {
  const std::uint32_t engine_id = known.engine_id;
  const auto baseline = read_baseline(options_.directory, engine_id);
  if (!baseline) return;
  known.flights = std::max(known.flights, baseline->flights);
  const design::Design* design = engines.design_of(engine_id);
  if (!design) return;
  const Prepared* with = prepared(design->hash);
  const std::string file = baseline_path(options_.directory, engine_id);
  if (!with->model) return;  // another estimator is published at present
  if (baseline->names != design::learned_names(*with->model))
    throw files::FileError(file + ": holds other parameters than estimator.mismatch = " + estimator_.mismatch +
                           " and engine " + design->model.engine_type + " have: the engine starts as an unknown one");
  if (baseline->engine_type != design->model.engine_type)
    throw files::FileError(file + ": is of engine type " + baseline->engine_type + ", now flies " +
                           design->model.engine_type + ": the engine starts as an unknown one");
  if (history.damaged_since_flight)
    throw files::FileError(file + ": lines behind the last flight of " + flights_path(options_.directory, engine_id) +
                           " cannot be read, and may tell of a replacement: the engine starts as an unknown one");
  known.learned = baseline->latest;
  baselines_.emplace(engine_id, *baseline);
  maintain(history, design->model.health.size(), known.learned);
  if (known.learned.empty()) baselines_.erase(engine_id);  // its wear is counted from what comes
}

FlightKeeper::Known* FlightKeeper::find(std::uint32_t engine_id) noexcept {
  const auto it = std::find_if(known_.begin(), known_.end(), [&](const Known& k) { return k.engine_id == engine_id; });
  return it == known_.end() ? nullptr : &*it;
}

bool FlightKeeper::begin(EngineSlot& slot, bool goes_on) noexcept {
  const Known* known = find(slot.engine_id);
  if (!known) return false;
  if (slot.flights.flight() < known->flights) slot.flights.count_from(known->flights);
  return !goes_on && !known->learned.empty() && slot.cycle.begin_with(known->learned, options_.wear_percent);
}

void FlightKeeper::follow(EngineSlot& slot) noexcept {
  if (!slot.flights.follow(slot.cycle, slot.fan)) return;
  remember(slot);
  slot.cycle.next_flight(options_.wear_percent);
  slot.landing_due = true;
  hand_over(slot);
}

void FlightKeeper::remember(const EngineSlot& slot) noexcept {
  Known* known = find(slot.engine_id);
  if (!known && known_.size() < known_.capacity()) known = &known_.emplace_back(Known{slot.engine_id, 0, {}});
  if (!known) return;
  known->flights = slot.flights.flight();
  known->learned = slot.cycle.learned();
}

void FlightKeeper::hand_over(EngineSlot& slot) noexcept {
  if (!slot.landing_due || !queue_->has_room()) return;
  landing_.engine_id = slot.engine_id;
  const std::string& hash = slot.cycle.design().hash;
  landing_.design_hash.fill(' ');
  std::copy_n(hash.begin(), std::min(hash.size(), landing_.design_hash.size()), landing_.design_hash.begin());
  landing_.totals = slot.flights.finished();
  const Known* known = find(slot.engine_id);
  landing_.learned = known ? known->learned : estimation::Learned{};
  queue_->push(landing_);
  slot.landing_due = false;
}

void FlightKeeper::run() {
  Landing landing;
  // The flag is read before the queue: what was queued before the stop is still summed up.
  for (bool last = false; !last;) {
    last = stop_.load(std::memory_order_acquire);
    service::survive("flights", [&] {
      while (queue_->pop(landing)) sum_up(landing);
    });
    if (!last) std::this_thread::sleep_for(poll);
  }
}

void FlightKeeper::sum_up(const Landing& landing) {
  const Prepared* with = prepared(std::string(landing.design_hash.data(), landing.design_hash.size()));
  if (!with) return;  // its design has gone with a reload
  SummedFlight summed{landing.engine_id, sum_flight(landing.totals, landing.learned, with->design, with->model.get())};
  store(*with, landing, summed.flight);
  summaries_.post(std::move(summed));
}

/// Its wear, and what is to be known of it after a restart.
void FlightKeeper::store(const Prepared& with, const Landing& landing, Flight& flight) {
  Baseline& baseline = baselines_[landing.engine_id];
  const bool learned = with.model && !landing.learned.empty();
  if (learned) {
    baseline.engine_id = landing.engine_id;
    baseline.engine_type = with.design.model.engine_type;
    baseline.names = design::learned_names(*with.model);
    count_flight(baseline, landing.learned, landing.totals.landing_ns,
                 static_cast<std::uint32_t>(options_.first_flights));
    flight.flights_learned = baseline.flights_of_first;
    constexpr double fraction = 0.01;
    for (std::size_t i = 0; i < flight.health.size(); ++i)
      flight.health[i].wear = flight.health[i].value - fraction * baseline.first.value(as_index(i));
  }
  if (options_.directory.empty()) return;
  try {
    std::error_code there;  // if it cannot be made, writing says why
    if (failing_) std::filesystem::create_directories(options_.directory, there);
    if (learned && refused_.erase(landing.engine_id) != 0) {
      const std::string file = baseline_path(options_.directory, landing.engine_id);
      std::filesystem::rename(file, file + ".refused", there);
      say(landing.engine_id, false,
          "a new baseline is begun; the one that was not taken " +
              (there ? "could not be kept: " + there.message() : "is kept as " + file + ".refused"));
    }
    if (learned) write_baseline(options_.directory, baseline);
    add_to_history(options_.directory, landing.engine_id, to_line(flight));
    tell(false, "");
  } catch (const std::exception& error) {
    tell(true, error.what());
  }
}

void FlightKeeper::say(std::uint32_t engine_id, bool raised, std::string text) {
  notices_.post(
      {.kind = idl::EventKind::flight_history, .raised = raised, .text = std::move(text), .engine_id = engine_id});
}

void FlightKeeper::tell(bool failing, const std::string& why) {
  if (failing == failing_) return;
  failing_ = failing;
  say(0, failing,
      failing ? "flights cannot be noted, their summaries are published all the same: " + why
              : "flights are noted again");
}

}  // namespace ehm::monitor
