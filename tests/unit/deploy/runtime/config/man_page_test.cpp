// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/man_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <sstream>

namespace {

using namespace ehm::config;
using testing::HasSubstr;
using testing::Not;

class ManPageTest : public testing::Test {
 protected:
  ManPageTest() { app_.footer("Exit codes: 0 done."); }
  std::string page() const { return man_page({.app = &app_}); }
  std::string text_;
  CLI::App app_{"Flies an engine. And more.\nIn two lines.", "flyer"};
};

TEST_F(ManPageTest, NameLineIsTheFirstSentence) {
  EXPECT_THAT(page(), HasSubstr("\nflyer \\- flies an engine\n"));
  EXPECT_THAT(page(), HasSubstr(".PP\nFlies an engine. And more.\n.br\nIn two lines.\n"));
  EXPECT_THAT(page(), HasSubstr(".SH EXIT STATUS\n.PP\nExit codes: 0 done.\n"));
}

TEST_F(ManPageTest, TextIsNeverARequest) {
  app_.add_option("--dot", text_, ".br is text");
  app_.add_option("--quote", text_, "'tis text");
  app_.add_option("--back", text_, "a\\fBc");
  EXPECT_THAT(page(), HasSubstr("\n\\&.br is text\n"));
  EXPECT_THAT(page(), HasSubstr("\n\\&'tis text\n"));
  EXPECT_THAT(page(), HasSubstr("\na\\efBc\n"));
  EXPECT_THAT(page(), HasSubstr("\\fB\\-\\-dot\\fR"));
}

TEST_F(ManPageTest, OptionsSayTypeDefaultAndNeed) {
  int threads = 4;
  app_.add_option("--threads", threads, "how many")->capture_default_str();
  app_.add_option("--out", text_, "where")->required()->type_name("FILE");
  bool on = false;
  app_.add_flag("--hidden", on, "nobody's business")->group("");
  EXPECT_THAT(page(), HasSubstr("\\fB\\-\\-threads\\fR INT=4\nhow many\n"));
  EXPECT_THAT(page(), HasSubstr("\\fB\\-\\-out\\fR FILE REQUIRED\nwhere\n"));
  EXPECT_THAT(page(), Not(HasSubstr("hidden")));
}

TEST_F(ManPageTest, CommandsComeWithTheirOwnOptions) {
  EXPECT_THAT(page(), Not(HasSubstr(".SH COMMANDS")));
  EXPECT_THAT(page(), HasSubstr(".SH SYNOPSIS\n\\fBflyer\\fR [OPTIONS]\n.SH"));
  CLI::App* land = app_.add_subcommand("land", "Lands it");
  land->add_option("--gear", text_, "which gear");
  land->add_option_group("weather")->add_option("--wind", text_, "from where");
  EXPECT_THAT(page(), HasSubstr("\n.br\n\\fBflyer\\fR COMMAND [OPTIONS]\n"));
  EXPECT_THAT(page(), HasSubstr(".SH COMMANDS\n.SS land\n.PP\nLands it\n"));
  EXPECT_THAT(page(), HasSubstr("\\fB\\-\\-gear\\fR"));
  EXPECT_THAT(page(), HasSubstr("\\fB\\-\\-wind\\fR"));
  CLI::App service{"Serves.", "service"};
  EXPECT_THAT(man_page({.app = &service, .commands = &app_}), HasSubstr(".SS land\n"));
}

TEST_F(ManPageTest, KeysStandOnceWithDefaultRangeFlagAndVariable) {
  Schema schema;
  double sigma = 5.0;
  schema.real("checks.gate_sigma", sigma, 2, 20, "sigma", "innovation gate");
  schema.tables("limit", "an event at a limit", {});
  schema.add_flags(app_);
  sigma = 7.0;  // loaded values are not defaults
  const std::string text = man_page({.app = &app_, .schema = &schema});
  EXPECT_THAT(text, HasSubstr(".SS [checks]\n.TP\n\\fBchecks.gate_sigma\\fR = 5\n"
                              "innovation gate: a number from 2 to 20 sigma.\n.br\n"
                              "\\fB\\-\\-checks\\-gate\\-sigma\\fR, \\fBEHM_CHECKS_GATE_SIGMA\\fR\n"));
  EXPECT_THAT(text, HasSubstr(".SS [[limit]]\nan event at a limit.\n"));
  EXPECT_EQ(text.find("\\-\\-checks\\-gate\\-sigma"), text.rfind("\\-\\-checks\\-gate\\-sigma"));
  EXPECT_THAT(text, HasSubstr(".TH flyer 8 "));
  EXPECT_THAT(text, HasSubstr("/etc/ehm/flyer.toml"));
}

TEST_F(ManPageTest, FlagPrintsThePageAndEndsTheProgram) {
  app_.require_subcommand(1);  // --man comes before what a command line else needs
  app_.add_subcommand("land", "Lands it");
  add_man_flag(app_, {.app = &app_});
  const std::array arguments{"flyer", "--man"};
  std::ostringstream out, err;
  try {
    app_.parse(static_cast<int>(arguments.size()), arguments.data());
    FAIL() << "the parsing went on";
  } catch (const CLI::ParseError& end) {
    EXPECT_EQ(app_.exit(end, out, err), 0);
  }
  EXPECT_EQ(out.str(), page());
  EXPECT_EQ(err.str(), "");
}

}  // namespace
