// SPDX-License-Identifier: Apache-2.0
// The line through the EGT margins of an engine, against numbers that follow from how they were made.

#include "monitor/history/history_trend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "monitor/history/history_text.h"

namespace {

using namespace ehm::monitor;
using testing::HasSubstr;

HistoryEntry flight(std::uint32_t number, double egt_k) {
  Flight f;
  f.number = number;
  f.margins = FlightMargins{egt_k, 1.5, 0.001 * egt_k, 0.001};
  return {f, std::nullopt};
}

HistoryEntry wash() {
  return {std::nullopt, Maintenance{Maintenance::Kind::wash, 0, ""}};
}

TEST(MarginTrend, ALineIsFoundAndLeadsToItsLimit) {
  std::vector<HistoryEntry> entries;
  for (std::uint32_t n = 1; n <= 21; ++n) entries.push_back(flight(n, 50.0 - 0.5 * n));
  const MarginTrend trend = margin_trend(entries, 9.5).value();
  EXPECT_EQ(trend.flights, 21u);
  EXPECT_NEAR(trend.per_flight_k, -0.5, 1e-12);
  EXPECT_NEAR(trend.per_flight_sigma_k, 0.0, 1e-9);
  EXPECT_NEAR(trend.a_k, 39.5, 1e-9);
  EXPECT_NEAR(trend.left.value(), 60.0, 1e-6);
}

// Scatter of +-1 K in turn about -0.1 K a flight, 100 flights: sigma_b = sqrt(s^2/sum x^2), s^2 = 1.02, sum x^2 =
// 83325.
TEST(MarginTrend, ScatterWidensTheRange) {
  std::vector<HistoryEntry> entries;
  for (std::uint32_t n = 1; n <= 100; ++n) entries.push_back(flight(n, 40.0 - 0.1 * n + (n % 2 == 0 ? 1.0 : -1.0)));
  const MarginTrend trend = margin_trend(entries, 0.0).value();
  EXPECT_NEAR(trend.per_flight_k, -0.1, 0.001);
  EXPECT_NEAR(trend.per_flight_sigma_k, 0.0035, 1e-4);
  EXPECT_LT(trend.left_least.value(), trend.left.value());
  EXPECT_GT(trend.left_most.value(), trend.left.value());
}

TEST(MarginTrend, StartsAnewAfterMaintenanceWhichHasItsGain) {
  std::vector<HistoryEntry> entries;
  for (std::uint32_t n = 1; n <= 10; ++n) entries.push_back(flight(n, 30.0 - n));
  entries.push_back(wash());
  EXPECT_FALSE(margin_trend(entries, 0.0));
  for (std::uint32_t n = 11; n <= 13; ++n) entries.push_back(flight(n, 45.0 - n));
  EXPECT_EQ(margin_trend(entries, 0.0).value().flights, 3u);
  const auto gains = recoveries(entries);
  ASSERT_EQ(gains.size(), 1u);
  EXPECT_EQ(gains[0].after_flight, 10u);
  EXPECT_NEAR(gains[0].gained_k, 14.0, 1e-12);
  const std::string text = history_text(7, {entries, ""}, 0.0);
  EXPECT_THAT(text, HasSubstr("wash after flight 10: EGT margin +14.0 K"));
  EXPECT_THAT(text, HasSubstr("limit of 0.0 K in 32 flights"));
  EXPECT_THAT(text, HasSubstr("due: a washing or an inspection"));
}

TEST(MarginTrend, WhatDoesNotFallHasNoLimit) {
  std::vector<HistoryEntry> entries;
  for (std::uint32_t n = 1; n <= 5; ++n) entries.push_back(flight(n, 30.0 + n));
  const MarginTrend trend = margin_trend(entries, 0.0).value();
  EXPECT_FALSE(trend.left);
  EXPECT_FALSE(trend.left_least);
  EXPECT_THAT(history_text(7, {entries, ""}, 0.0), HasSubstr("due: nothing, the margin does not fall"));
}

}  // namespace
