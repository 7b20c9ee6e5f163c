// SPDX-License-Identifier: Apache-2.0
// Recordings, tables and their maps that cannot be read or written are refused, by name, before anything starts.

#include <gmock/gmock.h>

#include <filesystem>

#include "tests/integration/pair/pair.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm::test;
using testing::HasSubstr;

class RefusedRecordingTest : public PairTest {
 protected:
  TemporaryFolder folder_;
};

TEST_F(RefusedRecordingTest, WhatCannotBeReadOrWrittenIsNamedBeforeAnythingStarts) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& message) {
    Process process(arguments);
    EXPECT_EQ(process.wait(seconds(20)), 2) << process.log();
    EXPECT_THAT(process.log(), HasSubstr(message));
  };
  const std::vector<std::string> monitor{monitor_program(), "--monitor-design", design_file()};
  const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const std::string text = folder_.file("text.csv", "1 2 3\n"), out = folder_.path("out.h5");
  refused(with(monitor, {"--offline", "nowhere.h5", "--out", out}), "nowhere.h5: no such file");
  refused(with(monitor, {"--offline", text, "--out", out}), "text.csv: cannot read this as a recording");
  refused(with(monitor, {"--offline", text}), "'offline.file' and 'offline.out' need each other");
  refused(with(monitor, {"--record", folder_.path("no/such/x.h5"), "--check-config"}), "x.h5: cannot be written");
  refused(with(monitor, {"--record-max-mb", "0"}), "'record.max_mb' is 0, allowed is a whole number from 1");
  refused({simulator_program(), "--replay", "nowhere.h5"}, "nowhere.h5: no such file");
  refused({simulator_program(), "--replay", "nowhere.h5", "--run-seed", "3"},
          "a replay flies nothing: it does not use 'run.seed'");
  refused({simulator_program(), "--replay", text, "--column-map", "nowhere.toml"}, "nowhere.toml: no such file");
  const auto map_of = [&](const std::string& sample_time_s) {
    return folder_.file(
        "map.toml",
        "[file]\nseparator = \"blank\"\nheader = false\nengine_id_column = 1\nsample_time_s = " + sample_time_s +
            "\n[[flight]]\nname = \"altitude_m\"\nvalue = 0\n[[flight]]\nname = \"mach\"\nvalue = 0\n"
            "[[flight]]\nname = \"delta_isa_k\"\nvalue = 0\n[[actuator]]\nname = \"fuel_flow\"\ncolumn = 2\n"
            "[[sensor]]\nname = \"T24\"\ncolumn = 3\n");
  };
  // The design is made for 0.015 s; the monitor's own watch allows 10 %.
  const std::string map = map_of("0.0164");
  refused(with(monitor, {"--offline", text, "--column-map", map, "--out", out}),
          "has the actuators fuel_flow, the design needs fuel_flow, VSV, VBV, customer_bleed, power_offtake");
  refused(with(monitor, {"--offline", text, "--column-map", map_of("1"), "--out", out}),
          "map.toml: 'file.sample_time_s' is 1, the design ");
  EXPECT_FALSE(std::filesystem::exists(out));
}

}  // namespace
