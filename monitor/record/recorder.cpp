// SPDX-License-Identifier: Apache-2.0
#include "monitor/record/recorder.h"

#include <spdlog/fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

#include "deploy/runtime/config/config_error.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/recording/part_files.h"
#include "deploy/runtime/service/last_catch.h"
#include "monitor/realtime/clock.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

using config::ConfigError;
using std::chrono::steady_clock;

namespace {

constexpr std::chrono::milliseconds poll{20};
constexpr std::size_t commit_rows = 16 * recording::Writer::chunk_rows;
// What kill -9 may cost: whole chunks reach the file after one time, a part of a chunk after the other.
constexpr std::chrono::milliseconds commit_chunks_after{500}, commit_all_after{5000};
constexpr std::chrono::seconds retry_after{10};
constexpr double bytes_per_mb = 1e6;

}  // namespace

Recorder::Recorder(const MonitorConfig& config, const EngineTable& engines, NoticeBoard& notices)
    : options_(config.record), feed_(std::make_unique<RecordFeed>()), notices_(notices) {
  add_engines(engines);
  const design::Design& first = *engines.designs().front();
  info_.recording_id = wall_clock_ns();
  info_.part = 0;
  info_.monitor_source_id = config.source_id;
  info_.sample_time_s = first.model.sample_time_s;
  info_.created_by = "monitor";
  info_.published = config.cycle.estimator.published;
  info_.shadows = fmt::format("{}", fmt::join(all_shadow_names(config), ","));
  info_.channels = recorded_channels(first);
  try {
    begin_part(info_.channels);
  } catch (const files::FileError& e) {
    give_up(e.what());
  }
  thread_ = std::thread([this] { run(); });
}

void Recorder::add_engines(const EngineTable& engines) {
  const auto designs = engines.designs();
  const recording::Channels channels = recorded_channels(*designs.front());
  for (const design::Design* design : designs)
    if (recorded_channels(*design) != channels)
      throw ConfigError("'record.file' is '" + options_.file + "', but the designs " +
                        designs.front()->hash.substr(0, 12) + " and " + design->hash.substr(0, 12) +
                        " have different channels; a recording has one set of them: run one monitor for each");
  const std::lock_guard lock(mutex_);
  for (const design::Design* design : designs) known_[design->hash] = channels;
}

Recorder::~Recorder() {
  stop_.store(true, std::memory_order_release);
  thread_.join();
}

void Recorder::begin_part(recording::Channels channels) {
  if (writer_ && channels != writer_->channels()) {
    info_.recording_id = wall_clock_ns();
    info_.part = 0;
    parts_.clear();
  }
  writer_.reset();  // closed before room is made
  design_hash_.clear();
  info_.channels = std::move(channels);
  make_room();
  recording::FileInfo next = info_;
  ++next.part;
  // Never a number again that was this recording's, also where its file has been removed.
  const std::int64_t number = std::max(recording::next_part(options_.file), last_number_ + 1);
  const std::string path = recording::part_name(options_.file, number);
  writer_ = std::make_unique<recording::Writer>(path, next);
  info_ = std::move(next);
  last_number_ = number;
  parts_.push_back(path);
  spdlog::info("recording to {}", path);
}

void Recorder::make_room() {
  while (parts_.size() > 1 && parts_.size() >= as_size(options_.max_files)) {
    std::error_code gone;  // what cannot be removed stays
    std::filesystem::remove(parts_[1], gone);
    parts_.erase(parts_.begin() + 1);
  }
}

void Recorder::give_up(const std::string& why) {
  if (writer_) feed_->count_unwritten(writer_->pending());
  writer_.reset();
  next_try_ = steady_clock::now() + retry_after;
  notices_.post(
      {.kind = idl::EventKind::recording,
       .raised = true,
       .text = "recording has stopped, the monitor goes on and its samples count as records_lost; tried again every " +
               std::to_string(retry_after.count()) + " s: " + why});
}

void Recorder::resume_when_due() {
  if (writer_ || steady_clock::now() < next_try_) return;
  next_try_ = steady_clock::now() + retry_after;
  try {
    begin_part(info_.channels);
  } catch (const files::FileError&) {
    return;  // the event stands
  }
  notices_.post({.kind = idl::EventKind::recording, .text = "recording goes on in " + writer_->path()});
}

template <class Step>
void Recorder::attempt(Step step) {
  if (!writer_) return;
  try {
    step();
  } catch (const std::exception& e) {
    give_up(e.what());
  }
}

void Recorder::run() {
  recording::prepare_hdf5();
  // The flag is read before the queue: what was queued before the stop is still written.
  for (bool last = false; !last;) {
    last = stop_.load(std::memory_order_acquire);
    service::survive("recording", [this] {
      resume_when_due();
      take_all();
    });
    if (!last) std::this_thread::sleep_for(poll);
  }
  attempt([this] {
    writer_->commit(true);
    spdlog::info("{} rows recorded in {}", writer_->rows(), writer_->path());
  });
}

void Recorder::take_all() {
  Record record;
  while (feed_->queue().pop(record)) {
    bool appended = false;
    attempt([&] {
      append(record);
      appended = true;
    });
    feed_->count_unwritten(appended ? 0 : 1);
    if (appended && writer_->pending() >= commit_rows) attempt([this] { commit_when_due(); });
  }
  attempt([this] { commit_when_due(); });
}

void Recorder::append(const Record& record) {
  const std::string_view hash(record.design_hash.data(), record.design_hash.size());
  if (hash != design_hash_) {
    if (auto channels = channels_of(hash); channels != writer_->channels()) begin_part(std::move(channels));
    design_index_ = writer_->design_index(std::string(hash));
    design_hash_ = hash;
  }
  if (writer_->pending() == 0) oldest_pending_ = steady_clock::now();
  writer_->append(record.row, design_index_);
}

recording::Channels Recorder::channels_of(std::string_view hash) {
  const std::lock_guard lock(mutex_);
  return known_.at(std::string(hash));
}

void Recorder::commit_when_due() {
  if (writer_->pending() == 0) return;
  const auto waited = steady_clock::now() - oldest_pending_;
  const bool all = waited >= commit_all_after;
  if (!all && waited < commit_chunks_after && writer_->pending() < commit_rows) return;
  const std::size_t before = writer_->pending();
  writer_->commit(all);
  if (writer_->pending() != before) oldest_pending_ = steady_clock::now();
  if (static_cast<double>(writer_->bytes()) <= bytes_per_mb * static_cast<double>(options_.max_mb)) return;
  writer_->commit(true);
  begin_part(writer_->channels());
}

}  // namespace ehm::monitor
