// SPDX-License-Identifier: Apache-2.0
#pragma once
// Notices that the process was held up: stopped by a signal or a debugger, or the whole machine suspended.
//
// Who does not announce itself for the lease of its participant is dropped by the others. Their announcements wait in
// our sockets meanwhile, so that we do not drop them, and from then on the two sides know different things of each
// other: Fast DDS 2.9.1 finds the participant again but never its endpoints, and no sample passes any more, for good
// (measured: 6 s stopped with a lease of 5 s). Only a new participant, whom nobody has known before, gets through.
//
// The clock counts while the machine is suspended (CLOCK_BOOTTIME). Real-time safe: yes.

#include <time.h>

#include <cstdint>

namespace ehm::idl {

class HoldWatch {
 public:
  /// `limit_s`: a longer time between two calls of held_up_s() is a hold; infinite for never.
  explicit HoldWatch(double limit_s) noexcept : limit_s_(limit_s), last_ns_(now_ns()) {}
  /// Seconds since the last call if that is a hold, else 0.
  double held_up_s() noexcept {
    const std::int64_t now = now_ns();
    const double since_s = 1e-9 * static_cast<double>(now - last_ns_);
    last_ns_ = now;
    return since_s > limit_s_ ? since_s : 0.0;
  }

 private:
  static std::int64_t now_ns() noexcept {
    timespec t{};
    clock_gettime(CLOCK_BOOTTIME, &t);
    return t.tv_sec * std::int64_t{1'000'000'000} + t.tv_nsec;
  }
  double limit_s_;
  std::int64_t last_ns_;
};

}  // namespace ehm::idl
