// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/recording/part_files.h"

#include <gmock/gmock.h>

#include "tests/temporary_folder.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using testing::ElementsAre;

TEST(PartFiles, NamesCountUp) {
  EXPECT_EQ(part_name("dir/flight.h5", 1), "dir/flight.h5");
  EXPECT_EQ(part_name("dir/flight.h5", 2), "dir/flight.0002.h5");
  EXPECT_EQ(part_name("flight", 12345), "flight.12345");
  EXPECT_EQ(following_part("dir/flight.h5"), "dir/flight.0002.h5");
  EXPECT_EQ(following_part("flight.0009.h5"), "flight.0010.h5");
  EXPECT_EQ(following_part("flight.9999.h5"), "flight.10000.h5");
  EXPECT_EQ(following_part("run.17.h5"), "run.17.0002.h5");  // a name of the user's, not a part
}

TEST(PartFiles, OnlyOwnPartsAreFound) {
  const test::TemporaryFolder folder;
  for (const char* name :
       {"a.h5", "a.0002.h5", "a.0010.h5", "a.0003.txt", "a.x003.h5", "b.0002.h5", "a.0001.h5", "a.02.h5"})
    folder.file(name, "");
  const std::string file = folder.path("a.h5");
  EXPECT_THAT(existing_parts(file), ElementsAre(1, 2, 10));
  EXPECT_EQ(next_part(file), 11);
  EXPECT_EQ(next_part(folder.path("new.h5")), 1);
  EXPECT_EQ(next_part(folder.path("no/folder.h5")), 1);
}

}  // namespace
