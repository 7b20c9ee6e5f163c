// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/truth_sources.h"

#include <gtest/gtest.h>

namespace {

using namespace ehm;
using demo::TruthSources;

constexpr std::uint64_t engine = 11, other = 22, third = 33;

EngineTruth truth(std::uint64_t sequence, std::int64_t source_time_ns, double health = 0.0) {
  EngineTruth t;
  t.sequence_number(sequence);
  t.source_time_ns(source_time_ns);
  t.health()[0] = health;
  return t;
}

TEST(TruthSources, OnlyWhoDescribesTheEngineCounts) {
  TruthSources sources;
  sources.describe(engine);
  sources.hear(truth(5, 500, -0.01), engine);
  sources.hear(truth(5, 500, 9.0), other);
  sources.follow(5, 500);
  ASSERT_NE(sources.find(5, 500), nullptr);
  EXPECT_EQ(sources.find(5, 500)->health()[0], -0.01);
  EXPECT_EQ(sources.ignored(), 1u);
  ASSERT_NE(sources.last(), nullptr);
  EXPECT_EQ(sources.last()->health()[0], -0.01);
}

TEST(TruthSources, TruthAloneCountsForNothing) {
  TruthSources sources;
  sources.hear(truth(5, 500), other);
  sources.follow(5, 500);
  EXPECT_EQ(sources.find(5, 500), nullptr);
  EXPECT_EQ(sources.last(), nullptr);
  EXPECT_FALSE(sources.described());
  EXPECT_EQ(sources.ignored(), 1u);
}

TEST(TruthSources, ATruthThatComesBeforeItsDescriptionIsNotHeldAgainstIt) {
  TruthSources sources;
  sources.hear(truth(0, 100), engine);
  sources.describe(engine);
  EXPECT_EQ(sources.ignored(), 0u);
}

// Two simulators of one engine: the monitor follows one, and the stamps of the estimates tell which.
TEST(TruthSources, OfTwoSourcesTheOneCountsThatTheEstimatesAreMadeFrom) {
  TruthSources sources;
  sources.describe(other);
  sources.describe(engine);
  for (std::uint64_t k = 0; k < 10; ++k) {
    sources.hear(truth(k, 7000 + static_cast<std::int64_t>(k), 9.0), other);
    sources.hear(truth(k, 100 + static_cast<std::int64_t>(k), -0.01), engine);
    sources.follow(k, 100 + static_cast<std::int64_t>(k));
  }
  EXPECT_EQ(sources.find(9, 109)->health()[0], -0.01);
  EXPECT_EQ(sources.ignored(), 10u);
  EXPECT_EQ(sources.last()->source_time_ns(), 109);
}

TEST(TruthSources, WhoDescribedFirstCountsWhereBothBearTheStamp) {
  TruthSources sources;
  sources.describe(engine);
  sources.describe(other);
  sources.hear(truth(1, 100, 9.0), other);
  sources.hear(truth(1, 100, -0.01), engine);
  sources.follow(1, 100);
  EXPECT_EQ(sources.find(1, 100)->health()[0], -0.01);
  EXPECT_EQ(sources.ignored(), 1u);
}

TEST(TruthSources, ARestartedSourceIsFollowedAgain) {
  TruthSources sources;
  sources.describe(engine);
  sources.hear(truth(100, 100), engine);
  sources.follow(100, 100);
  sources.describe(third);
  sources.hear(truth(0, 900), third);
  sources.hear(truth(1, 915), third);
  EXPECT_EQ(sources.ignored(), 2u);
  sources.follow(1, 915);
  EXPECT_EQ(sources.ignored(), 0u);
  EXPECT_EQ(sources.last()->sequence_number(), 1u);
}

TEST(TruthSources, OldTruthIsForgotten) {
  TruthSources sources;
  sources.describe(engine);
  for (std::uint64_t k = 0; k < 65; ++k) sources.hear(truth(k, 1), engine);
  EXPECT_EQ(sources.find(0, 1), nullptr);
  EXPECT_NE(sources.find(1, 1), nullptr);
}

TEST(TruthSources, AFloodOfParticipantsLosesNoCountAndNotTheSource) {
  TruthSources sources;
  sources.describe(engine);
  sources.hear(truth(5, 500), engine);
  sources.follow(5, 500);
  for (std::uint64_t participant = 1000; participant < 1100; ++participant) sources.hear(truth(5, 500), participant);
  EXPECT_EQ(sources.ignored(), 100u);
  for (std::uint64_t participant = 2000; participant < 2100; ++participant) sources.describe(participant);
  EXPECT_NE(sources.find(5, 500), nullptr);
  EXPECT_NE(sources.last(), nullptr);
}

}  // namespace
