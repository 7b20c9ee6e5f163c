// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/long_work/progress_bar.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ehm::long_work {

ProgressBar::ProgressBar(std::ostream& out, bool terminal, std::size_t total)
    : out_(out), terminal_(terminal), total_(total) {}

ProgressBar::~ProgressBar() {
  clear();
}

void ProgressBar::show(std::size_t done) {
  if (!terminal_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + std::chrono::milliseconds(100);
  draw(done, std::chrono::duration<double>(now - start_).count());
}

void ProgressBar::draw(std::size_t done, double elapsed_s) {
  if (!terminal_ || done == 0) return;
  constexpr std::size_t width = 40;
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const auto filled = static_cast<std::size_t>(share * width);
  const double left_s = elapsed_s * (1.0 - share) / share;
  out_ << "\r[" << std::string(filled, '#') << std::string(width - filled, '.') << "] "
       << static_cast<int>(100.0 * share) << " %, " << static_cast<long>(std::ceil(left_s)) << " s left \x1b[K"
       << std::flush;
  drawn_ = true;
}

void ProgressBar::clear() {
  if (drawn_) out_ << "\r\x1b[K" << std::flush;
  drawn_ = false;
}

}  // namespace ehm::long_work
