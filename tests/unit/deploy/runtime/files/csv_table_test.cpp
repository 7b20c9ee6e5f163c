// SPDX-License-Identifier: Apache-2.0
// Reading CSV as people and spreadsheets write it, and refusing what is not CSV; writing files as a whole.

#include "deploy/runtime/files/csv_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/file_error.h"

namespace ehm::files {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string path_of(const std::string& name) {
  return testing::TempDir() + "ehm-csv-" + std::to_string(getpid()) + "-" + name;
}

class FilesTest : public testing::Test {
 protected:
  ~FilesTest() override { std::filesystem::remove(path_); }
  CsvTable read(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return read_csv(path_);
  }
  std::string error(const std::string& text) {
    try {
      read(text);
    } catch (const FileError& e) {
      const std::string message = e.what();
      EXPECT_TRUE(message.starts_with(path_)) << message;
      return message.substr(path_.size());
    }
    return "accepted";
  }
  std::string content() const {
    std::ostringstream text;
    text << std::ifstream(path_).rdbuf();
    return text.str();
  }
  std::string path_ = path_of("a.csv");
};

TEST_F(FilesTest, ReadsCellsAndTheirLines) {
  const CsvTable table = read("a,b\n1,2\n3,4\n");
  EXPECT_THAT(table.header.cells, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "4"));
  EXPECT_EQ(table.place(table.rows[1]), path_ + ":3");
  EXPECT_EQ(table.column("b"), 1u);
  EXPECT_EQ(table.column("c"), std::nullopt);
}

TEST_F(FilesTest, ToleratesWhatSpreadsheetsWrite) {
  const CsvTable table = read("\xEF\xBB\xBF\"a\", b \r\n\r\n\"1\", 2\r\n3,\"x, \"\"y\"\"\"\r\n\n\r\n");
  EXPECT_THAT(table.header.cells, ElementsAre("a", "b"));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_THAT(table.rows[0].cells, ElementsAre("1", "2"));
  EXPECT_EQ(table.rows[0].line, 3u);  // blank lines count
  EXPECT_THAT(table.rows[1].cells, ElementsAre("3", "x, \"y\""));
  EXPECT_THAT(read("a,b\n1,2").rows[0].cells, ElementsAre("1", "2"));  // no newline at the end
  EXPECT_THAT(read("a,b\r1,2\r").rows[0].cells, ElementsAre("1", "2"));
}

TEST_F(FilesTest, RefusesWhatIsNoTable) {
  EXPECT_EQ(error(""), ": is empty; its first line is to name the columns");
  EXPECT_EQ(error("\n\r\n"), ": is empty; its first line is to name the columns");
  EXPECT_EQ(error("a,b\n"), ": has no row below its header");
  EXPECT_THAT(error("a,b\n1,2\n3\n"), HasSubstr(":3: 1 cells found, 2 expected, as many as the header has"));
  EXPECT_THAT(error("a,b\n1,2,\n"), HasSubstr(":2: 3 cells found, 2 expected, as many as the header has"));
  EXPECT_EQ(error("a,b,a\n1,2,3\n"), ":1: column 'a' appears twice");
  EXPECT_EQ(error("a,b\n1,\"2\n"), ":2: quotes do not match: '1,\"2'");
  EXPECT_EQ(error("a,b\n1,2\"3\n"), ":2: quotes do not match: '1,2\"3'");
}

TEST_F(FilesTest, RefusesWhatCannotBeRead) {
  EXPECT_THROW(read_csv("/nonexistent/a.csv"), FileError);
  EXPECT_THROW(read_csv("/"), FileError);
}

TEST(Numbers, AreTakenWholeAndFinite) {
  EXPECT_EQ(parse_number("-1.5e3"), -1500.0);
  EXPECT_EQ(parse_number("+35"), 35.0);
  for (const char* text : {"", "1x", " 1", "1 ", "1,5", "0x10", "nan", "inf", "-inf", "1e999", "+-1", "++1", "+"})
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
}

TEST(Numbers, AreWrittenSoThatTheyReadBack) {
  for (const double x : {0.0, 0.1, 1.0 / 3.0, 1e300, 101325.0, std::numeric_limits<double>::denorm_min()})
    EXPECT_EQ(parse_number(shortest(x)), x);
  EXPECT_EQ(shortest(0.1), "0.1");
}

TEST(Messages, RepeatTextSafely) {
  EXPECT_EQ(in_quotes("a\x1b[2Jb"), "'a?[2Jb'");
  EXPECT_LT(in_quotes(std::string(1000, 'x')).size(), 80u);
}

TEST_F(FilesTest, AnAtomicFileWithoutCommitLeavesTheOldContentAndNothingElse) {
  write_file_atomically(path_, "old");
  {
    AtomicFile file(path_);
    file.write("new");
  }
  EXPECT_EQ(content(), "old");
  {
    AtomicFile file(path_);
    file.write("n");
    file.write("ew");
    EXPECT_EQ(content(), "old");
    file.commit();
  }
  EXPECT_EQ(content(), "new");
  EXPECT_FALSE(std::filesystem::exists(path_ + ".tmp" + std::to_string(getpid())));
}

TEST_F(FilesTest, ALinkIsFollowedAndADeviceIsNotReplaced) {
  const std::string link = path_of("link");
  std::filesystem::remove(link);
  write_file_atomically(path_, "old");
  std::filesystem::create_symlink(path_, link);
  write_file_atomically(link, "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(content(), "new");
  std::filesystem::remove(link);
  write_file_atomically("/dev/null", "gone");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_THROW(write_file_atomically("/dev/full", "x"), FileError);
  EXPECT_THROW(write_file_atomically("/tmp", "x"), FileError);
}

}  // namespace
}  // namespace ehm::files
