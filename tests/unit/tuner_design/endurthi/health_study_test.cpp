// SPDX-License-Identifier: Apache-2.0
// The filters of Endurthi's thesis on our engine.

#include "tuner_design/endurthi/health_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "engine_sim/engines/jt9d_engine.h"
#include "tuner_design/endurthi/linear_models.h"
#include "tuner_design/linearise/step_study.h"
#include "tuner_design/monte_carlo/random_stream.h"
#include "tuner_design/print/studies/endurthi_health_text.h"

namespace ehm::tuner_design::endurthi {
namespace {

const StudyPoint& part_power() {
  static const std::vector<StudyPoint> points = study_points(engine_sim::jt9d_engine());
  return points.back();
}

const Eigen::MatrixXd& tangent() {
  static const Eigen::MatrixXd jacobian = study_steps(part_power().plant).jacobian;
  return jacobian;
}

/// A new engine: noise about trim, so that every estimate but zero is noise.
void fly_new_engine(HealthFilter& filter, RandomStream& random, int samples) {
  Eigen::VectorXd y = part_power().sensor_trim();
  for (int k = 0; k < samples; ++k) {
    for (Eigen::Index i = 0; i < y.size(); ++i)
      y(i) = part_power().sensor_trim()(i) + part_power().noise_sigma(i) * random.normal();
    filter.fuse(y, part_power().control_trim());
  }
}

// Chatterjee & Litt's table after 6000 cycles, and an engine in balance with it.
TEST(FlightTruth, WearsByTheCommonLaw) {
  const FlightTruth fresh = truth_of(part_power(), 0.0), worn = truth_of(part_power(), 6000.0);
  EXPECT_EQ(fresh.health_percent, Eigen::VectorXd::Zero(9));
  const auto names = part_power().health_names();
  const auto fan_flow = std::find(names.begin(), names.end(), "fan_flow") - names.begin();
  ASSERT_LT(fan_flow, 9);
  EXPECT_NEAR(worn.health_percent(fan_flow), -3.65, 1e-9);
  EXPECT_LT((fresh.y.cwiseQuotient(part_power().sensor_trim()).array() - 1.0).abs().maxCoeff(), 1e-6);
  EXPECT_GT((worn.y - fresh.y).cwiseQuotient(part_power().noise_sigma).cwiseAbs().maxCoeff(), 5.0);
}

TEST(HealthFilter, WithoutNoiseTheEstimateIsTheHealth) {
  const Eigen::VectorXd h = Eigen::VectorXd::Constant(9, -1e-4);
  const StudyPoint worn = part_power().worn(h);
  HealthFilter filter(part_power(), tangent(), FilterKind::unconstrained,
                      {.p0_percent = 0.5, .qh_percent2 = 1e-5, .process_noise_percent = 0.01, .sample_time_s = 0.1});
  for (int k = 0; k < 20000; ++k) filter.fuse(worn.sensor_trim(), worn.control_trim());
  // a hundredth of a percent is within the tangent's reach, Qh lets the prior go
  EXPECT_LT((filter.health() - 100.0 * h).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(HealthFilter, ConstrainedHealthIsNeverBetterThanNew) {
  for (const FilterKind kind : {FilterKind::projected, FilterKind::every_sample, FilterKind::fed_back}) {
    HealthFilter filter(part_power(), tangent(), kind, {});
    RandomStream random(7, 0);
    for (int flight = 0; flight < 20; ++flight) {
      fly_new_engine(filter, random, 30);
      filter.end_flight();
      for (Eigen::Index i = 0; i < 9; ++i) {
        const double way = part_power().health_names()[static_cast<std::size_t>(i)] == "hpt_flow" ? 1.0 : -1.0;
        EXPECT_GE(way * filter.health()(i), -1e-9);
      }
    }
  }
}

// A bound at every sample only ever moves one way, so noise carries it further than one at every flight.
TEST(HealthFilter, TheRatchetIsWorseTheMoreOftenItIsDrawn) {
  std::vector<double> errors;
  for (const FilterKind kind : {FilterKind::projected, FilterKind::every_sample}) {
    HealthFilter filter(part_power(), tangent(), kind, {});
    RandomStream random(8, 0);
    Eigen::VectorXd last = Eigen::VectorXd::Zero(9);
    for (int flight = 0; flight < 50; ++flight) {
      fly_new_engine(filter, random, 30);
      filter.end_flight();
      EXPECT_LE(filter.health()(0), last(0) + 1e-9);  // fan flow
      last = filter.health();
    }
    errors.push_back(last.norm());
  }
  EXPECT_GT(errors[1], 1.2 * errors[0]);
}

TEST(HealthFilter, TheSameModelAgainChangesNothing) {
  HealthFilter filter(part_power(), tangent(), FilterKind::unconstrained, {});
  RandomStream random(9, 0);
  fly_new_engine(filter, random, 60);
  HealthFilter again = filter;
  again.relinearise(part_power(), tangent());
  RandomStream one(9, 1), other(9, 1);
  fly_new_engine(filter, one, 30);
  fly_new_engine(again, other, 30);
  EXPECT_LT((filter.health() - again.health()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(HealthFilter, AnotherTrimKeepsTheAbsoluteEstimate) {
  const Eigen::VectorXd h = Eigen::VectorXd::Constant(9, -2e-3);
  const StudyPoint worn = part_power().worn(h);
  HealthFilter filter(part_power(), tangent(), FilterKind::unconstrained, {});
  for (int k = 0; k < 3000; ++k) filter.fuse(worn.sensor_trim(), worn.control_trim());
  const Eigen::VectorXd before = filter.health();
  filter.relinearise(worn, study_steps(worn.plant).jacobian);
  for (int k = 0; k < 3000; ++k) filter.fuse(worn.sensor_trim(), worn.control_trim());
  // the new trim is the engine itself: nothing is missed any more
  EXPECT_LT((filter.health() - 100.0 * h).norm(), 0.5 * (before - 100.0 * h).norm() + 1e-4);
}

HealthStudy small(unsigned threads) {
  HealthStudyOptions options;
  options.engine = engine_sim::default_engine();
  options.runs = 2;
  options.flights = 10;
  options.life_flights = 20;
  options.relinearised_each = 10;
  options.threads = threads;
  return run_health_study(options);
}

TEST(HealthStudy, TheSameOnAnyNumberOfThreadsAndBesideThePublished) {
  const HealthStudy study = small(1);
  EXPECT_EQ(health_study_csv(study), health_study_csv(small(2)));
  ASSERT_EQ(study.points.size(), 2u);
  EXPECT_EQ(model_digits(life_model), "120");
  for (const HealthPoint& point : study.points) {
    EXPECT_EQ(point.models.size(), model_count + 1);
    EXPECT_EQ(point.life.size(), 20u);
    for (const ModelHealth& model : point.models)
      for (const HealthErrors& errors : model.by_kind) {
        EXPECT_EQ(errors.percent.size(), 10u);
        EXPECT_GT(errors.percent.back(), 0.0);
        EXPECT_LT(errors.percent.back(), 1.0);
      }
  }
  for (const int table : {4, 5}) {
    std::ostringstream out;
    print_health_study(study, table, out);
    EXPECT_THAT(out.str(), ::testing::HasSubstr(table == 4 ? "best LIN120 7.04" : "best LIN120 6.29"));
  }
}

}  // namespace
}  // namespace ehm::tuner_design::endurthi
