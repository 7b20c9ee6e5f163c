// SPDX-License-Identifier: Apache-2.0
// Estimates that no engine of the fleet has, on the wire: a warning that names what stands apart, then nothing.

#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;

class PlausibleTest : public PairTest {
 protected:
  /// Flies the simulator as fast as the monitor answers, with these sensor faults: name, kind, magnitude.
  void fly(const std::vector<std::tuple<std::string, std::string, std::string>>& faults, const char* seconds) {
    std::string scenario;
    for (const auto& [sensor, kind, magnitude] : faults)
      scenario += "[[sensor_fault]]\ntime_s = 0\nsensor = \"" + sensor + "\"\nkind = \"" + kind +
                  "\"\nmagnitude = " + magnitude + "\n";
    monitor_ = start_monitor({"--monitor-status-period-s", "0.1"});
    simulator_ = start_simulator({"--rate", "max", "--run-duration-s", seconds}, file("faults.toml", scenario));
  }
  const HealthEvent* event(idl::EventKind kind) const { return listener_.find_event(kind, true); }
  bool level(idl::StatusLevel wanted) const {
    return !listener_.status.empty() && listener_.status.back().level() == static_cast<std::uint32_t>(wanted);
  }
  std::unique_ptr<Process> monitor_, simulator_;
};

// T30 reads 30 K too much from the first sample on: hpc_efficiency is then 28 published sigmas off.
TEST_F(PlausibleTest, ABiasFromTheFirstSampleIsWarnedOf) {
  fly({{"T30", "bias", "30.0"}}, "60");
  ASSERT_TRUE(listener_.await([&] { return event(idl::EventKind::implausible); }));
  EXPECT_STREQ(event(idl::EventKind::implausible)->channel_name().c_str(), "hpc_efficiency");
  EXPECT_TRUE(listener_.await([&] { return level(idl::StatusLevel::warn); }));
  ASSERT_TRUE(listener_.await([&] { return event(idl::EventKind::slow_bias); }));
  EXPECT_STREQ(event(idl::EventKind::slow_bias)->channel_name().c_str(), "T30");
  EXPECT_NEAR(event(idl::EventKind::slow_bias)->value(), 30.0, 6.0);
  EXPECT_TRUE(listener_.health.back().flags() & idl::estimate_flag::implausible);
}

TEST_F(PlausibleTest, ADriftOfAllSensorsIsWarnedOfAndThenWithheld) {
  fly({{"T24", "drift", "0.9"},
       {"T30", "drift", "2.0"},
       {"T48", "drift", "3.0"},
       {"Ps30", "drift", "3.0"},
       {"Nf", "drift", "9.0"},
       {"Nc", "drift", "20.0"}},
      "200");
  ASSERT_TRUE(listener_.await([&] { return event(idl::EventKind::unlikely_engine); }));
  EXPECT_TRUE(listener_.await([&] { return level(idl::StatusLevel::error); }));
  EXPECT_TRUE(listener_.await([&] { return listener_.status.back().samples_withheld() > 100; }));
}

}  // namespace
