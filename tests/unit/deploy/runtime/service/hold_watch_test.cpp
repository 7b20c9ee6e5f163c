// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/hold_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

namespace ehm::idl {
namespace {

using std::chrono::milliseconds;

TEST(HoldWatch, TellsOnceOfAHoldAndHowLongItWas) {
  HoldWatch watch(0.05);
  std::this_thread::sleep_for(milliseconds(80));  // the hold itself
  const double held_up_s = watch.held_up_s();
  EXPECT_GE(held_up_s, 0.08);
  EXPECT_LT(held_up_s, 10.0);
  HoldWatch patient(5.0);
  EXPECT_EQ(patient.held_up_s(), 0.0);
  std::this_thread::sleep_for(milliseconds(80));
  EXPECT_EQ(patient.held_up_s(), 0.0);
}

TEST(HoldWatch, NeverSpeaksUnderAnInfiniteLease) {
  HoldWatch watch(std::numeric_limits<double>::infinity());
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_EQ(watch.held_up_s(), 0.0);
}

}  // namespace
}  // namespace ehm::idl
