// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/mission_fault.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/scenario/mission.h"
#include "engine_sim/simulation.h"
#include "monitor/cycle/monitor_cycle.h"
#include "tuner_design/flight/flight_engine.h"

namespace ehm::tuner_design {
namespace {

constexpr double first_slot_s = 700.0, between_slots_s = 140.0, last_slot_s = 6560.0, landing_s = 6900.0;
constexpr double after_slam_s = 3.0, keep_off_slam_s = 90.0;
constexpr double mends_s = 60.0;  ///< after something was whole again no alarm is a false one
constexpr double judged_every_s = 20.0, within = 1.96;
/// Where power is set within seconds: top of climb, step climb and its end, descent, approach.
constexpr double slams_s[] = {1560.0, 3600.0, 3780.0, 5400.0, 6590.0, 6780.0};
constexpr double climb_ends_s = 1560.0, descent_begins_s = 5400.0;

Moment moment_of(double t) {
  return t < climb_ends_s ? Moment::climbing : t < descent_begins_s ? Moment::steady : Moment::descending;
}

/// A slot in progress; what came before and after it is the flight's own.
struct Running {
  std::size_t slot;
  double ends_s;
  std::optional<double> whole_health;  ///< to restore
};

class Mission {
 public:
  Mission(const StudyEngine& study, const std::vector<MissionSlot>& slots, const monitor::CycleOptions& options,
          const MissionDraw& draw, std::uint64_t index)
      : engine_(flown_engine(*study.engine, study.prepared.design->model.sample_time_s)),
        simulation_(mission_scenario(engine_, study.prepared.design->model.sample_time_s, draw, index)),
        cycle_(study.prepared, options) {
    for (const MissionSlot& slot : slots) out_.slots.push_back({slot, {}});
  }

  MissionOutcome run() {
    try {
      while (simulation_.time_s() < engine_sim::mission_seconds) step();
    } catch (const engine_sim::FlightError& error) {
      out_.why = error.what();
    }
    return std::move(out_);
  }

 private:
  void step() {
    const double now_s = simulation_.time_s();
    begin_and_end(now_s);
    const engine_sim::EngineSample sample = simulation_.next_sample();
    reading_ = sample.sensors;
    to_sample(sample, now_s, sample_);
    cycle_.process(sample_);
    note_events(now_s);
    ++out_.samples;
    if (!cycle_.result().estimates) return;
    ++out_.estimated;
    judge(sample, now_s);
  }

  void begin_and_end(double now_s) {
    if (running_ && now_s >= running_->ends_s) {
      if (running_->whole_health)
        simulation_.order_health(out_.slots[running_->slot].slot.what.channel, *running_->whole_health, 0.0);
      quiet_from_s_ = now_s + mends_s;
      running_.reset();
    }
    if (running_ || next_ == out_.slots.size() || now_s < out_.slots[next_].slot.onset_s) return;
    begin(next_++, now_s);
  }

  void begin(std::size_t at, double now_s) {
    auto& [slot, outcome] = out_.slots[at];
    const FaultCase& what = slot.what;
    const bool component = what.row->broken == Broken::component;
    outcome.flown = cycle_.result().estimates && (component || cycle_.result().fused[what.channel]);
    if (!outcome.flown) return;
    running_ = Running{at, now_s + what.row->watched_s, {}};
    begun_s_ = now_s;
    if (component) {
      running_->whole_health = simulation_.health_of(what.channel);
      simulation_.order_health(what.channel, *running_->whole_health + what.row->size, 0.0);
      return;
    }
    const double percent = engine_->channels.sensors[what.channel].noise_percent;
    engine_sim::SensorFault fault = sensor_fault(*what.row, 0.01 * percent * std::abs(reading_[what.channel].value),
                                                 now_s, at % 2 == 0 ? 1.0 : -1.0);
    fault.duration_s = what.row->watched_s;
    simulation_.inject(what.channel, fault);
  }

  void note_events(double now_s) {
    const bool quiet = !running_ && now_s >= quiet_from_s_ && cycle_.result().estimates;
    if (quiet) out_.flown_s += engine_sim_step_s();
    for (const monitor::Event& event : cycle_.events()) {
      if (running_)
        note_answer(event, now_s - begun_s_, true, out_.slots[running_->slot].outcome);
      else if (quiet)
        out_.false_alarms += is_answer(event);
    }
    cycle_.clear_events();
  }

  double engine_sim_step_s() const { return cycle_.design().model.sample_time_s; }

  void judge(const engine_sim::EngineSample& sample, double now_s) {
    const estimation::Estimate& e = cycle_.result().estimate;
    if (now_s < next_judged_s_ || running_) return;
    next_judged_s_ = now_s + judged_every_s;
    if (now_s > landing_s) return;
    out_.ssee_landing = out_.claim_landing = 0.0;
    for (std::size_t i = 0; i < sample.health.size(); ++i) {
      const double error = e.health(as_index(i)) - sample.health[i], sigma = e.health_sigma(as_index(i));
      ++out_.judged;
      out_.covered += std::abs(error) <= within * sigma;
      out_.ssee_landing += 1e4 * error * error;
      out_.claim_landing += 1e4 * sigma * sigma;
    }
  }

  std::shared_ptr<const engine_sim::EngineDefinition> engine_;
  engine_sim::Simulation simulation_;
  monitor::MonitorCycle cycle_;
  monitor::Sample sample_;
  std::vector<engine_sim::Reading> reading_;
  MissionOutcome out_;
  std::optional<Running> running_;
  std::size_t next_ = 0;
  double begun_s_ = 0.0, quiet_from_s_ = 0.0, next_judged_s_ = 420.0;
};

}  // namespace

std::vector<MissionSlot> mission_slots(std::size_t sensors, std::size_t health, std::uint64_t index) {
  std::vector<FaultCase> round;
  for (const FaultCase& what : round_of_cases(sensors, health))
    if (what.row->broken != Broken::nothing) round.push_back(what);
  std::vector<MissionSlot> slots;
  for (const double slam : slams_s) slots.push_back({slam + after_slam_s, Moment::transient, {}});
  for (double t = first_slot_s; t <= last_slot_s; t += between_slots_s) {
    const bool near = std::any_of(std::begin(slams_s), std::end(slams_s),
                                  [&](double slam) { return std::abs(t - slam) < keep_off_slam_s; });
    if (!near) slots.push_back({t, moment_of(t), {}});
  }
  std::sort(slots.begin(), slots.end(), [](const auto& a, const auto& b) { return a.onset_s < b.onset_s; });
  std::array<std::size_t, moment_names.size()> in_flight{}, before{};
  for (const MissionSlot& slot : slots) ++in_flight[static_cast<std::size_t>(slot.moment)];
  for (MissionSlot& slot : slots) {
    const auto moment = static_cast<std::size_t>(slot.moment);
    slot.what = round[(index * in_flight[moment] + before[moment]++) % round.size()];
  }
  return slots;
}

MissionOutcome fly_mission(const StudyEngine& study, const std::vector<MissionSlot>& slots,
                           const monitor::CycleOptions& options, const MissionDraw& draw, std::uint64_t index) {
  try {
    return Mission(study, slots, options, draw, index).run();
  } catch (const engine_sim::FlightError& error) {
    MissionOutcome none;
    none.why = error.what();
    return none;
  }
}

}  // namespace ehm::tuner_design
