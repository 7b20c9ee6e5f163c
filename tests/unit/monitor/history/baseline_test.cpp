// SPDX-License-Identifier: Apache-2.0
// A baseline as a file: what was written is read, what was damaged is named; and how flights add up to one.

#include "monitor/history/baseline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/files/file_error.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using testing::HasSubstr;

estimation::Learned learned(double first) {
  estimation::Learned l;
  l.value.resize(3);
  l.value << first, -0.25, 1.0 / 3.0;
  l.covariance.resize(3, 3);
  l.covariance << 0.5, 0.1, 0.0, 0.1, 0.25, 0.02, 0.0, 0.02, 1.0;
  return l;
}

Baseline some_baseline() {
  Baseline b;
  b.engine_id = 7;
  b.engine_type = "jt9d";
  b.names = {"fan_efficiency", "hpt_flow", "fan_nozzle_area"};
  count_flight(b, learned(-1.5), 1'000, 3);
  return b;
}

std::string refusal(const std::string& text) {
  try {
    parse_baseline(text, "b.json");
  } catch (const files::FileError& error) {
    return error.what();
  }
  return "";
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = to_text(some_baseline());
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(Baseline, IsReadAsItWasWritten) {
  const Baseline b = some_baseline(), read = parse_baseline(to_text(b), "b.json");
  EXPECT_EQ(read.engine_id, 7u);
  EXPECT_EQ(read.engine_type, "jt9d");
  EXPECT_EQ(read.names, b.names);
  EXPECT_EQ(read.latest.value, b.latest.value);
  EXPECT_EQ(read.first.covariance, b.first.covariance);
  EXPECT_EQ(to_text(read), to_text(b));
}

TEST(Baseline, TheFirstFlightsAreWhatWearIsCountedFrom) {
  Baseline b = some_baseline();
  for (int flight = 2; flight <= 5; ++flight) count_flight(b, learned(-flight), 1'000 * flight, 3);
  EXPECT_EQ(b.flights, 5u);
  EXPECT_EQ(b.flights_of_first, 3u);
  EXPECT_EQ(b.first.value(0), -3.0);
  EXPECT_EQ(b.latest.value(0), -5.0);
  EXPECT_EQ(b.landing_ns, 5'000);
}

TEST(Baseline, WhatIsDamagedIsNamed) {
  EXPECT_THAT(refusal(with("-1.5", "-1.6")), HasSubstr("b.json: hash is"));
  EXPECT_THAT(refusal(with("ehm-baseline/1", "ehm-baseline/9")), HasSubstr("\"ehm-baseline/1\""));
  EXPECT_THAT(refusal(to_text(some_baseline()).substr(0, 200)), HasSubstr("b.json"));
  EXPECT_THAT(refusal("{}"), HasSubstr("schema"));
  Baseline b = some_baseline();
  b.latest.covariance(0, 0) = -0.5;
  EXPECT_THAT(refusal(to_text(b)), HasSubstr("latest.covariance[0][0]"));
  b = some_baseline();
  b.names.pop_back();
  EXPECT_THAT(refusal(to_text(b)), HasSubstr("first.value"));
  b = some_baseline();
  b.flights_of_first = 9;
  EXPECT_THAT(refusal(to_text(b)), HasSubstr("flights_of_first is 9; allowed: 1 to 1"));
}

}  // namespace
