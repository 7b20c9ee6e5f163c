// SPDX-License-Identifier: Apache-2.0
#pragma once
// Stops one thread of a child process as a debugger does, while its other threads run: a loop that really hangs.

#include <gtest/gtest.h>
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace ehm::test {

class StoppedThread {
 public:
  /// @throws std::runtime_error where the system does not let us.
  explicit StoppedThread(pid_t thread) : thread_(thread) {
    if (ptrace(PTRACE_SEIZE, thread_, nullptr, nullptr) != 0)
      throw std::runtime_error(std::string("ptrace: ") + std::strerror(errno));
    ptrace(PTRACE_INTERRUPT, thread_, nullptr, nullptr);
    int status = 0;
    waitpid(thread_, &status, __WALL);
  }
  ~StoppedThread() { ptrace(PTRACE_DETACH, thread_, nullptr, nullptr); }
  StoppedThread(const StoppedThread&) = delete;
  StoppedThread& operator=(const StoppedThread&) = delete;

 private:
  pid_t thread_;
};

}  // namespace ehm::test
