// SPDX-License-Identifier: Apache-2.0
// Studies from the command line: their pages, and studies in the report of a design.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "monitor/design/design_file.h"
#include "tests/temporary_folder.h"
#include "tests/unit/tuner_design/cli/run_command.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/cli/studies/study_table.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::tuner_design {
namespace {

using test::CommandResult;
using test::run_command;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<std::string> quick_study{"study", "kosanam-5.2", "--batches", "5", "--runs", "10", "--seed", "3"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(StudyCommand, APageComesBesideTheSameTextAndCsv) {
  const test::TemporaryFolder folder;
  const std::string html = folder.path("s.html");
  const CommandResult plain = run_command(with(quick_study, {"--csv", folder.path("plain.csv")}));
  const CommandResult paged =
      run_command(with(quick_study, {"--csv", folder.path("paged.csv"), "--html", html, "--threads", "1"}));
  ASSERT_EQ(paged.code, 0) << paged.err;
  EXPECT_EQ(paged.out, plain.out);
  EXPECT_EQ(folder.content("paged.csv"), folder.content("plain.csv"));
  const std::string page = folder.content("s.html");
  // what makes the numbers, and nothing of where they went
  EXPECT_THAT(page, HasSubstr("tuner_design study kosanam-5.2 --runs 10 --batches 5 --seed 3<"));
  EXPECT_THAT(page, Not(HasSubstr("s.html")));
  ASSERT_EQ(run_command(with(quick_study, {"--html", html, "--threads", "2"})).code, 0);
  EXPECT_EQ(folder.content("s.html"), page);  // same seed, same bytes
}

TEST(StudyCommand, APageThatCannotBeWrittenIsToldBeforeTheWork) {
  const test::TemporaryFolder folder;
  // hours of work, were it begun
  const CommandResult nowhere = run_command({"study", "lu-6", "--repeats", "10000", "--html", "/nonexistent/s.html"});
  EXPECT_EQ(nowhere.code, 2);
  EXPECT_THAT(nowhere.err, HasSubstr("/nonexistent/s.html"));
  EXPECT_EQ(std::count(nowhere.err.begin(), nowhere.err.end(), '\n'), 1) << nowhere.err;
  const std::string file = folder.path("s");
  const CommandResult twice = run_command({"study", "lu-6", "--repeats", "10000", "--csv", file, "--html", file});
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("--html"));
  for (const StudyKind& kind : study_kinds()) {
    if (kind.has_page) continue;
    const CommandResult none = run_command({"study", kind.name, "--html", file});
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err, HasSubstr("does not go with " + std::string(kind.name)));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(StudyCommand, AnInputIsNeverWrittenOver) {
  const test::TemporaryFolder folder;
  const std::string design = folder.path("design.json");
  design::write_design(design_tuner(test::made_up_model(), {}), design);
  const CommandResult over = run_command({"study", "family", "--design", design, "--html", design});
  EXPECT_EQ(over.code, 2);
  EXPECT_THAT(over.err, HasSubstr("--html is the input itself"));
  EXPECT_NO_THROW(design::read_design(design));
}

TEST(StudyCommand, EveryStudyIsInTheTableOnceAndItsResultIsOne) {
  std::vector<std::string> names = study_names();
  for (const StudyKind& kind : study_kinds()) {
    EXPECT_EQ(std::count(names.begin(), names.end(), kind.name), 1) << kind.name;
    EXPECT_EQ(study_kind(kind.result).result, std::string(kind.result)) << kind.name;
    EXPECT_TRUE(kind.has_page || !kind.in_a_report) << kind.name;
  }
}

TEST(ReportStudies, StandInTheDesignsPage) {
  const test::TemporaryFolder folder;
  const std::string design = folder.path("design.json"), html = folder.path("r.html");
  design::write_design(design_tuner(test::made_up_model(), {}), design);
  // the pendulum stands once; the family's engine is not that of the design, which the page says
  const CommandResult result =
      run_command({"report", design, "-o", html, "--quick", "--studies",
                   "endurthi-ukf-pendulum,endurthi-ukf-pendulum,family", "--csv-dir", folder.path("numbers")});
  ASSERT_EQ(result.code, 0) << result.err;
  const std::string page = folder.content("r.html");
  EXPECT_THAT(page, HasSubstr("id=\"pendulum-figure\""));
  EXPECT_THAT(page, HasSubstr("tuner_design study endurthi-ukf-pendulum --engine jt9d --seed 1"));
  EXPECT_THAT(page, HasSubstr("It could not be run: "));
  EXPECT_TRUE(std::filesystem::exists(folder.path("numbers/pendulum-table.csv")));
  const std::string check = std::string("python3 ") + EHM_SOURCE_DIR +
                            "/tests/unit/tuner_design/report/check_page.py " + html + " " + folder.path("numbers");
  EXPECT_EQ(std::system(check.c_str()), 0);
  ASSERT_EQ(run_command({"report", design, "-o", html, "--quick"}).code, 0);
  EXPECT_THAT(folder.content("r.html"), Not(HasSubstr("pendulum")));  // only when asked for
}

TEST(ReportStudies, AnUnknownNameIsToldWithThoseThatAre) {
  const CommandResult result = run_command({"report", "d.json", "-o", "r.html", "--studies", "lu-4,lu-44"});
  EXPECT_EQ(result.code, 2);
  for (const char* said : {"--studies", "lu-44", "kosanam-5.1", "family", "all"})
    EXPECT_THAT(result.err, HasSubstr(said));
  // what has no place in a report: the tables of Simon & Garg are there already
  EXPECT_EQ(run_command({"report", "d.json", "-o", "r.html", "--studies", "simon-garg-4"}).code, 2);
}

}  // namespace
}  // namespace ehm::tuner_design
