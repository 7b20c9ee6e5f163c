// SPDX-License-Identifier: Apache-2.0
#pragma once
// SIGHUP: reads configuration and designs again, and hands the new engine table to the cycle thread, which takes it
// between two samples. Reading, checking and building all happen on this thread. What is invalid, or cannot change
// while flying, is refused with its reason, and the old one flies on.

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "deploy/runtime/service/reload_signal.h"
#include "monitor/reload/table_exchange.h"
#include "monitor/shared/monitor_config.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

/// A configuration and the text of each of its keys.
struct LoadedConfig {
  MonitorConfig config;
  std::map<std::string, std::string> values;
};

struct ReloadSource {
  std::map<std::string, std::string> flying;  ///< the text of each key at start
  /// Reads the same files, environment and command line again; throws what is wrong with them.
  std::function<LoadedConfig()> read;
};

/// Why `wanted` cannot replace `flying` in flight: each key, its flying and its wanted value; empty if it can.
std::string refused_changes(const std::map<std::string, std::string>& flying,
                            const std::map<std::string, std::string>& wanted);

class Reloader {
 public:
  struct Hooks {
    /// Sees each new table before it flies; what it throws refuses the reload.
    std::function<void(const EngineTable&)> before;
    /// Returns once no report that was queued before the call points into a table any more.
    std::function<void()> await_reported;
  };
  /// `table` flies at start; it is kept for as long as it does.
  Reloader(const ReloadSource& source, std::unique_ptr<EngineTable> table, TableExchange& exchange,
           NoticeBoard& notices, Hooks hooks);
  ~Reloader();

 private:
  void run();
  void reload();
  void retire(std::unique_ptr<EngineTable> table);

  std::function<LoadedConfig()> read_;
  Hooks hooks_;
  TableExchange& exchange_;
  NoticeBoard& notices_;
  service::ReloadSignal signal_;
  std::map<std::string, std::string> flying_;
  std::unique_ptr<EngineTable> current_;  ///< flies
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
