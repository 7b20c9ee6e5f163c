// SPDX-License-Identifier: Apache-2.0
// Faults over a whole flight: every case comes round, the measures are what they are called, and one flight before the
// monitor's own cycle. Studies of many: `tuner_design study faults --mission onboard`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "engine_sim/engines/jt9d_engine.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/faults/mission_fault_study.h"
#include "tuner_design/linearise/linearise.h"
#include "tuner_design/print/studies/mission_fault_text.h"

namespace ehm::tuner_design {
namespace {

TEST(MissionSlots, KeepOffEachOtherAndEveryCaseComesRoundInEveryMoment) {
  std::map<Moment, std::set<std::pair<const FaultRow*, std::size_t>>> seen;
  for (std::uint64_t flight = 0; flight < 40; ++flight) {
    const std::vector<MissionSlot> slots = mission_slots(7, 10, flight);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      EXPECT_NE(slots[i].what.row->broken, Broken::nothing);
      seen[slots[i].moment].insert({slots[i].what.row, slots[i].what.channel});
      if (i > 0) {
        EXPECT_GT(slots[i].onset_s, slots[i - 1].onset_s + 30.0);
      }
    }
  }
  for (const auto& [moment, cases] : seen) EXPECT_EQ(cases.size(), 8u * 7u + 10u) << static_cast<int>(moment);
  EXPECT_EQ(seen.size(), moment_names.size());
}

TEST(Share, HasWilsonsInterval) {
  // Agresti & Coull, Am. Stat. 52 (1998) 119: 0 of 10 gives 0 to 0.278
  const auto none = Share{0, 10}.interval();
  EXPECT_NEAR(none[0], 0.0, 1e-12);
  EXPECT_NEAR(none[1], 0.2775, 1e-4);
  const auto most = Share{81, 100}.interval();
  EXPECT_NEAR(most[0], 0.7222, 1e-4);
  EXPECT_NEAR(most[1], 0.8749, 1e-4);
  EXPECT_EQ((Share{0, 0}.interval()), (std::array<double, 2>{0.0, 1.0}));
}

const design::Design& cruise_design() {
  static const design::Design made = [] {
    LineariseOptions options;
    options.flight = {10668.0, 0.8, 0.0};
    options.demand = {engine_sim::DemandKind::t40_k, cruise_t40_k};
    options.method = LineariseMethod::fleet;
    return design_tuner(linearise(engine_sim::default_engine(), options).model, {});
  }();
  return made;
}

TEST(MissionFaultStudy, OneFlightNamesWhatBreaksAndInventsNothing) {
  MissionFaultOptions options;
  options.engine = engine_sim::default_engine();
  options.flights = 1;
  options.fault_free = 0;
  options.seed = 31;
  const MissionFaultStudy study = run_mission_fault_study(cruise_design(), options, [](double) {});
  EXPECT_TRUE(study.failed.empty());
  EXPECT_EQ(study.alarms_between, 0u);
  EXPECT_LE(study.not_in_use, 3u);
  const MissionFaultRow all = sum_of(study, [](const MissionFaultRow&) { return true; });
  EXPECT_GT(all.flown, 35u);
  EXPECT_GE(all.detected + 4, all.flown);
  EXPECT_GE(all.right + 2, all.detected);
  EXPECT_LT(all.detect_s, 6.0);
  EXPECT_LE(all.detect_s, all.diagnose_s + 1.0);
  std::ostringstream text;
  print_mission_fault_study(study, text);
  EXPECT_THAT(text.str(), testing::HasSubstr("AIR4985"));
  const std::string csv = mission_fault_study_as_csv(study);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), static_cast<std::ptrdiff_t>(study.flights[0].slots.size() + 1));
  EXPECT_EQ(mission_fault_study_as_json(study)["flights"], 1);
}

TEST(MissionFaultStudy, AnEstimatorThatTheDesignDoesNotHaveIsNamed) {
  MissionFaultOptions options;
  options.engine = engine_sim::default_engine();
  options.estimator = "scheduled";
  EXPECT_THROW(run_mission_fault_study(cruise_design(), options, [](double) {}), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::tuner_design
