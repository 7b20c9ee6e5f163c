// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/config/table_reader.h"

#include "deploy/runtime/config/schema.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm::config;
using ehm::test::message_of;

std::string error_of(const std::string& toml, const std::function<void(TableReader&)>& read) {
  const toml::table table = toml::parse(toml);
  TableReader reader("f.toml", "wear", table);
  return message_of<ConfigError>([&] { read(reader); });
}

TEST(TableReader, ReadsWhatIsThereAndFallsBackWhereAllowed) {
  const toml::table table = toml::parse("x = 1.5\nname = \"Nf\"\nids = [1, 2]\n");
  TableReader reader("f.toml", "t", table);
  EXPECT_DOUBLE_EQ(reader.real("x", 0, 2), 1.5);
  EXPECT_DOUBLE_EQ(reader.real_or("y", 7.0, 0, 2), 7.0);
  EXPECT_EQ(reader.choice("name", {"Nf", "Nc"}), "Nf");
  EXPECT_EQ(reader.integers("ids", 1, 9), (std::vector<std::int64_t>{1, 2}));
  EXPECT_NO_THROW(reader.finish());
}

TEST(TableReader, NamesEveryMistake) {
  EXPECT_EQ(error_of("x = 3", [](TableReader& t) { t.real("x", 0, 2); }),
            "f.toml:1: 'wear.x' is 3, allowed is a number from 0 to 2");
  EXPECT_EQ(error_of("y = 3", [](TableReader& t) { t.real("x", 0, 2); }),
            "f.toml:1: 'wear.x' is missing, allowed is a number from 0 to 2");
  EXPECT_EQ(error_of("x = \"a\"",
                     [](TableReader& t) {
                       t.choice("x", {"b", "c"});
                     }),
            "f.toml:1: 'wear.x' is 'a', allowed is one of b, c");
  EXPECT_EQ(error_of("x = [0]", [](TableReader& t) { t.integers("x", 1, 2); }),
            "f.toml:1: 'wear.x' has 0, allowed is an array of whole numbers from 1 to 2");
  EXPECT_EQ(error_of("initail = 3",
                     [](TableReader& t) {
                       t.real_or("initial", 0, 0, 2);
                       t.finish();
                     }),
            "f.toml:1: unknown key 'wear.initail'; did you mean 'initial'?");
}

}  // namespace
