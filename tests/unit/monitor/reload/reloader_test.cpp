// SPDX-License-Identifier: Apache-2.0
// Which keys may change while the monitor flies: those that its engines are made of, and no other.

#include "monitor/reload/reloader.h"

#include <gmock/gmock.h>

#include <set>

#include "deploy/runtime/config/schema.h"
#include "monitor/service/config.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using testing::HasSubstr;

std::map<std::string, std::string> defaults() {
  config::Schema schema;
  MonitorConfig config;
  declare(schema, config);
  return schema.values();
}

std::string refusal(const std::string& key, const std::string& value) {
  auto wanted = defaults();
  EXPECT_TRUE(wanted.contains(key)) << key;
  wanted[key] = value;
  return refused_changes(defaults(), wanted);
}

TEST(ReloadableKeys, AreThoseOfTheEnginesAndTheLogsLevel) {
  const std::set<std::string> sections{"checks", "validity", "shift", "faults", "fleet"};
  const std::set<std::string> keys{"monitor.design", "monitor.max_engines", "log.level"};
  for (const auto& [key, value] : defaults()) {
    const bool may_change = sections.contains(key.substr(0, key.find('.'))) || keys.contains(key);
    EXPECT_EQ(refusal(key, value + "9").empty(), may_change) << key;
  }
}

TEST(ReloadableKeys, AreTakenFromTheNewConfigurationByTheEngines) {
  const std::string flying = defaults().at("fleet.warn_sigma");
  EXPECT_EQ(flying, "5");
  EXPECT_EQ(refusal("fleet.warn_sigma", "7"), "");
  CycleOptions before, after;
  after.fleet.warn_sigma = 7.0;
  EXPECT_FALSE(before == after);  // what tells that an engine needs a new filter
}

TEST(ReloadableKeys, ARefusalNamesTheKeyAndBothValues) {
  EXPECT_EQ(refusal("estimator.published", "\"time_varying\""),
            "'estimator.published' is \"tuner\" and cannot become \"time_varying\" while flying: restart the monitor");
  EXPECT_THAT(refusal("monitor.max_engines", "0"), HasSubstr("can only grow"));
  auto wanted = defaults();
  wanted["dds.domain"] = "7";
  wanted["dds.partition"] = "fleet/b";
  EXPECT_THAT(refused_changes(defaults(), wanted), HasSubstr("; 'dds.partition'"));
  EXPECT_EQ(refused_changes(defaults(), defaults()), "");
}

}  // namespace
