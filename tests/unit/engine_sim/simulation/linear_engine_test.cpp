// SPDX-License-Identifier: Apache-2.0
// A linear model as the engine that flies: against the closed form, in its noise, and in what it refuses.

#include "engine_sim/linear/linear_engine.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/dds/apply_command.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "idl/wire_values.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/tuner_design/test_models.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using Eigen::VectorXd;
using linear_model::LinearModel;
using testing::HasSubstr;

LinearModel quiet_model() {
  LinearModel model = test::made_up_model();
  model.process_noise.setZero();
  model.sensor_noise_sigma.setZero();
  return model;
}

Scenario scenario_of(const LinearModel& model, const VectorXd& health) {
  Scenario s;
  s.wear.clear();
  for (std::size_t i = 0; i < model.health.size(); ++i)
    s.wear.push_back({model.health[i].trim + health(as_index(i)), 0.0});
  return s;
}

Scenario unworn(const LinearModel& model) {
  return scenario_of(model, VectorXd::Zero(as_index(model.health.size())));
}

VectorXd some_wear(const LinearModel& model) {
  test::Random random(3);
  return 0.02 * random.normal_vector(as_index(model.health.size()));
}

EngineSample fly(LinearEngine& engine, int samples) {
  EngineSample sample;
  for (int k = 0; k < samples; ++k) sample = engine.next_sample();
  return sample;
}

void expect_sensors(const EngineSample& sample, const LinearModel& model, const VectorXd& y) {
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    EXPECT_NEAR(sample.sensors[i].value, model.sensors[i].trim + y(as_index(i)), 1e-10 * model.sensors[i].trim) << i;
}

TEST(LinearEngine, BeginsAndStaysAtTheClosedFormOfItsWear) {
  LinearModel model = quiet_model();
  model.health[2].trim = -0.017;
  const VectorXd h = some_wear(model);
  LinearEngine engine(model, scenario_of(model, h));
  const estimation::SteadyGain steady = estimation::steady_gain(model);
  for (const int samples : {1, 400}) {
    const EngineSample sample = fly(engine, samples);
    expect_sensors(sample, model, steady.H * h);
    const VectorXd z = steady.Hz * h;
    for (std::size_t i = 0; i < model.auxiliary.size(); ++i)
      EXPECT_NEAR(sample.auxiliary[i], model.auxiliary[i].trim + z(as_index(i)), 1e-8);
    EXPECT_NEAR(sample.health[2], -0.017 + h(2), 1e-15);
    EXPECT_EQ(sample.actuators, std::vector<double>{0.8});
  }
}

TEST(LinearEngine, FollowsItsEquationsThroughAStepOfHealthAndOfAControl) {
  const LinearModel model = quiet_model();
  Scenario s = unworn(model);
  s.health_changes = {{3.0 * model.sample_time_s, 1, -0.02, 0.0}};
  s.control_changes = {{5.0 * model.sample_time_s, 0, 0.04, 0.0}};
  LinearEngine engine(model, s);
  VectorXd x = VectorXd::Zero(2);
  for (int k = 0; k < 50; ++k) {
    VectorXd h = VectorXd::Zero(6), u = VectorXd::Zero(1);
    if (k >= 3) h(1) = -0.02;
    if (k >= 5) u(0) = 0.04;
    const EngineSample sample = engine.next_sample();
    EXPECT_EQ(sample.sequence, static_cast<std::uint64_t>(k));
    expect_sensors(sample, model, model.C * x + model.D * u + model.M * h);
    EXPECT_NEAR(sample.auxiliary[1], 10700.0 + (model.F * x + model.G * u + model.N * h)(1), 1e-8);
    x = (model.A * x + model.B * u + model.L * h).eval();
  }
}

TEST(LinearEngine, ItsSensorsHaveTheNoiseOfTheModel) {
  LinearModel model = test::made_up_model();
  model.process_noise.setZero();
  LinearEngine engine(model, unworn(model));
  constexpr int n = 20'000;
  VectorXd sum = VectorXd::Zero(4), square = VectorXd::Zero(4);
  for (int k = 0; k < n; ++k) {
    const EngineSample sample = engine.next_sample();
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto s = as_size(i);
      const double v = (sample.sensors[s].value - model.sensors[s].trim) / model.sensor_noise_sigma(i);
      sum(i) += v, square(i) += v * v;
    }
  }
  // Standard errors of white noise: mean 1/sqrt(n), variance sqrt(2/n).
  for (Eigen::Index i = 0; i < 4; ++i) {
    EXPECT_NEAR(sum(i) / n, 0.0, 4.0 / std::sqrt(n)) << i;
    EXPECT_NEAR(square(i) / n, 1.0, 4.0 * std::sqrt(2.0 / n)) << i;
  }
}

TEST(LinearEngine, ItsMotionIsStationaryFromTheFirstSampleOn) {
  const LinearModel model = test::made_up_model();
  // X = A X A^T + Q by vec(X) = (I - A (x) A)^-1 vec(Q), written out for two states.
  Eigen::Matrix4d kronecker;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) kronecker.block<2, 2>(2 * i, 2 * j) = model.A(i, j) * model.A;
  const Eigen::Vector4d q(model.process_noise(0, 0), model.process_noise(1, 0), model.process_noise(0, 1),
                          model.process_noise(1, 1));
  const Eigen::Vector4d x = (Eigen::Matrix4d::Identity() - kronecker).lu().solve(q);
  const Eigen::Matrix2d X = (Eigen::Matrix2d() << x(0), x(2), x(1), x(3)).finished();
  const double variance = (model.F * X * model.F.transpose())(0, 0);
  constexpr int flights = 4000;
  double at_first = 0.0, later = 0.0;
  for (int seed = 1; seed <= flights; ++seed) {
    Scenario s = unworn(model);
    s.seed = seed;
    LinearEngine engine(model, s);
    const auto square = [&](double z) { return (z - model.auxiliary[0].trim) * (z - model.auxiliary[0].trim); };
    at_first += square(engine.next_sample().auxiliary[0]);
    later += square(fly(engine, 40).auxiliary[0]);
  }
  // Flights are independent: standard error sqrt(2/n) of the variance.
  EXPECT_NEAR(at_first / flights, variance, 4.0 * std::sqrt(2.0 / flights) * variance);
  EXPECT_NEAR(later / flights, variance, 4.0 * std::sqrt(2.0 / flights) * variance);
}

TEST(LinearEngine, TheSameSeedFliesTheSameAndAFaultChangesItsOwnSensorOnly) {
  const LinearModel model = test::made_up_model();
  Scenario s = unworn(model);
  LinearEngine one(model, s), same(model, s);
  s.faults = {{2, {FaultKind::bias, 25.0, 10 * model.sample_time_s, 0.0}}};
  LinearEngine broken(model, s);
  s.seed = 2;
  LinearEngine other(model, s);
  for (int k = 0; k < 50; ++k) {
    const EngineSample a = one.next_sample(), b = same.next_sample(), c = broken.next_sample();
    EXPECT_NE(other.next_sample().sensors[0].value, a.sensors[0].value);
    EXPECT_EQ(a.auxiliary, b.auxiliary);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(a.sensors[i].value, b.sensors[i].value);
      EXPECT_NEAR(c.sensors[i].value, a.sensors[i].value + (i == 2 && k >= 10 ? 25.0 : 0.0), 1e-9) << k << ' ' << i;
    }
  }
}

TEST(LinearEngine, ACoarseSensorSpeaksInStepsAndASlowOneHoldsItsValue) {
  LinearModel model = test::made_up_model();
  model.process_noise.setZero();
  model.sensor_resolution = VectorXd::Zero(4);
  model.sensor_resolution(2) = 2.0;
  model.sensor_update_period_s = VectorXd::Zero(4);
  model.sensor_update_period_s(3) = 5 * model.sample_time_s;
  const double own_sigma = 4.0;  // before rounding and holding
  for (const Eigen::Index i : {2, 3}) model.sensor_noise_sigma(i) = linear_model::counted_sigma(model, i, own_sigma);
  LinearEngine engine(model, unworn(model));
  EXPECT_NEAR(engine.channels().sensors[2].sigma, own_sigma, 1e-12);
  EXPECT_NEAR(engine.channels().sensors[3].sigma, own_sigma, 1e-12);
  constexpr int n = 20'000;
  double coarse = 0.0, slow = 0.0, held = 0.0;
  for (int k = 0; k < n; ++k) {
    const EngineSample sample = engine.next_sample();
    const double steps = sample.sensors[2].value / 2.0;
    EXPECT_EQ(steps, std::round(steps));
    coarse += std::pow(sample.sensors[2].value - model.sensors[2].trim, 2) / n;
    slow += std::pow(sample.sensors[3].value - model.sensors[3].trim, 2) / n;
    if (k % 5 == 0) {
      EXPECT_NE(sample.sensors[3].value, held);
      held = sample.sensors[3].value;
    }
    EXPECT_EQ(sample.sensors[3].value, held) << k;
  }
  // s^2 + q^2/12; the trim is a multiple of the step. A fifth of the slow values is independent.
  const double rounded = own_sigma * own_sigma + 4.0 / 12.0;
  EXPECT_NEAR(coarse, rounded, 4.0 * std::sqrt(2.0 / n) * rounded);
  EXPECT_NEAR(slow, own_sigma * own_sigma, 4.0 * std::sqrt(2.0 * 5 / n) * own_sigma * own_sigma);
}

TEST(LinearEngine, DescribesTheModelsChannels) {
  LinearModel model = test::made_up_model();
  model.engine_type = "made_up";
  model.operating_point = {10668.0, 0.8, 5.0};
  LinearEngine engine(model, unworn(model));
  const EngineChannels& c = engine.channels();
  EXPECT_EQ(c.engine_type, "made_up");
  EXPECT_DOUBLE_EQ(c.sample_time_s, 0.015);
  ASSERT_EQ(c.actuators.size(), 1u);
  EXPECT_EQ(c.actuators[0].name, "Wf");
  EXPECT_EQ(c.actuators[0].unit, "kg/s");
  ASSERT_EQ(c.sensors.size(), 4u);
  EXPECT_EQ(c.sensors[1].name, "N2");
  EXPECT_DOUBLE_EQ(c.sensors[1].trim, 7370.0);
  EXPECT_DOUBLE_EQ(c.sensors[1].sigma, model.sensor_noise_sigma(1));
  EXPECT_EQ(c.health.size(), 6u);
  EXPECT_EQ(c.auxiliary.at(1).name, "Fn");
  EXPECT_EQ(engine.next_sample().flight, (FlightCondition{10668.0, 0.8, 5.0}));
  EXPECT_THAT(engine.start_text(), HasSubstr("flies the linear model 'made up'"));
}

class LinearCommand : public testing::Test {
 protected:
  std::string refusal(idl::SimCommandKind kind, std::uint32_t channel, double value) {
    SimCommand c;
    c.schema(idl::schema_version);
    c.kind(static_cast<std::uint32_t>(kind));
    c.channel(channel);
    c.value()[0] = value;
    const CommandReply reply = apply(c, engine_);
    return reply.accepted() != 0 ? std::string() : reply.message().c_str();
  }
  static LinearModel in_percent() {
    LinearModel model = quiet_model();
    model.health[5].unit = "percent";
    return model;
  }
  LinearModel model_ = in_percent();
  LinearEngine engine_{model_, unworn(model_)};
};

TEST_F(LinearCommand, WearIsTakenInTheModelsUnit) {
  EXPECT_EQ(refusal(idl::SimCommandKind::set_health, 1, -0.02), "");
  EXPECT_EQ(refusal(idl::SimCommandKind::add_health, 1, -0.01), "");
  EXPECT_EQ(refusal(idl::SimCommandKind::set_health, 5, -12.0), "");
  const EngineSample sample = engine_.next_sample();
  EXPECT_DOUBLE_EQ(sample.health[1], -0.03);
  EXPECT_DOUBLE_EQ(sample.health[5], -12.0);
  const auto name = [&](std::size_t i) { return model_.health[i].name; };
  EXPECT_EQ(refusal(idl::SimCommandKind::set_health, 1, -0.31),
            name(1) + " after the command is -0.31, allowed is -0.3 to 0.1");
  EXPECT_EQ(refusal(idl::SimCommandKind::set_health, 5, 11),
            name(5) + " after the command is 11, allowed is -30 to 10");
  EXPECT_EQ(refusal(idl::SimCommandKind::set_health, 6, 0), "channel (health parameter) is 6, allowed is 0 to 5");
}

TEST_F(LinearCommand, DemandAndFlightAreRefusedWithTheReason) {
  EXPECT_THAT(refusal(idl::SimCommandKind::set_demand, 0, 3000), HasSubstr("a linear model has no demand"));
  EXPECT_THAT(refusal(idl::SimCommandKind::set_thrust, 0, 30e3), HasSubstr("a linear model has no demand"));
  EXPECT_THAT(refusal(idl::SimCommandKind::set_flight, 0, 5000), HasSubstr("at its own operating point only"));
}

TEST_F(LinearCommand, ASensorFaultHitsTheSensorOfItsNumber) {
  SimCommand c;
  c.schema(idl::schema_version);
  c.kind(static_cast<std::uint32_t>(idl::SimCommandKind::sensor_fault));
  c.channel(3);
  c.fault(static_cast<std::uint32_t>(idl::SensorFaultKind::dropout));
  EXPECT_EQ(apply(c, engine_).accepted(), 1u);
  const EngineSample sample = engine_.next_sample();
  EXPECT_FALSE(sample.sensors[3].valid);
  EXPECT_TRUE(sample.sensors[2].valid);
  c.channel(4);
  EXPECT_EQ(apply(c, engine_).accepted(), 0u);
}

}  // namespace
