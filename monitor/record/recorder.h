#pragma once
// Writes what the cycle thread feeds to files, on a thread of its own.
//
// A file that grows beyond record.max_mb is closed and the next part begun; the oldest parts are removed beyond
// record.max_files. When the disk refuses, recording ends with a message, every further row counts as lost, and the
// monitor goes on.
//
// @throws files::FileError if the file cannot be created or exists; config::ConfigError if the designs' channels
// differ.

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "deploy/recording/writer.h"
#include "monitor/config.h"
#include "monitor/engine_table.h"
#include "monitor/record/record_feed.h"

namespace ehm::monitor {

class Recorder {
 public:
  Recorder(const MonitorConfig& config, const EngineTable& engines);
  /// Writes what is still queued, then ends the thread.
  ~Recorder();

  RecordFeed& feed() { return *feed_; }
  /// Before a table flies: makes its designs known. From any thread.
  /// @throws config::ConfigError if their channels differ.
  void know(const EngineTable& engines);

 private:
  void run();
  void take_all();
  void append(const Record& record);
  void commit_when_due();
  void begin_part(recording::Channels channels);
  recording::Channels channels_of(std::string_view hash);
  /// Runs a step that may fail; recording ends if it does.
  template <class Step>
  void attempt(Step step);

  RecordOptions options_;
  recording::FileInfo info_;
  std::unique_ptr<RecordFeed> feed_;
  std::unique_ptr<recording::Writer> writer_;         ///< null: given up
  std::mutex mutex_;                                  ///< of known_
  std::map<std::string, recording::Channels> known_;  ///< by the hash of their design
  std::string design_hash_;                           ///< of the latest row
  std::int64_t design_index_ = 0;
  std::chrono::steady_clock::time_point oldest_pending_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
