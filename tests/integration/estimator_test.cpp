// SPDX-License-Identifier: Apache-2.0
// Estimators beside the published one, on real DDS: each under its own topic, sample by sample, with the same sensors.

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

/// Estimates by sequence number.
template <class T>
std::map<std::uint64_t, T> by_sequence(const std::vector<T>& samples) {
  std::map<std::uint64_t, T> sorted;
  for (const T& sample : samples) sorted[sample.sequence_number()] = sample;
  return sorted;
}

template <class T>
void take_all(idl::Reader<T>& reader, std::vector<T>& samples) {
  for (T sample; reader.take(sample);) samples.push_back(sample);
}

class EstimatorTest : public PairTest {
 protected:
  /// Flies eight seconds, ten times real time: this reader must see every sample, and lockstep waits for the monitor only.
  /// Gathers what the topics of `estimator` bring.
  void fly(const std::vector<std::string>& flags, const std::string& estimator) {
    idl::Reader<EngineHealth> health(participant_, estimator);
    idl::Reader<EngineAuxiliary> auxiliary(participant_, estimator);
    const auto monitor = start_monitor(flags);
    ASSERT_TRUE(listener_.await([&] { return health.matched() > 0 && auxiliary.matched() > 0; })) << monitor->log();
    const auto simulator = start_simulator({"--run-duration-s", "8", "--rate", "10"});
    ASSERT_TRUE(listener_.await([&] {
      take_all(health, health_);
      take_all(auxiliary, auxiliary_);
      return !simulator->running() && listener_.health.size() >= 533 && health_.size() >= 533;
    })) << listener_.health.size()
        << " published, " << health_.size() << " of " << estimator;
    take_all(auxiliary, auxiliary_);
  }

  std::vector<EngineHealth> health_;
  std::vector<EngineAuxiliary> auxiliary_;
};

TEST_F(EstimatorTest, AShadowIsPublishedBesideUnderItsOwnName) {
  fly({"--estimator-shadow", "time_varying,gauss_markov", "--monitor-clock", "source"}, "gauss_markov");
  const auto published = by_sequence(listener_.health), shadow = by_sequence(health_);
  const auto outputs = by_sequence(auxiliary_);
  ASSERT_GE(shadow.size(), 533u);
  for (const auto& [sequence, estimate] : shadow) {
    ASSERT_TRUE(published.contains(sequence) && outputs.contains(sequence)) << sequence;
    const EngineHealth& watch = published.at(sequence);
    EXPECT_EQ(estimate.source_time_ns(), watch.source_time_ns());
    EXPECT_EQ(estimate.sensors_used(), watch.sensors_used());
    EXPECT_EQ(estimate.health_count(), 10u);
    EXPECT_EQ(estimate.tuner_count(), 0u);  // it has none
    EXPECT_EQ(watch.tuner_count(), 7u);
    EXPECT_GT(outputs.at(sequence).auxiliary()[0], 1000.0);  // T40, K
  }
  // Both are honest of the same engine, so they agree within their sigmas; and they are not the same filter.
  const EngineHealth &one = published.rbegin()->second, &other = shadow.at(published.rbegin()->first);
  double apart = 0.0;
  for (std::size_t i = 0; i < 10; ++i) {
    const double sigma = std::hypot(one.sigma_total()[i], other.sigma_total()[i]);
    apart = std::max(apart, std::abs(one.health()[i] - other.health()[i]) / sigma);
  }
  EXPECT_LT(apart, 3.0);
  EXPECT_GT(apart, 0.0);
}

TEST_F(EstimatorTest, AnotherOneIsPublishedAndTheTunerFilterFliesBeside) {
  fly({"--estimator-published", "time_varying", "--estimator-shadow", "tuner", "--monitor-clock", "source"}, "tuner");
  const auto published = by_sequence(listener_.health), shadow = by_sequence(health_);
  ASSERT_GE(shadow.size(), 533u);
  EXPECT_EQ(published.rbegin()->second.tuner_count(), 0u);
  EXPECT_EQ(shadow.rbegin()->second.tuner_count(), 7u);
}

}  // namespace
