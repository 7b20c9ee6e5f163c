#include "engine_sim/run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "deploy/service/notify.h"
#include "deploy/service/watchdog.h"
#include "engine_sim/dds/command_reader.h"
#include "engine_sim/dds/lockstep.h"
#include "engine_sim/dds/sim_publisher.h"
#include "engine_sim/dds/wait_for_readers.h"
#include "engine_sim/dds/watched_participant.h"
#include "engine_sim/pacer.h"

namespace ehm::engine {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds answer_limit{10'000};

std::int64_t wall_clock_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
      .count();
}

/// Real time stamps samples with the clock; an accelerated run with simulated time from its start, so that dt is right.
class SourceClock {
 public:
  SourceClock(bool real_time, double period_s)
      : real_time_(real_time), period_s_(period_s), start_ns_(wall_clock_ns()) {}
  std::int64_t stamp(std::uint64_t sequence) const {
    return real_time_ ? wall_clock_ns()
                      : start_ns_ + static_cast<std::int64_t>(static_cast<double>(sequence) * period_s_ * 1e9);
  }

 private:
  bool real_time_;
  double period_s_;
  std::int64_t start_ns_;
};

/// Under lockstep somebody must listen and answer before the first sample, or its window would never be answered.
void wait_for_monitors(const SimPublisher& publisher, const std::optional<Lockstep>& lockstep, std::int64_t wanted,
                       const service::StopSignal& stop, service::TurnCounter& turns) {
  if (lockstep) wanted = std::max<std::int64_t>(wanted, 1);
  const auto ready = [&] {
    turns.turned();
    return publisher.monitors() >= wanted && (!lockstep || lockstep->monitors() > 0);
  };
  wait_for_readers(wanted, ready, stop);
}

}  // namespace

void run(const SimConfig& config, Simulation& simulation, const service::StopSignal& stop) {
  const Scenario& scenario = config.scenario;
  const double rate = config.rate_factor();
  const auto engine_id = static_cast<std::uint32_t>(scenario.engine_id);

  WatchedParticipant participant(config, "engine_sim " + std::to_string(scenario.engine_id));
  SimPublisher publisher(participant, scenario);
  CommandReader commands(participant, engine_id);
  std::optional<Lockstep> lockstep;
  if (rate == 0.0) lockstep.emplace(participant, engine_id, static_cast<std::uint64_t>(config.lockstep_window));
  publisher.describe(simulation);
  service::TurnCounter turns;
  const service::Watchdog watchdog(turns, "simulation");
  service::notify_ready();
  wait_for_monitors(publisher, lockstep, config.wait_for_monitors, stop, turns);

  spdlog::info("engine {} flies at {} m, Mach {}, fan speed {:.1f} rpm", engine_id, scenario.flight.altitude_m,
               scenario.flight.mach, simulation.nominal().speeds.n1_rpm);
  const SourceClock clock(rate == 1.0, scenario.sample_time_s);
  Pacer pacer(rate > 0.0 ? scenario.sample_time_s / rate : scenario.sample_time_s);
  std::uint64_t sent = 0, refused = 0;
  while (!stop.requested() && (scenario.duration_s <= 0.0 || simulation.time_s() < scenario.duration_s)) {
    commands.apply_all(simulation, [](const std::string& what) { spdlog::info("{}", what); });
    if (lockstep && !lockstep->admit(sent, answer_limit))
      throw std::runtime_error("rate max: no monitor has answered for 10 s (EngineResiduals of engine " +
                               std::to_string(engine_id) + "); start a monitor on this domain and partition");
    const SimSample sample = simulation.next();
    refused += publisher.publish(sample, clock.stamp(sample.sequence)) ? 0u : 1u;
    ++sent;
    turns.turned();
    if (!lockstep && !pacer.wait()) break;
  }
  service::notify_stopping();
  if (!publisher.drain(1.0)) spdlog::warn("not every reader has acknowledged the last samples");
  spdlog::info("{} samples published, {} refused by the middleware, {} slips, worst lateness {:.3f} ms", sent, refused,
               pacer.slips(), 1e-6 * static_cast<double>(pacer.worst_ns()));
}

}  // namespace ehm::engine
