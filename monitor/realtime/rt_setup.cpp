// SPDX-License-Identifier: Apache-2.0
#include "monitor/realtime/rt_setup.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {

namespace {

[[noreturn]] void refuse(const std::string& list) {
  throw std::invalid_argument("'realtime.cpus' is '" + list + "', allowed is a list of processor numbers from 0 to " +
                              std::to_string(CPU_SETSIZE - 1) + " and ascending ranges of them, such as 0,2-3");
}

/// The number that is all of `text`, a part of `list`.
int cpu_number(const std::string& list, std::string_view text) {
  int value = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0 || value >= CPU_SETSIZE) refuse(list);
  return value;
}

bool set_policy(int policy, std::int64_t priority) {
  sched_param parameter{};
  parameter.sched_priority = static_cast<int>(priority);
  return sched_setscheduler(0, policy, &parameter) == 0;
}

std::string refused(const std::string& what, const std::string& consequence, const std::string& remedy) {
  return what + " was refused (" + std::strerror(errno) + "): " + consequence + ". Remedy: " + remedy;
}

void set_cpus(const RealtimeOptions& options, std::vector<std::string>& warnings) {
  if (options.cpus.empty()) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int cpu : parse_cpu_list(options.cpus)) CPU_SET(as_size(cpu), &set);
  if (sched_setaffinity(0, sizeof(set), &set) != 0)
    warnings.push_back(refused("realtime.cpus = " + options.cpus, "the cycle runs on any processor",
                               "name processors that exist here and that this process may use (nproc --all; systemd: "
                               "AllowedCPUs=)"));
}

/// Touches the pages below the caller, so that no first use of them faults on the cycle path. The value has no meaning;
/// it keeps the pages in use across the call.
char prefault_stack(std::int64_t kilobytes) {
  volatile char pages[16 * 1024] = {};
  return kilobytes <= 16 ? pages[0] : static_cast<char>(pages[0] + prefault_stack(kilobytes - 16));
}

void lock_memory(std::vector<std::string>& warnings) {
  // Under a finite limit, memory that is asked for later would be refused for being locked: then only what is there.
  rlimit limit{};
  const bool unlimited = getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
  if (mlockall(MCL_CURRENT | (unlimited ? MCL_FUTURE : 0)) != 0)
    warnings.push_back(refused("realtime.lock_memory", "pages may be swapped out",
                               "raise the limit (systemd: LimitMEMLOCK=infinity; shell: ulimit -l unlimited) or grant "
                               "the capability (setcap cap_ipc_lock+ep monitor)"));
}

}  // namespace

std::vector<int> parse_cpu_list(const std::string& text) {
  std::vector<int> cpus;
  if (text.empty()) return cpus;
  std::istringstream list(text + ",");
  for (std::string item; std::getline(list, item, ',');) {
    const std::size_t dash = item.find('-');
    const int first = cpu_number(text, std::string_view(item).substr(0, dash));
    const int last = dash == std::string::npos ? first : cpu_number(text, std::string_view(item).substr(dash + 1));
    if (last < first) refuse(text);
    for (int cpu = first; cpu <= last; ++cpu) cpus.push_back(cpu);
  }
  return cpus;
}

RealtimeThread::RealtimeThread(const RealtimeOptions& options) {
  sched_getaffinity(0, sizeof(cpus_), &cpus_);
  set_cpus(options, warnings_);
  if (options.prefault_stack_kb > 0) prefault_stack(options.prefault_stack_kb);
  if (options.lock_memory) lock_memory(warnings_);
  fifo_ = options.policy == "fifo" && set_policy(SCHED_FIFO | SCHED_RESET_ON_FORK, options.priority);
  if (options.policy == "fifo" && !fifo_)
    warnings_.push_back(refused(
        "realtime.policy = fifo with priority " + std::to_string(options.priority),
        "the cycle runs with normal priority",
        "raise the limit (systemd: LimitRTPRIO=" + std::to_string(options.priority) +
            "; shell: ulimit -r) or grant the capability (setcap cap_sys_nice+ep monitor); in a container, the host "
            "must grant it"));
}

RealtimeThread::~RealtimeThread() {
  if (fifo_) set_policy(SCHED_OTHER, 0);
  if (CPU_COUNT(&cpus_) > 0) sched_setaffinity(0, sizeof(cpus_), &cpus_);
}

MiddlewarePolicy::MiddlewarePolicy(const RealtimeOptions& options) {
  set_ = options.policy == "fifo" && options.middleware_threads && set_policy(SCHED_FIFO, options.priority);
}

MiddlewarePolicy::~MiddlewarePolicy() {
  if (set_) set_policy(SCHED_OTHER, 0);
}

}  // namespace ehm::monitor
