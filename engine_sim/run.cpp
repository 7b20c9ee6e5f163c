// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/run.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/service/notify.h"
#include "deploy/runtime/service/watchdog.h"
#include "engine_sim/dds/command_desk.h"
#include "engine_sim/dds/lockstep.h"
#include "engine_sim/dds/sim_publisher.h"
#include "engine_sim/dds/wait_for_readers.h"
#include "engine_sim/dds/watched_participant.h"
#include "engine_sim/pacer.h"

namespace ehm::engine_sim {

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

/// The simulator's place in DDS: made anew when the process was held up for so long that others have dropped it.
class Link {
 public:
  Link(const SimConfig& config, SimulatedEngine& engine) : config_(config), engine_(engine) { join(); }

  /// To be called at least once a second; true if the link is a new one, and as many listen to it as before, or two
  /// seconds are over.
  bool keep(const service::StopSignal& stop) {
    const double held_up_s = ends_->participant.held_up_s();
    if (held_up_s == 0.0) return false;
    join_anew(
        held_up_s, [this] { return ends_->publisher.monitors(); }, [this] { join(); }, stop);
    return true;
  }
  /// Under lockstep somebody must listen and answer before the first sample, or its window would never be answered.
  void wait(std::int64_t wanted, const service::StopSignal& stop, service::TurnCounter& turns) {
    if (ends_->lockstep) wanted = std::max<std::int64_t>(wanted, 1);
    const auto ready = [&] {
      turns.turned();
      keep(stop);
      obey();
      return ends_->publisher.monitors() >= wanted && (!ends_->lockstep || ends_->lockstep->monitors() > 0);
    };
    wait_for_readers(wanted, ready, stop);
  }
  SimPublisher& publisher() { return ends_->publisher; }
  /// Carries out what operators have ordered meanwhile.
  void obey() { ends_->commands.serve(engine_); }
  /// Null in real time.
  Lockstep* lockstep() { return ends_->lockstep ? &*ends_->lockstep : nullptr; }

 private:
  struct Ends {
    explicit Ends(const SimConfig& config)
        : participant(config, "engine_sim " + std::to_string(config.scenario.engine_id)),
          publisher(participant.get(), static_cast<std::uint32_t>(config.scenario.engine_id),
                    static_cast<std::uint32_t>(config.scenario.source_id)),
          commands(participant.get(), config.scenario) {
      if (config.rate_factor() == 0.0)
        lockstep.emplace(participant.get(), static_cast<std::uint32_t>(config.scenario.engine_id),
                         static_cast<std::uint64_t>(config.lockstep_window));
    }
    WatchedParticipant participant;
    SimPublisher publisher;
    CommandDesk commands;
    std::optional<Lockstep> lockstep;
  };
  void join() {
    ends_.reset();
    ends_.emplace(config_);
    ends_->publisher.describe(engine_.channels());
    ends_->publisher.state_mismatch(engine_.mismatch());
  }

  const SimConfig& config_;
  SimulatedEngine& engine_;
  std::optional<Ends> ends_;
};

}  // namespace

void run(const SimConfig& config, SimulatedEngine& engine, const service::StopSignal& stop) {
  const Scenario& scenario = config.scenario;
  const double sample_time_s = engine.channels().sample_time_s;
  const double rate = config.rate_factor();
  const auto engine_id = static_cast<std::uint32_t>(scenario.engine_id);

  Link link(config, engine);
  service::TurnCounter turns;
  const service::Watchdog watchdog({{&turns, "simulation"}});
  service::notify_ready();
  link.wait(config.wait_for_monitors, stop, turns);

  spdlog::info("engine {} {}", engine_id, engine.start_text());
  if (scenario.process_noise.on())
    spdlog::info("engine {} has {} process noise", engine_id,
                 noise_distribution_names[as_size(scenario.process_noise.distribution)]);
  const SourceClock clock(rate == 1.0, sample_time_s);
  Pacer pacer(rate > 0.0 ? sample_time_s / rate : sample_time_s);
  std::uint64_t sent = 0, refused = 0;
  while (!stop.requested() && (scenario.duration_s <= 0.0 || engine.time_s() < scenario.duration_s)) {
    if (link.keep(stop)) pacer.restart();
    link.obey();
    if (link.lockstep() && !link.lockstep()->admit(sent, answer_limit))
      throw std::runtime_error("rate max: no monitor has answered for 10 s (EngineResiduals of engine " +
                               std::to_string(engine_id) + "); start a monitor on this domain and partition");
    const EngineSample sample = engine.next_sample();
    refused += link.publisher().publish(sample, clock.stamp(sample.sequence)) ? 0u : 1u;
    ++sent;
    turns.turned();
    if (!link.lockstep() && !pacer.wait()) break;
  }
  service::notify_stopping();
  if (!link.publisher().drain(1.0)) spdlog::warn("not every reader has acknowledged the last samples");
  spdlog::info("{} samples published, {} refused by the middleware, {} slips, worst lateness {:.3f} ms", sent, refused,
               pacer.slips(), 1e-6 * static_cast<double>(pacer.worst_ns()));
}

}  // namespace ehm::engine_sim
