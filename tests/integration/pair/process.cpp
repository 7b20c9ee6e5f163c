// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/pair/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace ehm::test {

Process::Process(std::vector<std::string> arguments) {
  static std::atomic<int> number{0};
  log_path_ = testing::TempDir() + "ehm-" + std::to_string(getpid()) + "-" + std::to_string(number++) + ".log";
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int log = open(log_path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
}

Process::~Process() {
  if (!exit_code_) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (testing::Test::HasFailure()) std::fprintf(stderr, "--- log of process %d\n%s", pid_, log().c_str());
  std::remove(log_path_.c_str());
}

void Process::signal(int number) const {
  kill(pid_, number);
}

std::optional<int> Process::wait(std::chrono::milliseconds limit) {
  if (exit_code_) return exit_code_;
  // The process descriptor becomes readable when the process ends.
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  pollfd ended{descriptor, POLLIN, 0};
  poll(&ended, 1, static_cast<int>(limit.count()));
  close(descriptor);
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == pid_)
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return exit_code_;
}

std::string Process::log() const {
  const auto read = [this] {
    std::ostringstream text;
    text << std::ifstream(log_path_).rdbuf();
    return text.str();
  };
  // Services write from a thread of their own: the line of what was just heard may still be on its way.
  constexpr int most_looks = 20;
  std::string text = read();
  for (int look = 0; look < most_looks && !exit_code_; ++look) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::string later = read();
    if (later == text) break;
    text = std::move(later);
  }
  return text;
}

}  // namespace ehm::test
