// SPDX-License-Identifier: Apache-2.0
// Estimators by engine: those of [estimator], but for what an [[engine]] table names.

#include "monitor/shared/engine_estimators.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace {

using namespace ehm::monitor;
using testing::ElementsAre;
using testing::IsEmpty;

MonitorConfig fleet() {
  MonitorConfig config;
  config.cycle.estimator.published = "tuner";
  config.cycle.estimator.shadow = "ekf,ukf";
  config.engines.push_back({.ids = {1}, .design = "a.json"});
  config.engines.push_back({.ids = {2}, .design = "a.json", .published = "ekf", .shadow = "tuner,ukf"});
  config.engines.push_back({.ids = {3}, .design = "a.json", .published = {}, .shadow = ""});
  return config;
}

TEST(EngineEstimators, AreTheCommonOnesUnlessTheTableNamesOthers) {
  const MonitorConfig config = fleet();
  EXPECT_EQ(options_of(config, config.engines[0]), config.cycle);
  const CycleOptions second = options_of(config, config.engines[1]);
  EXPECT_EQ(second.estimator.published, "ekf");
  EXPECT_EQ(second.estimator.shadow, "tuner,ukf");
  EXPECT_EQ(options_of(config, config.engines[2]).estimator.published, "tuner");
  EXPECT_EQ(options_of(config, config.engines[2]).estimator.shadow, "");  // none, which is not the same as unnamed
}

TEST(EngineEstimators, ShadowsOfAllEnginesHaveOneTopicEach) {
  const MonitorConfig config = fleet();
  const auto all = all_shadow_names(config);
  EXPECT_THAT(all, ElementsAre("ekf", "ukf", "tuner"));
  EXPECT_THAT(shadow_places(config.cycle.estimator, all), ElementsAre(0, 1));
  EXPECT_THAT(shadow_places(options_of(config, config.engines[1]).estimator, all), ElementsAre(2, 1));
  EXPECT_THAT(shadow_places(options_of(config, config.engines[2]).estimator, all), IsEmpty());
  EXPECT_EQ(most_companions(config), 4u);
}

TEST(EngineEstimators, WhatATableNamesIsChecked) {
  MonitorConfig config = fleet();
  config.engines[1].shadow = "ekf";  // published for this engine already
  EXPECT_THROW(all_shadow_names(config), std::invalid_argument);
  config.engines[1].shadow = "kalman";
  EXPECT_THROW(all_shadow_names(config), std::invalid_argument);
}

}  // namespace
