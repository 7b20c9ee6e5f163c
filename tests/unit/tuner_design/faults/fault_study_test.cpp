// SPDX-License-Identifier: Apache-2.0
// The study of the fault detector, reduced: one round of its table and half an hour with nothing broken. Its seed is
// none that the detector was built with; margins are those of some 80 cases.

#include "tuner_design/faults/fault_study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/studies/false_alarm_text.h"
#include "tuner_design/print/studies/fault_study_text.h"

namespace ehm::tuner_design {
namespace {

const design::Design& cruise_design(LineariseMethod method) {
  static const auto made = [](LineariseMethod each) {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
    options.method = each;
    return design_tuner(linearise(engine_sim::default_engine(), options).model, {});
  };
  static const design::Design tangent = made(LineariseMethod::tangent), fleet = made(LineariseMethod::fleet);
  return method == LineariseMethod::fleet ? fleet : tangent;
}

FaultStudy studied(const design::Design& design, FaultStudyOptions options) {
  return run_fault_study(design, options, [](double) {});
}

const FaultRowSummary& row(const FaultStudy& study, const std::string& name) {
  return *std::find_if(study.rows.begin(), study.rows.end(), [&](const auto& r) { return r.row->name == name; });
}

TEST(FaultStudy, ARoundAndHalfAnHour) {
  const FaultStudy study = studied(cruise_design(LineariseMethod::fleet), {80, 0.5, 77, 2});
  EXPECT_GE(study.found, 0.9);
  EXPECT_GE(study.right_sensor, 0.75);
  EXPECT_GE(study.component_not_sensor, 0.8);
  EXPECT_LE(study.false_alarms, 1u);
  EXPECT_GE(study.fault_free_hours, 0.3);
  EXPECT_LE(study.not_flown, 12u);
  for (const char* name : {"bias +10 sigma", "bias -10 sigma", "stuck", "noise x 4", "dropout"})
    EXPECT_GE(row(study, name).right + 1, row(study, name).flown) << name;
  EXPECT_EQ(row(study, "nothing").right, row(study, "nothing").flown);
  EXPECT_EQ(row(study, "drift 10 sigma/min").wrong_sensor, 0u);
}

TEST(FaultStudy, TheTangentModelServesToo) {
  const FaultStudy study = studied(cruise_design(LineariseMethod::tangent), {80, 0.0, 78, 2});
  EXPECT_GE(study.found, 0.85);
  EXPECT_GE(study.right_sensor, 0.7);
  EXPECT_GE(study.component_not_sensor, 0.8);
}

TEST(FaultStudy, IsTheSameOnAnyNumberOfThreadsAndReportsEveryCase) {
  const design::Design& design = cruise_design(LineariseMethod::fleet);
  const FaultStudy one = studied(design, {12, 0.0, 5, 1}), three = studied(design, {12, 0.0, 5, 3});
  const std::string csv = fault_study_as_csv(one);
  EXPECT_EQ(csv, fault_study_as_csv(three));
  EXPECT_EQ(as_size(std::count(csv.begin(), csv.end(), '\n')), 1 + 12 - one.not_flown);
  const auto json = fault_study_as_json(one);
  EXPECT_EQ(json["confusion"].size(), 7u + 10u + 1u);
}

/// The made-up engine under process noise that adds as much to its sensors as their noise does.
design::Design restless_design() {
  linear_model::LinearModel model = test::made_up_model(7, 10);
  model.process_noise *= 900.0;
  return design_tuner(model, {});
}

TEST(FalseAlarms, TheStatedRatesHoldUnderProcessNoise) {
  // Two hours: some 480 000 samples of 12 engines. The seed is none that anything was fitted to.
  const FalseAlarmStudy study = run_false_alarm_study(restless_design(), {2.0, true, 31, 2}, [](double) {});
  EXPECT_EQ(study.flights, 12u);
  EXPECT_DOUBLE_EQ(study.hours, 2.0);
  EXPECT_EQ(study.withheld, 0u);
  for (const FalseAlarmRow& row : study.rows) EXPECT_TRUE(row.holds()) << row.kind << ": " << row.events << " events";
}

TEST(FalseAlarms, AreTheSameOnAnyNumberOfThreads) {
  const design::Design design = restless_design();
  EXPECT_EQ(false_alarms_as_csv(run_false_alarm_study(design, {0.4, true, 5, 1}, [](double) {})),
            false_alarms_as_csv(run_false_alarm_study(design, {0.4, true, 5, 3}, [](double) {})));
}

TEST(FalseAlarms, TheIntervalIsGarwoods) {
  // Half the chi-square quantiles of 2 n and 2 n + 2 degrees of freedom: scipy.stats.chi2.
  const std::pair<std::size_t, std::array<double, 2>> known[]{
      {0, {0.0, 3.68888}}, {1, {0.02532, 5.57164}}, {10, {4.79539, 18.39036}}};
  for (const auto& [count, limits] : known) {
    EXPECT_NEAR(poisson_interval(count)[0], limits[0], 1e-4) << count;
    EXPECT_NEAR(poisson_interval(count)[1], limits[1], 1e-4) << count;
  }
}

TEST(FaultStudy, RefusesADesignOfAnotherEngine) {
  const design::Design other = design_tuner(test::made_up_model(7, 10), {});
  EXPECT_THAT(
      [&] {
        studied(other, {1, 0.0, 1, 1});
      },
      testing::ThrowsMessage<std::invalid_argument>(
          testing::HasSubstr("study faults: the design for the engine '' has no operating_point")));
}

}  // namespace
}  // namespace ehm::tuner_design
