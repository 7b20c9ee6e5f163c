// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes what the cycle thread feeds to files, on a thread of its own.
//
// A file that grows beyond record.max_mb is closed and the next part begun; beyond record.max_files of them the oldest
// are removed, but never the first, which holds the start of the flight, and never a file that this recorder did not
// make. When the disk refuses, at start or later, the monitor flies on without: rows count as lost, an event tells of
// it, and every ten seconds a new part is tried, until the disk takes it.
//
// @throws config::ConfigError if the designs' channels differ.

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "deploy/runtime/recording/writer.h"
#include "monitor/record/record_feed.h"
#include "monitor/shared/engine_table.h"
#include "monitor/shared/monitor_config.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

class Recorder {
 public:
  Recorder(const MonitorConfig& config, const EngineTable& engines, NoticeBoard& notices);
  /// Writes what is still queued, then ends the thread.
  ~Recorder();

  RecordFeed& feed() { return *feed_; }
  /// Before a table flies: makes its designs known. From any thread.
  /// @throws config::ConfigError if their channels differ.
  void add_engines(const EngineTable& engines);

 private:
  void run();
  void take_all();
  void append(const Record& record);
  void commit_when_due();
  void begin_part(recording::Channels channels);
  void make_room();
  void resume_when_due();
  void give_up(const std::string& why);
  recording::Channels channels_of(std::string_view hash);
  /// Runs a step that may fail; recording pauses if it does.
  template <class Step>
  void attempt(Step step);

  RecordOptions options_;
  recording::FileInfo info_;
  std::unique_ptr<RecordFeed> feed_;
  NoticeBoard& notices_;
  std::unique_ptr<recording::Writer> writer_;         ///< null: the disk refused
  std::vector<std::string> parts_;                    ///< made by this recorder and still there, the oldest first
  std::int64_t last_number_ = 0;                      ///< of the latest of them
  std::chrono::steady_clock::time_point next_try_;    ///< while there is no writer
  std::mutex mutex_;                                  ///< of known_
  std::map<std::string, recording::Channels> known_;  ///< by the hash of their design
  std::string design_hash_;                           ///< of the latest row
  std::int64_t design_index_ = 0;
  std::chrono::steady_clock::time_point oldest_pending_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
