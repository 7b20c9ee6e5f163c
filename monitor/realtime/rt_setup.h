// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the operating system can do for the cycle thread: priority, processors, memory that stays, a stack that is
// there.
//
// Nothing of this is needed to run. Where the system refuses, the answer is a warning with the remedy, and the service
// goes on as a normal process does.

#include <sched.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ehm::monitor {

struct RealtimeOptions {
  std::string policy = "other";          ///< "fifo": SCHED_FIFO
  std::int64_t priority = 50;            ///< of SCHED_FIFO, 1 to 99
  bool middleware_threads = false;       ///< the threads of DDS, which receive the samples, get the policy too
  std::string cpus;                      ///< "0,2-3"; empty: all
  bool lock_memory = false;              ///< mlockall
  std::int64_t prefault_stack_kb = 256;  ///< of the cycle thread
};

/// "0,2-3" as 0, 2, 3; nothing of an empty text. @throws std::invalid_argument if the text is no such list (says what
/// is allowed).
std::vector<int> parse_cpu_list(const std::string& text);

/// While it lives the calling thread is set up as asked for, and the memory of the process from then on. Make it last
/// before the loop: threads that are made meanwhile inherit the processors.
class RealtimeThread {
 public:
  explicit RealtimeThread(const RealtimeOptions& options);
  ~RealtimeThread();
  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;
  /// One with its remedy for each wish that was refused.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  cpu_set_t cpus_{};  ///< before
  bool fifo_ = false;
  std::vector<std::string> warnings_;
};

/// While it lives, threads that the caller makes inherit the policy: DDS offers no other way to its own. Does nothing
/// without middleware_threads, and where the system refuses; RealtimeThread warns of it then.
class MiddlewarePolicy {
 public:
  explicit MiddlewarePolicy(const RealtimeOptions& options);
  ~MiddlewarePolicy();
  MiddlewarePolicy(const MiddlewarePolicy&) = delete;
  MiddlewarePolicy& operator=(const MiddlewarePolicy&) = delete;

 private:
  bool set_ = false;
};

}  // namespace ehm::monitor
