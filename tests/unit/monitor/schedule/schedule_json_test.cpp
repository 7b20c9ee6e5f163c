// SPDX-License-Identifier: Apache-2.0
// A schedule in a design file: read as it was written, and what is wrong in it is named.

#include "monitor/design/schedule_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deploy/runtime/files/file_error.h"
#include "tests/unit/monitor/schedule/small_schedule.h"

namespace {

using namespace ehm;
using testing::HasSubstr;

linear_model::LinearModel small_model() {
  linear_model::LinearModel model;
  model.states = {{"N1", "rpm", 2000.0}};
  model.controls = {{"fuel_flow", "kg/s", 2.5}};
  model.health = {{"efficiency", "fraction", 0.0}, {"flow", "fraction", 0.0}};
  model.sensors = {{"N1", "rpm", 2000.0}, {"T", "K", 700.0}};
  model.auxiliary = {{"Fn", "N", 20000.0}};
  return model;
}

std::string refusal(const files::Json& json) {
  try {
    design::schedule_from_json(json, small_model(), "d.json");
  } catch (const files::FileError& error) {
    return error.what();
  }
  return "";
}

TEST(ScheduleJson, IsReadAsItWasWritten) {
  schedule::Schedule s = test::small_schedule();
  s.nodes[2] = {};  // where the engine does not run
  const files::Json json = design::schedule_to_json(s, "d.json");
  const schedule::Schedule read = design::schedule_from_json(json, small_model(), "d.json");
  EXPECT_EQ(design::schedule_to_json(read, "d.json").dump(), json.dump());
  EXPECT_FALSE(read.nodes[2].valid);
  EXPECT_EQ(read.nodes[5].M, s.nodes[5].M);
}

TEST(ScheduleJson, WhatIsWrongIsNamed) {
  const files::Json good = design::schedule_to_json(test::small_schedule(), "d.json");
  files::Json bad = good;
  bad["nodes"].erase(0);
  EXPECT_THAT(refusal(bad), testing::AllOf(HasSubstr("d.json: schedule: 5 nodes"), HasSubstr("tuner_design envelope")));
  bad = good;
  bad["axes"][0]["variable"] = "n2";
  EXPECT_THAT(refusal(bad), HasSubstr("schedule.axes[0].variable is n2"));
  bad = good;
  bad["nodes"][1]["C"] = {{1.0}};
  EXPECT_THAT(refusal(bad), HasSubstr("schedule.nodes[1].C"));
  bad = good;
  bad["fan_speed_state"] = 3;
  EXPECT_THAT(refusal(bad), HasSubstr("schedule.fan_speed_state is 3"));
  bad = good;
  bad["extra"] = 1;
  EXPECT_THAT(refusal(bad), HasSubstr("extra"));
}

}  // namespace
