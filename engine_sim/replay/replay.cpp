// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/replay/replay.h"

#include <spdlog/spdlog.h>
#include <time.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/service/notify.h"
#include "deploy/runtime/service/watchdog.h"
#include "engine_sim/dds/wait_for_readers.h"
#include "engine_sim/dds/watched_participant.h"
#include "engine_sim/replay/replay_answers.h"
#include "engine_sim/replay/replay_message.h"
#include "engine_sim/replay/replay_timeline.h"

namespace ehm::engine_sim {

using recording::Row;
using recording::RowKind;

namespace {

constexpr std::chrono::milliseconds answer_limit{10'000};

std::int64_t clock_ns(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
}

/// Sleeps to `due_ns` of the monotonic clock; a stop signal ends it early. In slices, so that a recorded pause does not
/// look like a replay that hangs.
/// Calls `turn` at least five times a second.
template <class Turn>
void sleep_until(std::int64_t due_ns, const service::StopSignal& stop, Turn turn) {
  constexpr std::int64_t slice_ns = 200'000'000;
  for (std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC); now_ns < due_ns && !stop.requested();
       now_ns = clock_ns(CLOCK_MONOTONIC)) {
    const std::int64_t until_ns = std::min(due_ns, now_ns + slice_ns);
    const timespec until{until_ns / 1'000'000'000, until_ns % 1'000'000'000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    turn();
  }
}

class Replay {
 public:
  Replay(const SimConfig& config, recording::RowSource& rows)
      : config_(config), rows_(rows), rate_(config.rate_factor()), stamps_now_(config.replay.stamps == "now") {
    ends_.emplace(config_);
  }

  const service::TurnCounter& turns() const { return turns_; }
  void wait(std::int64_t wanted, const service::StopSignal& stop) {
    if (ends_->answers) wanted = std::max<std::int64_t>(wanted, 1);
    wait_for_readers(
        wanted,
        [&] {
          turn(stop);
          return ends_->sensors.matched() >= wanted && (!ends_->answers || ends_->answers->monitors() > 0);
        },
        stop);
  }

  void run(const service::StopSignal& stop) {
    start_ns_ = clock_ns(CLOCK_MONOTONIC);
    Row row;
    while (!stop.requested() && rows_.next(row))
      if (row.kind() == RowKind::sample) send(row, stop);
    service::notify_stopping();
    if (!ends_->sensors.drain(1.0)) spdlog::warn("not every reader has acknowledged the last samples");
    spdlog::info("{} samples of {} engine(s) published, {} refused by the middleware", sent_, described_.size(),
                 refused_);
    if (const std::uint64_t unanswered = unanswered_ + ends_->unanswered(); unanswered > 0)
      spdlog::warn("{} samples were not answered: does the monitor serve these engines?", unanswered);
  }

 private:
  /// Its place in DDS, made anew when the process was held up for so long that others have dropped it.
  struct Ends {
    explicit Ends(const SimConfig& config)
        : participant(config, "engine_sim replay"), sensors(participant.get()), descriptions(participant.get()) {
      if (config.rate_factor() == 0.0) answers.emplace(participant.get(), as_size(config.lockstep_window));
    }
    std::uint64_t unanswered() const { return answers ? answers->unanswered() : 0; }
    WatchedParticipant participant;
    idl::Writer<EngineSensors> sensors;
    idl::Writer<EngineDescription> descriptions;
    std::optional<ReplayAnswers> answers;
  };

  /// To be called at least once a second.
  void turn(const service::StopSignal& stop) {
    turns_.turned();
    const double held_up_s = ends_->participant.held_up_s();
    if (held_up_s == 0.0) return;
    const auto join = [this] {
      unanswered_ += ends_->unanswered();
      described_.clear();
      ends_.reset();
      ends_.emplace(config_);
    };
    join_anew(
        held_up_s, [this] { return ends_->sensors.matched(); }, join, stop);
    late_ = true;
  }
  /// In real time until the row is due; after a hold from now on, not what was missed in one burst.
  void await(std::int64_t due_ns, const service::StopSignal& stop) {
    turn(stop);
    const auto since_start_ns = static_cast<std::int64_t>(static_cast<double>(due_ns) / rate_);
    sleep_until(start_ns_ + since_start_ns, stop, [&] { turn(stop); });
    if (std::exchange(late_, false)) start_ns_ = clock_ns(CLOCK_MONOTONIC) - since_start_ns;
  }
  void send(const Row& row, const service::StopSignal& stop) {
    const auto engine_id = static_cast<std::uint32_t>(row.a.unit);
    if (sent_ == 0 && stamps_now_) shift_ns_ = clock_ns(CLOCK_REALTIME) - row.a.source_time_ns;
    const std::int64_t due_ns = timeline_.due_ns(row);
    if (!ends_->answers) {
      await(due_ns, stop);
    } else {
      turn(stop);
      if (!ends_->answers->admit(answer_limit))
        throw std::runtime_error(
            "rate max: no monitor has answered for 10 s (EngineResiduals); start a monitor on "
            "this domain and partition");
    }
    if (stop.requested()) return;
    if (described_.insert(engine_id).second)
      ends_->descriptions.write(description_of(engine_id, static_cast<std::uint32_t>(row.a.source_id), rows_.info()));
    refused_ += ends_->sensors.write(message_of(row, rows_.info().channels, shift_ns_)) ? 0u : 1u;
    ++sent_;
    turns_.turned();
    if (ends_->answers && row.a.accepted != 0)
      ends_->answers->sent(engine_id, static_cast<std::uint64_t>(row.a.sequence));
  }

  const SimConfig& config_;
  recording::RowSource& rows_;
  double rate_;
  bool stamps_now_;
  std::optional<Ends> ends_;
  ReplayTimeline timeline_;
  std::set<std::uint32_t> described_;
  service::TurnCounter turns_;
  std::int64_t start_ns_ = 0, shift_ns_ = 0;
  std::uint64_t sent_ = 0, refused_ = 0, unanswered_ = 0;  ///< unanswered: by those who were there before a hold
  bool late_ = false;                                      ///< a hold has cost time
};

}  // namespace

void run_replay(const SimConfig& config, recording::RowSource& rows, const service::StopSignal& stop) {
  Replay replay(config, rows);
  const service::Watchdog watchdog({{&replay.turns(), "replay"}});
  service::notify_ready();
  replay.wait(config.wait_for_monitors, stop);
  spdlog::info("replay of {}{}", config.replay.file,
               rows.info().part > 1 ? ", which begins in mid-flight: it is not the first part of its recording" : "");
  replay.run(stop);
}

}  // namespace ehm::engine_sim
