// SPDX-License-Identifier: Apache-2.0
// Which files of a folder are resumed, and what is said of the others.

#include "monitor/checkpoint/checkpoint_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/temporary_folder.h"
#include "tests/unit/monitor/checkpoint/some_checkpoint.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using testing::HasSubstr;

constexpr double max_age_s = 60.0;
const std::string flying(64, 'a');

class CheckpointFolderTest : public testing::Test {
 protected:
  void write(std::uint32_t engine_id, const Checkpoint& c) {
    folder_.file("engine_" + std::to_string(engine_id) + ".json", to_text(c));
  }
  ResumeTable read(double age_s = 1.0, const std::string& design = flying) {
    refused_.clear();
    const auto now_ns = test::some_checkpoint().wall_time_ns + static_cast<std::int64_t>(1e9 * age_s);
    return ResumeTable(
        folder_.path(), max_age_s, now_ns, [&](std::uint32_t) { return design; }, refused_);
  }
  test::TemporaryFolder folder_;
  std::vector<RefusedCheckpoint> refused_;
};

TEST_F(CheckpointFolderTest, FreshOnesOfTheFlyingDesignAreResumed) {
  for (const std::uint32_t id : {4000000000u, 2u, 31u}) write(id, test::some_checkpoint(id));
  folder_.file("notes.txt", "not a checkpoint");
  folder_.file("engine_5.json.tmp123", "left by a kill in the middle of writing");
  const ResumeTable table = read();
  EXPECT_TRUE(refused_.empty());
  EXPECT_EQ(table.size(), 3u);
  ASSERT_NE(table.find(31), nullptr);
  EXPECT_EQ(table.find(31)->engine_id, 31u);
  EXPECT_EQ(table.find(4000000000u)->engine_id, 4000000000u);
  EXPECT_EQ(table.find(5), nullptr);
}

TEST_F(CheckpointFolderTest, TheOthersAreNamed) {
  write(1, test::some_checkpoint(1));
  EXPECT_EQ(read(61.0).size(), 0u);
  ASSERT_EQ(refused_.size(), 1u);
  EXPECT_EQ(refused_[0].engine_id, 1u);
  EXPECT_THAT(refused_[0].why, HasSubstr("engine_1.json: is 61"));
  EXPECT_THAT(refused_[0].why, HasSubstr("checkpoint.max_age_s allows 60"));

  read(-61.0);  // the wall clock was set back
  EXPECT_EQ(refused_.size(), 1u);

  read(1.0, std::string(64, 'b'));
  ASSERT_EQ(refused_.size(), 1u);
  EXPECT_THAT(refused_[0].why, HasSubstr("was made with design aaaaaaaaaaaa, now flies bbbbbbbbbbbb"));

  read(1.0, "");
  ASSERT_EQ(refused_.size(), 1u);
  EXPECT_THAT(refused_[0].why, HasSubstr("no design serves"));

  write(8, test::some_checkpoint(9));
  folder_.file("engine_6.json", "{");
  folder_.file("engine_5.json", std::string(2 << 20, 'x'));
  EXPECT_EQ(read().size(), 1u);
  ASSERT_EQ(refused_.size(), 3u);
}

TEST_F(CheckpointFolderTest, AMissingFolderIsSaid) {
  std::vector<RefusedCheckpoint> refused;
  const ResumeTable table(
      folder_.path("absent"), 1.0, 0, [](std::uint32_t) { return flying; }, refused);
  EXPECT_EQ(table.size(), 0u);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_THAT(refused[0].why, HasSubstr("absent"));
}

}  // namespace
