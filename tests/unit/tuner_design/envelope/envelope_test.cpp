// SPDX-License-Identifier: Apache-2.0
// Schedules of an engine, and of a user's models: nodes that are the engine, interpolation that stays near it, and what
// fills no grid.

#include "tuner_design/envelope/envelope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/model/thermo/ram.h"
#include "monitor/schedule/point_lookup.h"
#include "tuner_design/linearise/linearise.h"

namespace ehm::tuner_design {
namespace {

using schedule::Variable;
using testing::HasSubstr;

std::shared_ptr<const engine_sim::EngineDefinition> engine() {
  static const auto jt9d = engine_sim::named_engine("jt9d");
  return jt9d;
}

const EnvelopeResult& small_envelope() {
  static const EnvelopeResult result = engine_envelope(
      {.engine = engine(), .most_nodes = 200, .node = {.fleet = 30, .seed = 1}, .checks = 100, .threads = 2},
      [](double) {});
  return result;
}

TEST(EngineEnvelope, EveryNodeRunsIsStableAndInterpolationStaysNear) {
  const EnvelopeResult& r = small_envelope();
  EXPECT_LE(r.schedule.nodes.size(), 200u);
  EXPECT_GT(r.schedule.nodes.size(), 100u);
  EXPECT_EQ(r.valid, r.schedule.nodes.size());
  EXPECT_EQ(r.unstable, 0u);
  EXPECT_EQ(r.error.answered, r.error.places);
  // Nf Nc P24 T24 Ps30 T30 T48 | T40 T50 Fn SmLPC: with the fit's own shift of some 0.3 % (docs/theory.md, 9)
  for (std::size_t i = 0; i < 10; ++i) EXPECT_LT(r.error.rms_percent[i], 1.2) << i;
}

// Similarity: the same corrected speed, Mach number and T2 at two altitudes are one node, read with its delta.
TEST(EngineEnvelope, AnAltitudeIsThePressureOnly) {
  const engine_sim::Turbofan turbofan(engine()->data);
  schedule::Schedule s = small_envelope().schedule;
  const NodePlace place{3300.0, 0.6, 260.0};
  const Eigen::VectorXd reduced = engine_trim(engine(), turbofan, place, s);
  ASSERT_GT(reduced.size(), 0);
  const engine_sim::FlightCondition flight = flight_at(place.mach, place.t2_k);
  EXPECT_NEAR(engine_sim::ram_ratios(flight.altitude_m, flight.mach, flight.delta_isa_k).theta * 288.15, 260.0, 0.05);
  EXPECT_NEAR(reduced(0), 3300.0, 1e-6);
}

TEST(EngineEnvelope, IsTheSameOnAnyNumberOfThreads) {
  EnvelopeOptions options{
      .engine = engine(), .most_nodes = 60, .node = {.fleet = 20, .seed = 3}, .checks = 10, .threads = 1};
  const EnvelopeResult one = engine_envelope(options, [](double) {});
  options.threads = 3;
  const EnvelopeResult three = engine_envelope(options, [](double) {});
  ASSERT_EQ(one.schedule.nodes.size(), three.schedule.nodes.size());
  for (std::size_t i = 0; i < one.schedule.nodes.size(); ++i)
    EXPECT_EQ(one.schedule.nodes[i].M, three.schedule.nodes[i].M) << i;
}

linear_model::LinearModel model_at(double mach, double share) {
  LineariseOptions options;
  options.flight = {9000.0, mach, 0.0};
  options.demand = {engine_sim::DemandKind::n1_rpm, share * engine()->data.design.speeds.n1_rpm};
  options.fleet = 0;
  return linearise(engine(), options).model;
}

std::string refusal(const std::vector<linear_model::LinearModel>& models, const std::vector<Variable>& variables) {
  try {
    schedule_of_models(models, variables, 0.02);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ScheduleOfModels, AUsersPointsAreANodeEach) {
  const std::vector models{model_at(0.8, 0.95), model_at(0.8, 0.8), model_at(0.8, 0.88)};
  const schedule::Schedule s = schedule_of_models(models, {Variable::n1_corrected}, 0.02);
  ASSERT_EQ(s.nodes.size(), 3u);
  EXPECT_FALSE(s.reduced);
  const schedule::PointLookup lookup(s);
  schedule::PointModel point;
  const auto ram = engine_sim::ram_ratios(9000.0, 0.8, 0.0);
  ASSERT_TRUE(lookup.at({s.axes[0].points[1], 0.8, ram.theta, ram.delta, 9000.0}, point));
  EXPECT_NEAR(point.y0(6), models[2].sensors[6].trim, 1e-6);  // sorted: the one at 0.88 is in the middle
  EXPECT_NEAR(point.M(6, 0), 0.01 * models[2].M(6, 0), 1e-9) << "by percent, not by fraction";
  EXPECT_GT(point.lambda_y(6), 0.0);
}

TEST(ScheduleOfModels, DiscreteMatricesBecomeContinuous) {
  std::vector models{model_at(0.8, 0.95), model_at(0.8, 0.85)};
  const Eigen::MatrixXd a = models[0].A, b = models[0].B;
  for (linear_model::LinearModel& m : models) {
    const Eigen::MatrixXd ad = (m.A * m.sample_time_s).exp();
    const Eigen::MatrixXd into = m.A.inverse() * (ad - Eigen::MatrixXd::Identity(2, 2));
    m.B = into * m.B, m.L = into * m.L, m.A = ad;
    m.discrete = true;
  }
  const schedule::Schedule s = schedule_of_models(models, {Variable::n1_corrected}, 0.02);
  EXPECT_TRUE(s.nodes[1].A.isApprox(a, 1e-9));
  EXPECT_TRUE(s.nodes[1].B.isApprox(b, 1e-9));
}

TEST(ScheduleOfModels, WhatFillsNoGridIsNamed) {
  std::vector models{model_at(0.8, 0.95), model_at(0.7, 0.8)};
  EXPECT_THAT(refusal(models, {Variable::n1_corrected, Variable::mach}),
              HasSubstr("2 models fill no grid of 4 points"));
  EXPECT_THAT(refusal({models[0]}, {Variable::mach}), HasSubstr("two models or more"));
  models[1].sensors[2].name = "P25";
  EXPECT_THAT(refusal(models, {Variable::mach}), HasSubstr("P25"));
  models[1] = model_at(0.7, 0.8);
  models[1].operating_point.reset();
  EXPECT_THAT(refusal(models, {Variable::mach}), HasSubstr("does not state its operating_point"));
}

}  // namespace
}  // namespace ehm::tuner_design
