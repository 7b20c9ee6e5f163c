// SPDX-License-Identifier: Apache-2.0
#pragma once
// A service under test as a real process: started, signalled, awaited, its log kept, never left behind.

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace ehm::test {

class Process {
 public:
  /// Starts `arguments[0]`; standard output and error go to a log file of its own.
  explicit Process(std::vector<std::string> arguments);
  /// Kills it if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t pid() const { return pid_; }
  void signal(int number) const;
  /// Exit code, 128 + signal number if a signal ended it, nothing if it still runs after the limit.
  std::optional<int> wait(std::chrono::milliseconds limit);
  bool running() { return !wait(std::chrono::milliseconds(0)); }
  std::string log() const;

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::string log_path_;
};

}  // namespace ehm::test
