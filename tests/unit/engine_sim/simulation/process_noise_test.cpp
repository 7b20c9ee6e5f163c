// SPDX-License-Identifier: Apache-2.0
// Process noise: its distributions against their closed forms, its streams, and what it does to an engine in flight.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/disturbance/health_noise.h"
#include "engine_sim/disturbance/speed_noise.h"
#include "engine_sim/linear/linear_engine.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"
#include "tests/unit/tuner_design/test_models.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using enum NoiseDistribution;
using test::fly;
using test::quiet;

constexpr std::array shapes{gaussian, rayleigh, rayleigh_shifted};

std::string name(NoiseDistribution shape) {
  return std::string(noise_distribution_names[as_size(shape)]);
}

struct Moments {
  double mean, sigma, skewness, least;
};

Moments moments_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0, second = 0.0, third = 0.0, least = values.front();
  for (const double v : values) mean += v / n;
  for (const double v : values) {
    second += std::pow(v - mean, 2) / n;
    third += std::pow(v - mean, 3) / n;
    least = std::min(least, v);
  }
  return {mean, std::sqrt(second), third / std::pow(second, 1.5), least};
}

std::vector<double> deviates(NoiseDistribution shape, std::uint64_t seed, int count) {
  NoiseSource random(seed);
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(deviate(shape, random));
  return values;
}

// Closed forms of the Rayleigh distribution: mean sqrt(pi/2) and variance 2 - pi/2 of its parameter 1, skewness 0.6311,
// kurtosis 3.245. Tolerances are five standard errors of 200 000 deviates: 1/sqrt(n) of the mean,
// sqrt((kurtosis - 1)/(4 n)) of sigma, some sqrt(9/n) of the skewness.
TEST(NoiseDistribution, HasTheMomentsOfItsClosedForm) {
  constexpr int n = 200'000;
  const double error = 5.0 / std::sqrt(n);
  const double mean = std::sqrt(std::numbers::pi / 2.0) / std::sqrt(2.0 - std::numbers::pi / 2.0);
  EXPECT_NEAR(mean, 1.9131, 5e-5);
  const Moments normal = moments_of(deviates(gaussian, 3, n));
  EXPECT_NEAR(normal.mean, 0.0, error);
  EXPECT_NEAR(normal.sigma, 1.0, error * std::sqrt(0.5));
  EXPECT_NEAR(normal.skewness, 0.0, error * std::sqrt(6.0));
  for (const NoiseDistribution shape : {rayleigh, rayleigh_shifted}) {
    SCOPED_TRACE(name(shape));
    const double expected_mean = shape == rayleigh ? mean : 0.0;
    const Moments m = moments_of(deviates(shape, 3, n));
    EXPECT_NEAR(m.mean, expected_mean, error);
    EXPECT_NEAR(m.sigma, 1.0, error * std::sqrt(0.561));
    EXPECT_NEAR(m.skewness, 0.6311, error * 3.0);
    EXPECT_GE(m.least, expected_mean - mean);
    EXPECT_LT(m.least, expected_mean - mean + 0.02);
  }
}

// P(x > a q) = exp(-q^2/2) of a Rayleigh deviate with parameter a; a standard error of a share is at most 0.5/sqrt(n).
TEST(NoiseDistribution, TheTailOfRayleighIsTheExponentialOfASquare) {
  constexpr int n = 200'000;
  const std::vector<double> values = deviates(rayleigh, 8, n);
  for (const double q : {0.3, 1.0, 1.1774, 2.0, 3.0}) {
    const double limit = q * 1.52637;
    const auto above = std::count_if(values.begin(), values.end(), [&](double v) { return v > limit; });
    EXPECT_NEAR(static_cast<double>(above) / n, std::exp(-0.5 * q * q), 2.5 / std::sqrt(n)) << q;
  }
}

// Lu et al. (Energies 2013): health of sigma 5e-4, Rayleigh parameter 7.632e-4, shift 9.565e-4; a median is
// sqrt(2 ln 2) of the parameter.
TEST(NoiseDistribution, ASigmaOf5em4IsTheRayleighNoiseOfLu) {
  std::vector<double> values = deviates(rayleigh, 5, 100'001);
  std::nth_element(values.begin(), values.begin() + 50'000, values.end());
  EXPECT_NEAR(5e-4 * values[50'000] / std::sqrt(2.0 * std::numbers::ln2), 7.632e-4, 0.01 * 7.632e-4);
  EXPECT_NEAR(5e-4 * rayleigh_mean, 9.565e-4, 5e-8);
}

TEST(NoiseDistribution, NoneIsNothingAndDrawsNothing) {
  NoiseSource a(4), b(4);
  EXPECT_EQ(deviate(none, a), 0.0);
  EXPECT_EQ(a.normal(), b.normal());
}

/// So many samples of parameter `parameter`.
std::vector<double> health_noise(const ProcessNoise& noise, std::uint64_t seed, std::size_t parameter, int samples) {
  HealthNoise health(noise, 3, seed);
  std::vector<double> values;
  for (int k = 0; k < samples; ++k) {
    health.next();
    values.push_back(health.of_sample(parameter));
  }
  return values;
}

TEST(HealthNoise, IsTheSameForASeedAndAnotherForAnother) {
  for (const NoiseDistribution shape : shapes) {
    const ProcessNoise noise{.distribution = shape, .health_sigma = {1e-3, 0.0, 2e-3}};
    EXPECT_EQ(health_noise(noise, 7, 0, 50), health_noise(noise, 7, 0, 50));
    EXPECT_NE(health_noise(noise, 7, 0, 50), health_noise(noise, 8, 0, 50));
    EXPECT_EQ(health_noise(noise, 7, 1, 50), std::vector<double>(50, 0.0));
    const ProcessNoise others{.distribution = shape, .health_sigma = {0.0, 1e-3, 2e-3}};
    EXPECT_EQ(health_noise(noise, 7, 2, 50), health_noise(others, 7, 2, 50));
  }
}

TEST(HealthNoise, BeginsAtZeroAndIsNothingWhereItIsOff) {
  const ProcessNoise off{.health_sigma = {1e-3, 1e-3, 1e-3}};
  EXPECT_FALSE(off.on());
  EXPECT_EQ(health_noise(off, 1, 0, 9), std::vector<double>(9, 0.0));
  EXPECT_EQ(HealthNoise({.distribution = gaussian, .health_sigma = {1.0}}, 3, 1).of_sample(0), 0.0);
}

// White noise of zero mean: the sum of n - 1 products of neighbours has the standard deviation sqrt(n - 1) sigma^2.
TEST(HealthNoise, IsWhiteInTimeAndBetweenParametersAndLastsNoSample) {
  constexpr int n = 50'000;
  const ProcessNoise noise{.distribution = rayleigh_shifted, .health_sigma = {1.0, 1.0, 1.0}};
  const std::vector<double> a = health_noise(noise, 2, 0, n), b = health_noise(noise, 2, 1, n);
  double in_time = 0.0, between = 0.0;
  for (std::size_t k = 1; k < a.size(); ++k) in_time += a[k] * a[k - 1] / n, between += a[k] * b[k] / n;
  EXPECT_NEAR(in_time, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(between, 0.0, 5.0 / std::sqrt(n));
  HealthNoise white(noise, 3, 2);
  white.next();
  EXPECT_NE(white.of_sample(0), 0.0);
  EXPECT_EQ(white.lasting(0), 0.0);
}

// After n samples a random walk has sigma sqrt(n); 2000 walks tell it to sqrt(1/4000) = 1.6 %.
TEST(HealthNoise, AccumulatedItIsTheSumOfTheWhiteOneAndGrowsByTheRoot) {
  ProcessNoise noise{.distribution = gaussian, .health_sigma = {1e-3, 1e-3, 1e-3}};
  const std::vector<double> white = health_noise(noise, 11, 1, 100);
  noise.accumulate = true;
  HealthNoise walk(noise, 3, 11);
  double sum = 0.0;
  for (const double v : white) {
    walk.next();
    sum += v;
    EXPECT_NEAR(walk.of_sample(1), sum, 1e-15);
    EXPECT_EQ(walk.lasting(1), walk.of_sample(1));
  }
  std::vector<double> ends;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) ends.push_back(health_noise(noise, seed, 0, 100).back());
  EXPECT_NEAR(moments_of(ends).sigma, 1e-2, 0.08 * 1e-2);
}

TEST(SpeedNoise, IsAPercentOfEachSpeedAndTheSpoolsAreIndependent) {
  constexpr int n = 50'000;
  SpeedNoise noise({.distribution = rayleigh, .speed_sigma_percent = 0.02}, 4);
  std::vector<double> n1, n2;
  double product = 0.0;
  for (int k = 0; k < n; ++k) {
    const SpoolSpeeds change = noise.next({3000.0, 7500.0});
    n1.push_back(change.n1_rpm), n2.push_back(change.n2_rpm);
    product += (change.n1_rpm / 0.6 - rayleigh_mean) * (change.n2_rpm / 1.5 - rayleigh_mean) / n;
  }
  EXPECT_NEAR(moments_of(n1).sigma, 0.6, 0.6 * 5.0 / std::sqrt(n));
  EXPECT_NEAR(moments_of(n2).sigma, 1.5, 1.5 * 5.0 / std::sqrt(n));
  EXPECT_NEAR(moments_of(n2).mean, 1.5 * 1.9131, 1.5 * 5.0 / std::sqrt(n));
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(n));
}

Scenario noisy(Scenario s, NoiseDistribution shape, double health_sigma, double speed_sigma_percent = 0.0) {
  s.process_noise = {.distribution = shape,
                     .health_sigma = std::vector<double>(health_count, health_sigma),
                     .speed_sigma_percent = speed_sigma_percent};
  return s;
}

std::vector<double> readings_of(Simulation& simulation, int samples) {
  std::vector<double> values;
  for (int k = 0; k < samples; ++k)
    for (const Reading& reading : simulation.next().readings) values.push_back(reading.value);
  return values;
}

std::vector<double> readings_of(const Scenario& scenario, int samples) {
  Simulation simulation(scenario);
  return readings_of(simulation, samples);
}

TEST(ProcessNoise, OfSigmaZeroIsOffToTheBit) {
  const std::vector<double> off = readings_of(Scenario(), 100);
  for (const NoiseDistribution shape : shapes) EXPECT_EQ(readings_of(noisy({}, shape, 0.0), 100), off) << name(shape);
  EXPECT_EQ(readings_of(noisy({}, none, 5e-4, 0.01), 100), off);
}

// Balances of a gas path that is moved at random: where they were guessed from their trend, they did not close at
// sigmas of 5e-3 and more. The mean of unshifted Rayleigh noise of the speeds drives an idling engine beyond its
// control: 1.9 sigma a sample, 13 % a second.
TEST(ProcessNoise, AtTheLargestSigmasThatAScenarioMayHaveTheEngineFlies) {
  for (const double n1_rpm : {1000.0, 3700.0})
    for (const NoiseDistribution shape : shapes) {
      if (shape == rayleigh && n1_rpm == 1000.0) continue;
      Scenario s = noisy(quiet(), shape, 0.01, 0.1);
      s.flight = {0.0, 0.0, 0.0};
      s.demand = {DemandKind::n1_rpm, n1_rpm};
      Simulation simulation(s);
      EXPECT_NO_THROW(fly(simulation, 1000)) << name(shape) << " at " << n1_rpm;
    }
}

TEST(ProcessNoise, TheSameSeedIsTheSameFlightAndAnotherIsAnother) {
  Scenario s = noisy(quiet(), gaussian, 5e-4, 0.01);
  const std::vector<double> flight = readings_of(s, 50);
  EXPECT_EQ(readings_of(s, 50), flight);
  s.seed = 2;
  EXPECT_NE(readings_of(s, 50), flight);
}

/// What the sensors add to a flight.
std::vector<double> sensor_noise(Scenario scenario, int samples) {
  std::vector<double> noise = readings_of(scenario, samples);
  scenario.sensors = quiet().sensors;
  const std::vector<double> truth = readings_of(scenario, samples);
  for (std::size_t i = 0; i < noise.size(); ++i) noise[i] -= truth[i];
  return noise;
}

TEST(ProcessNoise, LeavesTheNoiseOfTheSensorsAsItIs) {
  const std::vector<double> off = sensor_noise({}, 60), on = sensor_noise(noisy({}, rayleigh, 5e-4, 0.01), 60);
  for (std::size_t i = 0; i < off.size(); ++i) EXPECT_NEAR(on[i], off[i], 1e-6) << i;  // of some 1e6 Pa
}

// The truth that is published, ordered of an engine without noise, gives the same readings: it is what acted.
TEST(ProcessNoise, TheTruthHoldsTheHealthThatActed) {
  for (const NoiseDistribution shape : shapes) {
    SCOPED_TRACE(name(shape));
    Simulation flown(noisy(quiet(), shape, 2e-3)), ordered(quiet()), off(quiet());
    double moved = 0.0;
    for (int k = 0; k < 60; ++k) {
      const EngineSample noisy_sample = flown.next_sample();
      for (std::size_t j = 0; j < health_count; ++j) ordered.order_health(j, noisy_sample.health[j], 0.0);
      const EngineSample sample = ordered.next_sample(), without = off.next_sample();
      for (std::size_t i = 0; i < sample.sensors.size(); ++i) {
        const double still = without.sensors[i].value;
        EXPECT_NEAR(noisy_sample.sensors[i].value, sample.sensors[i].value, 1e-8 * still) << i;
        moved = std::max(moved, std::abs(noisy_sample.sensors[i].value / still - 1.0));
      }
      for (std::size_t i = 0; i < sample.auxiliary.size(); ++i)
        EXPECT_NEAR(noisy_sample.auxiliary[i], sample.auxiliary[i], 1e-8 * std::abs(sample.auxiliary[i])) << i;
    }
    EXPECT_GT(moved, 2e-3);
  }
}

TEST(ProcessNoise, TheTruthHasTheStatedMoments) {
  constexpr int n = 1500;
  Simulation simulation(noisy(quiet(), rayleigh, 5e-4));
  std::vector<double> fan, lpt;
  for (int k = 0; k < n; ++k) {
    const SimSample sample = simulation.next();
    fan.push_back(sample.health[fan_efficiency]), lpt.push_back(sample.health[lpt_flow]);
  }
  for (const auto& values : {fan, lpt}) {
    EXPECT_NEAR(moments_of(values).mean, 9.565e-4, 5e-4 * 5.0 / std::sqrt(n));
    EXPECT_NEAR(moments_of(values).sigma, 5e-4, 5e-4 * 5.0 / std::sqrt(n));
  }
}

// The readings of the first sample are those without noise; on those of the second the first increment of the speeds
// has been added.
TEST(ProcessNoise, OfTheSpeedsIsAddedBetweenTwoSamples) {
  Simulation off(quiet()), on(noisy(quiet(), gaussian, 0.0, 0.05));
  const SimSample first = off.next(), noisy_first = on.next(), second = off.next(), noisy_second = on.next();
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(first.readings[i].value, noisy_first.readings[i].value);
  const SpoolSpeeds speeds{second.readings[0].value, second.readings[1].value};
  const SpoolSpeeds change =
      SpeedNoise({.distribution = gaussian, .speed_sigma_percent = 0.05}, as_size(quiet().seed)).next(speeds);
  EXPECT_NEAR(noisy_second.readings[0].value - speeds.n1_rpm, change.n1_rpm, 1e-9);
  EXPECT_NEAR(noisy_second.readings[1].value - speeds.n2_rpm, change.n2_rpm, 1e-9);
  EXPECT_NE(change.n1_rpm, 0.0);
}

TEST(ProcessNoise, OfTheSpeedsIsHeldByTheControl) {
  Simulation off(quiet()), on(noisy(quiet(), gaussian, 0.0, 0.01));
  const std::vector<Reading> still = fly(off, 1).readings;
  fly(on, 400);
  std::vector<double> n1, n2;
  for (int k = 0; k < 2000; ++k) {
    const SimSample sample = on.next();
    n1.push_back(100.0 * (sample.readings[0].value / still[0].value - 1.0));
    n2.push_back(100.0 * (sample.readings[1].value / still[1].value - 1.0));
  }
  RecordProperty("n1_percent", std::to_string(moments_of(n1).sigma));
  RecordProperty("n2_percent", std::to_string(moments_of(n2).sigma));
  EXPECT_NEAR(moments_of(n1).mean, 0.0, 0.1);
  EXPECT_GT(moments_of(n1).sigma, 0.02);
  EXPECT_LT(moments_of(n1).sigma, 0.2);
  EXPECT_GT(moments_of(n2).sigma, 0.02);
  EXPECT_LT(moments_of(n2).sigma, 0.2);
}

TEST(ProcessNoise, AnOrderStartsFromWhatLastsAndReachesItsTarget) {
  Scenario s = noisy(quiet(), gaussian, 5e-4);
  Simulation white(s);
  fly(white, 100);
  EXPECT_EQ(white.health_of(hpc_flow), 0.0);
  s.process_noise.accumulate = true;
  Simulation walking(s);
  const SimSample sample = fly(walking, 100);
  EXPECT_EQ(walking.health_of(hpc_flow), sample.health[hpc_flow]);
  EXPECT_NE(walking.health_of(hpc_flow), 0.0);
  walking.order_health(hpc_flow, -0.01, 0.0);
  EXPECT_NEAR(walking.health_of(hpc_flow), -0.01, 1e-15);
  EXPECT_NEAR(walking.next().health[hpc_flow], -0.01, 6.0 * 5e-4);
  EXPECT_NE(walking.next().health[hpc_flow], -0.01);
}

TEST(ProcessNoise, AskingWhatTheEngineSurvivesDrawsNothing) {
  const Scenario s = noisy(quiet(), gaussian, 5e-4, 0.01);
  Simulation asked(s), left_alone(s);
  EXPECT_TRUE(asked.can_wear(hpc_flow, -0.01, 0.0));
  EXPECT_TRUE(asked.can_fly(s.flight));
  EXPECT_EQ(readings_of(asked, 20), readings_of(left_alone, 20));
}

TEST(ProcessNoise, ALinearModelFliesTheHealthThatItsTruthShows) {
  linear_model::LinearModel model = test::made_up_model();
  model.process_noise.setZero();
  model.sensor_noise_sigma.setZero();
  Scenario s;
  s.wear.assign(model.health.size(), {.initial = -0.01});
  s.process_noise = {.distribution = rayleigh_shifted, .health_sigma = std::vector<double>(model.health.size(), 2e-3)};
  LinearEngine engine(model, s);
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(2, 2);
  Eigen::VectorXd worn = Eigen::VectorXd::Constant(as_index(model.health.size()), -0.01);
  Eigen::VectorXd x = (I - model.A).partialPivLu().solve(model.L * worn);
  std::vector<double> noise;
  for (int k = 0; k < 2000; ++k) {
    const EngineSample sample = engine.next_sample();
    const Eigen::VectorXd h = Eigen::Map<const Eigen::VectorXd>(sample.health.data(), worn.size());
    const Eigen::VectorXd y = model.C * x + model.M * h;
    for (std::size_t i = 0; i < model.sensors.size(); ++i)
      ASSERT_NEAR(sample.sensors[i].value, model.sensors[i].trim + y(as_index(i)), 1e-10 * model.sensors[i].trim) << k;
    x = (model.A * x + model.L * h).eval();
    noise.push_back(h(1) + 0.01);
  }
  EXPECT_NEAR(moments_of(noise).mean, 0.0, 2e-3 * 5.0 / std::sqrt(2000));
  EXPECT_NEAR(moments_of(noise).sigma, 2e-3, 2e-3 * 5.0 / std::sqrt(2000));
  EXPECT_EQ(engine.health_of(1), -0.01);
}

// The linear engine draws its sensors' noise and its own motion from one stream, which process noise leaves alone.
TEST(ProcessNoise, LeavesTheRestOfALinearFlightAsItIs) {
  const linear_model::LinearModel model = test::made_up_model();
  Scenario s;
  s.wear.assign(model.health.size(), {});
  LinearEngine off(model, s);
  s.process_noise = {.distribution = gaussian, .health_sigma = {0.0}};
  LinearEngine on(model, s);
  for (int k = 0; k < 50; ++k) {
    const EngineSample a = off.next_sample(), b = on.next_sample();
    for (std::size_t i = 0; i < a.sensors.size(); ++i) EXPECT_EQ(a.sensors[i].value, b.sensors[i].value);
    EXPECT_EQ(a.auxiliary, b.auxiliary);
  }
}

}  // namespace
