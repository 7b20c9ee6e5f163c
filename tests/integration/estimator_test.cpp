// SPDX-License-Identifier: Apache-2.0
// Estimators beside the published one, on real DDS: each under its own topic, sample by sample, with the same sensors.

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <map>

#include "idl/wire_names.h"
#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

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

// A topic is written while somebody listens to it (ranked_writer.h), and a second reader finds it as the first did.
TEST_F(PairTest, WhoListensLateHearsEverySampleFromThenOn) {
  const auto monitor = start_monitor({"--estimator-shadow", "gauss_markov"});
  const auto simulator = start_simulator();
  ASSERT_TRUE(listener_.await([&] { return listener_.health.size() > 50; })) << monitor->log();
  for (int reader = 0; reader < 2; ++reader) {
    idl::Reader<EngineHealth> late(participant_, "gauss_markov");
    std::vector<EngineHealth> heard;
    ASSERT_TRUE(listener_.await([&] {
      take_all(late, heard);
      return heard.size() >= 50;
    })) << monitor->log();
    std::uint64_t expected = heard.front().sequence_number();
    EXPECT_GT(expected, 50u);
    for (const EngineHealth& estimate : heard) ASSERT_EQ(estimate.sequence_number(), expected++);
  }
  EXPECT_EQ(listener_.status.back().writes_refused(), 0u);
}

/// Orders, and what becomes of them: samples are sent one by one, so that every order falls between two of them.
class ChoiceTest : public PairTest {
 protected:
  void start(std::vector<std::string> flags) {
    flags.insert(flags.end(), {"--monitor-clock", "source"});  // a pause of ours is no silence of the engine
    monitor_ = start_monitor(flags);
    ASSERT_TRUE(listener_.await([&] { return writer_.matched() == 2 && commands_.matched() == 1; })) << monitor_->log();
  }
  void send() {
    writer_.write(last_ = samples_.next());
    ++sent_;
  }
  /// The monitor matches our readers when it will, and what it publishes before is lost: samples until we hear it.
  void await_first_estimates() {
    auto due = std::chrono::steady_clock::now();
    ASSERT_TRUE(listener_.await([&] {
      take_all(shadow_, shadow_health_);
      if (!listener_.health.empty() && !shadow_health_.empty()) return true;
      if (std::chrono::steady_clock::now() >= due) {
        send();
        due += std::chrono::milliseconds(15);
      }
      return false;
    })) << monitor_->log();
  }
  /// Sends so many and awaits the estimate of the last.
  void send(int samples) {
    if (sent_ == 0) {
      ASSERT_NO_FATAL_FAILURE(await_first_estimates());
    }
    for (int k = 0; k < samples; ++k) send();
    ASSERT_TRUE(listener_.await([&] {
      take_all(shadow_, shadow_health_);
      return !listener_.health.empty() && !shadow_health_.empty() &&
             listener_.health.back().sequence_number() == last_.sequence_number() &&
             shadow_health_.back().sequence_number() == last_.sequence_number();
    })) << monitor_->log();
  }
  CommandReply order(const char* estimator) {
    MonitorCommand command;
    command.engine_id(1);
    command.schema(idl::schema_version);
    command.kind(static_cast<std::uint32_t>(idl::MonitorCommandKind::publish) +
                 static_cast<std::uint32_t>(idl::estimator_number(estimator)));
    command.request(++requests_);
    commands_.write(command);
    CommandReply reply;
    EXPECT_TRUE(listener_.await([&] {
      while (replies_.take(reply))
        if (reply.request() == requests_) return true;
      return false;
    }));
    return reply;
  }

  std::unique_ptr<Process> monitor_;
  EngineSamples samples_{design_file(), 1};
  EngineSensors last_;
  int sent_ = 0;
  std::uint32_t requests_ = 0;
  idl::Writer<EngineSensors> writer_{participant_};
  idl::Writer<MonitorCommand> commands_{participant_};
  idl::Reader<CommandReply> replies_{participant_};
  idl::Reader<EngineHealth> shadow_{participant_, "gauss_markov"};
  std::vector<EngineHealth> shadow_health_;
};

TEST_F(ChoiceTest, AnOrderPublishesAnotherWithoutAGapAndOfflineRepeatsIt) {
  const TemporaryFolder folder;
  start({"--estimator-shadow", "gauss_markov", "--record", folder.path("online.h5")});
  ASSERT_NO_FATAL_FAILURE(send(200));
  EXPECT_NE(listener_.health.back().health(), shadow_health_.back().health());

  CommandReply reply = order("gauss_markov");
  EXPECT_EQ(reply.accepted(), 1u);
  EXPECT_STREQ(reply.message().c_str(), "estimates of gauss_markov are published");
  EXPECT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::estimator_chosen, true); }));
  ASSERT_NO_FATAL_FAILURE(send(100));
  EXPECT_EQ(listener_.health.back().health(), shadow_health_.back().health());
  EXPECT_EQ(listener_.health.back().tuner_count(), 0u);

  reply = order("time_varying");
  EXPECT_EQ(reply.accepted(), 0u);
  EXPECT_THAT(reply.message().c_str(), testing::HasSubstr("time_varying does not fly for 1 of 1 engines"));
  EXPECT_EQ(order("tuner").accepted(), 1u);
  ASSERT_NO_FATAL_FAILURE(send(100));
  EXPECT_EQ(listener_.health.back().tuner_count(), 7u);
  std::uint64_t expected = listener_.health.front().sequence_number();
  for (const EngineHealth& health : listener_.health) ASSERT_EQ(health.sequence_number(), expected++);

  monitor_->signal(SIGTERM);
  ASSERT_EQ(monitor_->wait(seconds(10)), 0);
  Process offline({monitor_program(), "--monitor-design", design_file(), "--estimator-shadow", "gauss_markov",
                   "--offline", folder.path("online.h5"), "--out", folder.path("again.h5")});
  ASSERT_EQ(offline.wait(seconds(30)), 0) << offline.log();
  EXPECT_THAT(offline.log(), testing::HasSubstr(std::to_string(2 * sent_) + " identical to the bit, 0 different"));
}

TEST_F(ChoiceTest, AnEngineFliesTheEstimatorsOfItsTable) {
  const std::string config = file("engines.toml", "[[engine]]\nids = [1]\ndesign = \"" + design_file() +
                                                      "\"\npublished = \"time_varying\"\nshadow = \"gauss_markov\"\n");
  start({"--config", config});
  ASSERT_NO_FATAL_FAILURE(send(50));
  EXPECT_EQ(listener_.health.back().tuner_count(), 0u);  // not the tuner filter
  EXPECT_NE(listener_.health.back().health(), shadow_health_.back().health());
  EXPECT_EQ(order("gauss_markov").accepted(), 1u);
}

TEST_F(ChoiceTest, WhoOverrunsTheBudgetRestsAndTheTunerFilterTakesItsPlace) {
  // No estimator updates within 0.1 us.
  start(
      {"--estimator-published", "time_varying", "--estimator-shadow", "gauss_markov", "--estimator-budget-ms", "1e-4"});
  for (int k = 0; k < 10; ++k) writer_.write(samples_.next());
  ASSERT_TRUE(listener_.await([&] { return listener_.has_event(idl::EventKind::estimator_fallback, true); }));
  EXPECT_TRUE(listener_.has_event(idl::EventKind::estimator_overrun, true));
  EXPECT_THAT(listener_.find_event(idl::EventKind::estimator_overrun, true)->message().c_str(),
              testing::HasSubstr("3 times in a row more than"));
  ASSERT_TRUE(listener_.await([&] {
    writer_.write(samples_.next());
    return !listener_.health.empty() && (listener_.health.back().flags() & idl::estimate_flag::fallback) != 0;
  }));
  EXPECT_EQ(listener_.health.back().tuner_count(), 7u);
  EXPECT_EQ(order("gauss_markov").accepted(), 0u);  // at rest as well
}

}  // namespace
