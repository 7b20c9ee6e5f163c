#pragma once
// SIGINT and SIGTERM as a flag that loops poll and sleeps are interrupted by.

#include <csignal>

namespace ehm::service {

class StopSignal {
 public:
  /// Installs the handlers; without SA_RESTART, so that a blocking sleep returns at once.
  StopSignal() {
    struct sigaction action {};
    action.sa_handler = [](int) { requested_flag() = 1; };
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
  }
  bool requested() const { return requested_flag() != 0; }

 private:
  static volatile std::sig_atomic_t& requested_flag() {
    static volatile std::sig_atomic_t flag = 0;
    return flag;
  }
};

}  // namespace ehm::service
