// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/usage_answer.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace {

using ehm::config::unknown_command;
using ehm::config::usage_answer;

class UsageAnswerTest : public testing::Test {
 protected:
  UsageAnswerTest() {
    app_.add_option("--dds-domain", domain_, "which")->check(CLI::Range(0, 232));
    app_.add_option("--secret", text_)->group("");
    CLI::App* land = app_.add_subcommand("land", "Lands it");
    land->add_option("--gear", text_, "which gear")->required();
    land->add_option_group("weather")->add_option("--wind-from", text_, "from where");
  }
  /// What is answered; the exit code is in `code_`.
  std::string answer(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), "flyer");
    std::ostringstream out, err;
    try {
      app_.parse(static_cast<int>(arguments.size()), arguments.data());
      return "taken";
    } catch (const CLI::ParseError& error) {
      code_ = usage_answer(app_, error, out, err);
    }
    EXPECT_EQ(out.str().empty(), code_ == 2);
    EXPECT_EQ(err.str().empty(), code_ == 0);
    return code_ == 0 ? out.str() : err.str();
  }
  int domain_ = 0, code_ = -1;
  std::string text_;
  CLI::App app_{"Flies an engine.", "flyer"};
};

TEST_F(UsageAnswerTest, AnUnknownOptionIsNamedWithTheNearest) {
  EXPECT_EQ(answer({"--dds-domian", "3"}),
            "flyer: unknown option --dds-domian; did you mean --dds-domain? See flyer --help\n");
  EXPECT_EQ(code_, 2);
  EXPECT_EQ(answer({"--dds-domian=3"}),
            "flyer: unknown option --dds-domian; did you mean --dds-domain? See flyer --help\n");
  EXPECT_EQ(answer({"--dommain", "3"}),  // without its section
            "flyer: unknown option --dommain; did you mean --dds-domain? See flyer --help\n");
}

TEST_F(UsageAnswerTest, NothingNearIsNoSuggestion) {
  EXPECT_EQ(answer({"--altitude", "3"}), "flyer: unknown option --altitude. See flyer --help\n");
  EXPECT_EQ(answer({"-x"}), "flyer: unknown option -x. See flyer --help\n");
  EXPECT_EQ(answer({"--secrte"}), "flyer: unknown option --secrte. See flyer --help\n");  // hidden ones stay so
  EXPECT_EQ(answer({"extra"}), "flyer: unexpected argument 'extra'. See flyer --help\n");
}

TEST_F(UsageAnswerTest, AWordNearACommandMeansIt) {
  EXPECT_EQ(answer({"--dds-domain", "3", "lnad"}),
            "flyer: unexpected argument 'lnad'; did you mean land? See flyer --help\n");
}

TEST_F(UsageAnswerTest, ACommandAnswersForItsOwnOptions) {
  EXPECT_EQ(answer({"land", "--gaer", "3"}),  // --gear is missing, because it is misspelt
            "flyer land: unknown option --gaer; did you mean --gear? See flyer land --help\n");
  EXPECT_EQ(answer({"land", "--gear", "3", "--wind-form", "N"}),
            "flyer land: unknown option --wind-form; did you mean --wind-from? See flyer land --help\n");
  EXPECT_EQ(answer({"land", "--gear", "3", "--dds-domain", "7"}),
            "flyer land: unknown option --dds-domain. See flyer land --help\n");
}

TEST_F(UsageAnswerTest, OtherErrorsBearTheNameToo) {
  EXPECT_EQ(answer({"land"}), "flyer land: --gear is required. See flyer land --help\n");
  const std::string range = answer({"--dds-domain", "999"});
  EXPECT_TRUE(range.starts_with("flyer: --dds-domain: ")) << range;
  EXPECT_TRUE(range.ends_with(". See flyer --help\n")) << range;
  EXPECT_EQ(code_, 2);
}

TEST_F(UsageAnswerTest, HelpIsNoError) {
  EXPECT_NE(answer({"--help"}).find("Flies an engine."), std::string::npos);
  EXPECT_EQ(code_, 0);
  EXPECT_EQ(answer({"--dds-domain", "3"}), "taken");
}

TEST(UnknownCommand, NamesTheNearestAndAll) {
  EXPECT_EQ(unknown_command("engine_sim", "mpas", {"deck", "maps"}, "the service's options"),
            "engine_sim: unknown command 'mpas'; did you mean maps? Allowed are deck, maps, or the service's options. "
            "See engine_sim --help\n");
  EXPECT_EQ(unknown_command("tuner_design", "fly", {"check"}),
            "tuner_design: unknown command 'fly'. Allowed are check. See tuner_design --help\n");
}

}  // namespace
