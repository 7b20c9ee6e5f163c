// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/text_layout.h"

#include <gtest/gtest.h>

namespace {

using namespace ehm::demo;

TEST(Wrapped, KeepsWordsWholeAndIndentsWhatFollows) {
  EXPECT_EQ(wrapped("one two", 40, 2), "one two\n");
  EXPECT_EQ(wrapped("0123456789 0123456789 0123456789 0123456789", 40, 2),
            "0123456789 0123456789 0123456789\n  0123456789\n");
  EXPECT_EQ(wrapped("  begins indented", 40, 4), "  begins indented\n");
  EXPECT_EQ(wrapped("", 40, 2), "");
}

TEST(Wrapped, FillsTheLineToItsLastColumn) {
  const std::string forty = "0123456789 0123456789 0123456789 0123456";
  ASSERT_EQ(forty.size(), 40u);
  EXPECT_EQ(wrapped(forty, 40, 2), forty + "\n");
  EXPECT_EQ(wrapped(forty + "7", 40, 2), "0123456789 0123456789 0123456789\n  01234567\n");
}

TEST(Wrapped, CutsAWordThatIsLongerThanALine) {
  EXPECT_EQ(wrapped("a " + std::string(60, 'x'), 40, 2),
            "a\n  " + std::string(38, 'x') + "\n  " + std::string(22, 'x') + "\n");
}

TEST(Wrapped, NeverCutsWithinAUtf8Character) {
  std::string word;
  for (int i = 0; i < 41; ++i) word += "\u00e4";
  EXPECT_EQ(wrapped(word, 40, 0), word.substr(0, 80) + "\n\u00e4\n");
}

TEST(ColumnsText, AlignsToTheWidestCell) {
  EXPECT_EQ(columns_text({{"", "value"}, {"a", "1"}, {"long", "20"}}, "lr", 40),
            "        value\n"
            "  a         1\n"
            "  long     20\n");
}

TEST(ColumnsText, NarrowsGapsThenNamesAndNeverNumbers) {
  const std::vector<std::vector<std::string>> lines{{std::string(30, 'n'), "123456789", "K"}};
  EXPECT_EQ(columns_text(lines, "lrl", 46), "  " + std::string(30, 'n') + "  123456789  K\n");
  EXPECT_EQ(columns_text(lines, "lrl", 43), " " + std::string(30, 'n') + " 123456789 K\n");
  EXPECT_EQ(columns_text(lines, "lrl", 40), " " + std::string(26, 'n') + "~ 123456789 K\n");
}

}  // namespace
