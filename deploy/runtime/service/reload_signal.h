#pragma once
// SIGHUP as a flag: the operator asks for the configuration to be read again.

#include <csignal>

namespace ehm::service {

class ReloadSignal {
 public:
  /// Installs the handler; without it the signal would end the program.
  ReloadSignal() {
    struct sigaction action {};
    action.sa_handler = [](int) { flag() = 1; };
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGHUP, &action, nullptr);
  }
  /// True once for all signals since the last call.
  bool take() const {
    const bool requested = flag() != 0;
    flag() = 0;
    return requested;
  }

 private:
  static volatile std::sig_atomic_t& flag() {
    static volatile std::sig_atomic_t requested = 0;
    return requested;
  }
};

}  // namespace ehm::service
