// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/qualification.h"

#include <gtest/gtest.h>

namespace {

using ehm::monitor::CheckOptions;
using ehm::monitor::Qualification;
using State = Qualification::State;

CheckOptions options() {
  CheckOptions o;
  o.bridge_samples = 5;
  o.requalify_samples = 10;
  return o;
}

TEST(Qualification, BridgesAFewBadValues) {
  Qualification q;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(q.observe(false, options()), State::bridged) << i;
  EXPECT_EQ(q.observe(true, options()), State::trusted);
}

TEST(Qualification, ExcludesAfterTheBridge) {
  Qualification q;
  for (int i = 0; i < 5; ++i) q.observe(false, options());
  EXPECT_EQ(q.observe(false, options()), State::excluded);
}

TEST(Qualification, RequalifiesOnlyAfterAnUnbrokenRun) {
  Qualification q;
  for (int i = 0; i < 6; ++i) q.observe(false, options());
  for (int i = 0; i < 9; ++i) EXPECT_EQ(q.observe(true, options()), State::excluded) << i;
  EXPECT_EQ(q.observe(false, options()), State::excluded);  // starts anew
  for (int i = 0; i < 9; ++i) EXPECT_EQ(q.observe(true, options()), State::excluded) << i;
  EXPECT_EQ(q.observe(true, options()), State::trusted);
}

}  // namespace
