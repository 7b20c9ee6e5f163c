#include "engine_sim/replay/replay.h"

#include <spdlog/spdlog.h>
#include <time.h>

#include <algorithm>
#include <optional>
#include <set>
#include <stdexcept>

#include "deploy/service/notify.h"
#include "deploy/service/watchdog.h"
#include "engine_sim/dds/wait_for_readers.h"
#include "engine_sim/dds/watched_participant.h"
#include "engine_sim/replay/replay_answers.h"
#include "engine_sim/replay/replay_message.h"
#include "engine_sim/replay/replay_timeline.h"

namespace ehm::engine {

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
void sleep_until(std::int64_t due_ns, const service::StopSignal& stop, service::TurnCounter& turns) {
  constexpr std::int64_t slice_ns = 200'000'000;
  for (std::int64_t now_ns = clock_ns(CLOCK_MONOTONIC); now_ns < due_ns && !stop.requested();
       now_ns = clock_ns(CLOCK_MONOTONIC)) {
    const std::int64_t until_ns = std::min(due_ns, now_ns + slice_ns);
    const timespec until{until_ns / 1'000'000'000, until_ns % 1'000'000'000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    turns.turned();
  }
}

class Replay {
 public:
  Replay(const SimConfig& config, recording::RowSource& rows)
      : rows_(rows),
        rate_(config.rate_factor()),
        stamps_now_(config.replay.stamps == "now"),
        participant_(config, "engine_sim replay"),
        sensors_(participant_),
        descriptions_(participant_) {
    if (rate_ == 0.0) answers_.emplace(participant_, static_cast<std::size_t>(config.lockstep_window));
  }

  const service::TurnCounter& turns() const { return turns_; }
  void wait(std::int64_t wanted, const service::StopSignal& stop) {
    if (answers_) wanted = std::max<std::int64_t>(wanted, 1);
    wait_for_readers(
        wanted,
        [&] {
          turns_.turned();
          return sensors_.matched() >= wanted && (!answers_ || answers_->monitors() > 0);
        },
        stop);
  }

  void run(const service::StopSignal& stop) {
    start_ns_ = clock_ns(CLOCK_MONOTONIC);
    Row row;
    while (!stop.requested() && rows_.next(row))
      if (row.kind() == RowKind::sample) send(row, stop);
    service::notify_stopping();
    if (!sensors_.drain(1.0)) spdlog::warn("not every reader has acknowledged the last samples");
    spdlog::info("{} samples of {} engine(s) published, {} refused by the middleware", sent_, described_.size(),
                 refused_);
    if (answers_ && answers_->unanswered() > 0)
      spdlog::warn("{} samples were not answered: does the monitor serve these engines?", answers_->unanswered());
  }

 private:
  void send(const Row& row, const service::StopSignal& stop) {
    const auto engine_id = static_cast<std::uint32_t>(row.a.unit);
    if (described_.insert(engine_id).second)
      descriptions_.write(description_of(engine_id, static_cast<std::uint32_t>(row.a.source_id), rows_.info()));
    if (sent_ == 0 && stamps_now_) shift_ns_ = clock_ns(CLOCK_REALTIME) - row.a.source_time_ns;
    const std::int64_t due_ns = timeline_.due_ns(row);
    if (!answers_) {
      sleep_until(start_ns_ + static_cast<std::int64_t>(static_cast<double>(due_ns) / rate_), stop, turns_);
    } else if (!answers_->admit(answer_limit)) {
      throw std::runtime_error(
          "rate max: no monitor has answered for 10 s (EngineResiduals); start a monitor on this domain and partition");
    }
    if (stop.requested()) return;
    refused_ += sensors_.write(message_of(row, rows_.info().channels, shift_ns_)) ? 0u : 1u;
    ++sent_;
    turns_.turned();
    if (answers_ && row.a.accepted != 0) answers_->sent(engine_id, static_cast<std::uint64_t>(row.a.sequence));
  }

  recording::RowSource& rows_;
  double rate_;
  bool stamps_now_;
  WatchedParticipant participant_;
  wire::Writer<EngineSensors> sensors_;
  wire::Writer<EngineDescription> descriptions_;
  std::optional<ReplayAnswers> answers_;
  ReplayTimeline timeline_;
  std::set<std::uint32_t> described_;
  service::TurnCounter turns_;
  std::int64_t start_ns_ = 0, shift_ns_ = 0;
  std::uint64_t sent_ = 0, refused_ = 0;
};

}  // namespace

void run_replay(const SimConfig& config, recording::RowSource& rows, const service::StopSignal& stop) {
  Replay replay(config, rows);
  const service::Watchdog watchdog(replay.turns(), "replay");
  service::notify_ready();
  replay.wait(config.wait_for_monitors, stop);
  spdlog::info("replay of {}{}", config.replay.file,
               rows.info().part > 1 ? ", which begins in mid-flight: it is not the first part of its recording" : "");
  replay.run(stop);
}

}  // namespace ehm::engine
