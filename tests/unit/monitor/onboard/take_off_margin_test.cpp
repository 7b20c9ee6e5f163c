// SPDX-License-Identifier: Apache-2.0
// The EGT margin at what was learned: that of the engine itself where all is known, with a sigma that is what a spread
// of engines gives.

#include "monitor/onboard/take_off_margin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/mismatch/mismatch.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;

const std::shared_ptr<const OnBoardModel>& model() {
  static const auto shared = std::make_shared<const OnBoardModel>(sim::default_engine(), OnBoardOptions{});
  return shared;
}

/// As if a flight had told this of the engine, with nothing open.
Learned known(const sim::HealthVector& health, const sim::Mismatch& build) {
  Learned learned = learned_nothing(*model());
  learned.covariance.setZero();
  const auto& channels = model()->definition().channels.health;
  for (std::size_t j = 0; j < channels.size(); ++j) learned.value(as_index(j)) = 100.0 * health[channels[j].parameter];
  for (std::size_t i = 0; i < model()->causes().size(); ++i) {
    const OnBoardCause& cause = model()->causes()[i];
    learned.value(as_index(channels.size() + i)) = build[cause.index] / cause.sigma;
  }
  return learned;
}

TEST(TakeOffMargin, OfANewEngineAsFiledIsTheMarginOfTheFile) {
  const double thrust_n = take_off_thrust_n(model()->engine());
  const TakeOffMargin margin = take_off_margin(*model(), known({}, {}));
  EXPECT_NEAR(margin.margin_k, egt_margin_k(model()->engine(), {}, thrust_n), 1e-9);
  EXPECT_GT(margin.margin_k, 0.0);
  EXPECT_EQ(margin.sigma_k, 0.0);
}

TEST(TakeOffMargin, WearCostsIt) {
  double before = take_off_margin(*model(), known({}, {})).margin_k;
  for (const double percent : {1.0, 2.0, 3.0}) {
    sim::HealthVector worn{};
    worn[sim::hpc_efficiency] = worn[sim::hpt_efficiency] = -0.01 * percent;
    const double margin = take_off_margin(*model(), known(worn, {})).margin_k;
    EXPECT_LT(margin, before - 5.0) << percent;
    before = margin;
  }
}

TEST(TakeOffMargin, OfAKnownBuildIsThatOfTheBuiltEngine) {
  const double thrust_n = take_off_thrust_n(model()->engine());
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const sim::Mismatch build = sim::drawn_mismatch({.build = true}, seed);
    sim::HealthVector worn{};
    worn[sim::lpt_efficiency] = -0.01;
    const double truth = egt_margin_k(sim::Turbofan(sim::built(sim::default_engine()->data, build)), worn, thrust_n);
    // the causes are taken to be linear and to add up
    EXPECT_NEAR(take_off_margin(*model(), known(worn, build)).margin_k, truth, 0.5) << seed;
  }
}

TEST(TakeOffMargin, SigmaIsTheSpreadOfTheFleetBeforeAnythingIsLearned) {
  const Learned nothing = learned_nothing(*model());
  const double claimed = take_off_margin(*model(), nothing).sigma_k;
  const double thrust_n = take_off_thrust_n(model()->engine());
  // by what each parameter of two percent does on its own, and each cause of the build
  double variance = 0.0;
  const double at_new = egt_margin_k(model()->engine(), {}, thrust_n);
  for (const sim::HealthChannel& channel : model()->definition().channels.health) {
    sim::HealthVector up{}, down{};
    up[channel.parameter] = channel.sigma, down[channel.parameter] = -channel.sigma;
    variance += std::pow(
        0.5 * (egt_margin_k(model()->engine(), up, thrust_n) - egt_margin_k(model()->engine(), down, thrust_n)), 2);
  }
  for (const OnBoardCause& cause : model()->causes())
    if (cause.kind == CauseKind::engine) variance += std::pow(egt_margin_k(*cause.altered, {}, thrust_n) - at_new, 2);
  EXPECT_NEAR(claimed, std::sqrt(variance), 0.02 * claimed);
}

TEST(Learned, TheNextFlightKeepsTheBuildAndNotWhatWasMisread) {
  const UnknownLayout layout(*model());
  Learned learned = learned_nothing(*model());
  learned.value.setConstant(0.5);
  learned.covariance.setConstant(0.01);
  learned.covariance.diagonal().setConstant(0.04);
  const Learned next = after_wear(learned, *model(), 0.3);
  for (Eigen::Index j = 0; j < layout.health_count; ++j) {
    EXPECT_EQ(next.value(j), 0.5);
    EXPECT_DOUBLE_EQ(next.covariance(j, j), 0.04 + 0.09);
  }
  for (Eigen::Index i = 0; i < layout.cause_count; ++i) {
    const Eigen::Index at = layout.health_count + i;
    const bool forgotten = model()->causes()[as_size(i)].kind == CauseKind::input;
    EXPECT_EQ(next.value(at), forgotten ? 0.0 : 0.5);
    EXPECT_EQ(next.covariance(at, at), forgotten ? 1.0 : 0.04);
    EXPECT_EQ(next.covariance(at, 0), forgotten ? 0.0 : 0.01);
  }
}

}  // namespace
}  // namespace ehm::onboard
