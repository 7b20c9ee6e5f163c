// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/schema.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm::config;
using ehm::test::ConfigFile;
using ehm::test::message_of;

struct Values {
  double gate_sigma = 5.0;
  std::int64_t samples = 5;
  std::string name = "a";
  std::string mode = "shared";
  bool on = false;
};

class SchemaTest : public testing::Test {
 protected:
  SchemaTest() {
    schema_.real("checks.gate_sigma", values_.gate_sigma, 2, 20, "sigma", "gate");
    schema_.integer("checks.samples", values_.samples, 1, 100, "samples", "bridge");
    schema_.text("names.name", values_.name, "a name");
    schema_.choice("names.mode", values_.mode, {"shared", "exclusive"}, "a mode");
    schema_.flag("names.on", values_.on, "a switch");
  }
  std::string error_of(const std::string& toml) {
    const ConfigFile file(toml);
    const std::string message = message_of<ConfigError>([&] { schema_.load(file.path()); });
    return message.starts_with(file.path()) ? message.substr(file.path().size()) : "other file: " + message;
  }
  void parse(std::vector<std::string> arguments) {
    CLI::App app;
    schema_.add_flags(app);
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
  }
  Schema schema_;
  Values values_;
};

TEST_F(SchemaTest, ReadsAFile) {
  const ConfigFile file(
      "[checks]\ngate_sigma = 4\nsamples = 7\n[names]\nname = \"b\"\nmode = \"exclusive\"\non = true\n");
  schema_.load(file.path());
  EXPECT_DOUBLE_EQ(values_.gate_sigma, 4.0);
  EXPECT_EQ(values_.samples, 7);
  EXPECT_EQ(values_.name, "b");
  EXPECT_EQ(values_.mode, "exclusive");
  EXPECT_TRUE(values_.on);
}

// engine_sim's tables speak of the channels of the model that a key or flag names.
TEST_F(SchemaTest, TablesAreReadAfterAllKeysWhereverTheseAreSet) {
  std::string name_at_table;
  schema_.tables("aaa", "before every key in the file",
                 [&](const std::string&, const toml::array&) { name_at_table = values_.name; });
  parse({"--names-name", "from the flag"});
  const ConfigFile file("[[aaa]]\nx = 1\n[names]\nname = \"from the file\"\n");
  schema_.load(file.path());
  EXPECT_EQ(name_at_table, "from the flag");
}

TEST_F(SchemaTest, ASwitchAloneMeansTrueAndTakesNoOtherFlagForItsValue) {
  parse({"--names-on", "--checks-samples", "7"});
  schema_.load("");
  EXPECT_TRUE(values_.on);
  EXPECT_EQ(values_.samples, 7);
}

TEST_F(SchemaTest, ASwitchMayBeSaidToBeOff) {
  values_.on = true;
  parse({"--names-on", "false"});
  schema_.load("");
  EXPECT_FALSE(values_.on);
}

TEST_F(SchemaTest, TellsWhichKeysWereGivenEvenWithTheirDefault) {
  EXPECT_TRUE(schema_.given().empty());
  parse({"--checks-samples", "5"});
  const ConfigFile file("[names]\non = false\n");
  schema_.load(file.path());
  EXPECT_EQ(schema_.given(), (std::vector<std::string>{"checks.samples", "names.on"}));
}

TEST_F(SchemaTest, TellsWhichStructuredSectionsTheFileHas) {
  schema_.tables("wear", "", [](const std::string&, const toml::array&) {});
  schema_.tables("profile", "", [](const std::string&, const toml::array&) {});
  const ConfigFile file("[[wear]]\nx = 1\n");
  schema_.load(file.path());
  EXPECT_EQ(schema_.given(), std::vector<std::string>{"wear"});
}

TEST_F(SchemaTest, EachMistakeHasOneMessageWithPlaceKeyValueAndAllowedRange) {
  EXPECT_EQ(error_of("[checks]\ngate_sigma = 1.5\n"),
            ":2: 'checks.gate_sigma' is 1.5, allowed is a number from 2 to 20 sigma");
  EXPECT_EQ(error_of("[checks]\ngate_sigma = nan\n"),
            ":2: 'checks.gate_sigma' is nan, allowed is a number from 2 to 20 sigma");
  EXPECT_EQ(error_of("[checks]\ngate_sigma = \"5\"\n"),
            ":2: 'checks.gate_sigma' has the wrong type, allowed is a number from 2 to 20 sigma");
  EXPECT_EQ(error_of("[checks]\nsamples = 2.5\n"),
            ":2: 'checks.samples' has the wrong type, allowed is a whole number from 1 to 100 samples");
  EXPECT_EQ(error_of("[names]\nmode = \"both\"\n"), ":2: 'names.mode' is 'both', allowed is one of shared, exclusive");
  EXPECT_EQ(error_of("[checks]\ngate_sigm = 5\n"),
            ":2: unknown key 'checks.gate_sigm'; did you mean 'checks.gate_sigma'?");
  EXPECT_EQ(error_of("[elsewhere]\nx = 5\n"),
            ":1: unknown key 'elsewhere'; the reference lists the known ones (--print-config)");
  EXPECT_TRUE(error_of("[checks\n").starts_with(":1:8: not valid TOML: ")) << error_of("[checks\n");
}

TEST_F(SchemaTest, NamesAMissingFile) {
  EXPECT_EQ(message_of<ConfigError>([&] { schema_.load("nowhere.toml"); }),
            "nowhere.toml: no such file. Check the path.");
}

TEST_F(SchemaTest, EnvironmentIsAboveTheFileAndFlagsAreAboveTheEnvironment) {
  const ConfigFile file("[checks]\ngate_sigma = 4\nsamples = 4\n");
  setenv("EHM_CHECKS_GATE_SIGMA", "6", 1);
  setenv("EHM_CHECKS_SAMPLES", "6", 1);
  parse({"--checks-samples", "8"});
  schema_.load(file.path());
  unsetenv("EHM_CHECKS_GATE_SIGMA");
  unsetenv("EHM_CHECKS_SAMPLES");
  EXPECT_DOUBLE_EQ(values_.gate_sigma, 6.0);
  EXPECT_EQ(values_.samples, 8);
}

TEST_F(SchemaTest, MistakesInFlagsAndEnvironmentAreNamed) {
  parse({"--checks-gate-sigma", "five"});
  EXPECT_EQ(message_of<ConfigError>([&] { schema_.load(""); }),
            "flag --checks-gate-sigma: 'checks.gate_sigma' is 'five', allowed is a number from 2 to 20 sigma");
  setenv("EHM_NAMES_ON", "yes", 1);
  EXPECT_EQ(message_of<ConfigError>([&] { schema_.load(""); }),
            "environment variable EHM_NAMES_ON: 'names.on' is 'yes', allowed is true or false");
  unsetenv("EHM_NAMES_ON");
  setenv("EHM_NAMES_NO", "true", 1);
  EXPECT_EQ(message_of<ConfigError>([&] { schema_.load(""); }),
            "environment variable EHM_NAMES_NO: unknown; did you mean 'EHM_NAMES_ON'?");
  unsetenv("EHM_NAMES_NO");
  setenv("EHM_OF_ANOTHER_PROGRAM", "1", 1);
  EXPECT_EQ(message_of<ConfigError>([&] { schema_.load(""); }).substr(0, 5), "flag ");  // and not of that
  unsetenv("EHM_OF_ANOTHER_PROGRAM");
}

TEST_F(SchemaTest, ThePrintedReferenceReadsBackAsTheDefaults) {
  const ConfigFile file(schema_.reference());
  values_ = {9.0, 9, "z", "exclusive", true};
  schema_.load(file.path());
  EXPECT_DOUBLE_EQ(values_.gate_sigma, 5.0);
  EXPECT_EQ(values_.samples, 5);
  EXPECT_EQ(values_.name, "a");
  EXPECT_EQ(values_.mode, "shared");
  EXPECT_FALSE(values_.on);
}

}  // namespace
