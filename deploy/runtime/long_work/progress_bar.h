// SPDX-License-Identifier: Apache-2.0
#pragma once
// A progress bar on a terminal, with the time left, for what takes longer than two seconds:
//   [##########..........] 50 %, 12 s left
// Time left = elapsed (total - done)/done. Elsewhere than on a terminal nothing is written. Errors: none.

#include <chrono>
#include <cstddef>
#include <ostream>

namespace ehm::long_work {

class ProgressBar {
 public:
  /// `total` for work that counts nothing, and tells its share by show_share.
  static constexpr std::size_t shares = 1000;

  ProgressBar(std::ostream& out, bool terminal, std::size_t total);
  /// Takes the bar away.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Cheap: it draws ten times a second at most.
  void show(std::size_t done);
  /// `share` of the total, 0 to 1.
  void show_share(double share) { show(static_cast<std::size_t>(share * static_cast<double>(total_))); }
  /// The same for any time since the start.
  void draw(std::size_t done, double elapsed_s);
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  std::ostream& out_;
  bool terminal_;
  std::size_t total_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(2);
  bool drawn_ = false;
};

}  // namespace ehm::long_work
