// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/long_work/progress_bar.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace ehm::long_work {
namespace {

TEST(ProgressBar, ShowsShareAndTimeLeft) {
  std::ostringstream out;
  ProgressBar bar(out, true, 200);
  bar.draw(50, 3.0);  // 3 s for a quarter: 9 s for the rest
  EXPECT_THAT(out.str(), testing::HasSubstr("[##########..............................] 25 %, 9 s left"));
  bar.draw(200, 12.0);
  EXPECT_THAT(out.str(), testing::HasSubstr("100 %, 0 s left"));
  bar.clear();
  EXPECT_THAT(out.str(), testing::EndsWith("\r\x1b[K"));
}

TEST(ProgressBar, IsSilentOffATerminalAndInTheFirstSeconds) {
  std::ostringstream out;
  {
    ProgressBar file(out, false, 200);
    file.draw(50, 3.0);
    ProgressBar early(out, true, 200);
    early.show(50);
  }
  EXPECT_EQ(out.str(), "");
}

}  // namespace
}  // namespace ehm::long_work
