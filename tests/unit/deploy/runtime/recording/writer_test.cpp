// SPDX-License-Identifier: Apache-2.0
// What is written is read back to the bit.

#include "deploy/runtime/recording/writer.h"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/recording/file_reader.h"
#include "deploy/runtime/recording/part_files.h"
#include "deploy/runtime/recording/recording_rows.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/recording/example_rows.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using test::example_info;
using test::example_row;

class WriterTest : public testing::Test {
 protected:
  static std::vector<Row> read_all(const std::string& path) {
    RecordingRows rows(path);
    std::vector<Row> all;
    for (Row row; rows.next(row);) all.push_back(row);
    return all;
  }
  test::TemporaryFolder folder_;
};

TEST_F(WriterTest, EveryColumnComesBack) {
  const std::string path = folder_.path("a.h5");
  {
    Writer writer(path, example_info());
    EXPECT_EQ(writer.design_index("abc"), 0);
    EXPECT_EQ(writer.design_index("def"), 1);
    EXPECT_EQ(writer.design_index("abc"), 0);
    for (std::int64_t k = 0; k < 2500; ++k) writer.append(example_row(k), k % 2);
    writer.commit(false);
    EXPECT_EQ(writer.rows(), 2500u / Writer::chunk_rows * Writer::chunk_rows);  // whole chunks only
  }
  RecordingRows rows(path);
  EXPECT_EQ(rows.info().channels, example_info().channels);
  EXPECT_EQ(rows.info().recording_id, 1234567890123456789);
  EXPECT_EQ(rows.info().sample_time_s, 0.015);
  std::int64_t k = 0;
  for (Row row; rows.next(row); ++k) {
    const Row expected = example_row(k);
    ASSERT_EQ(row.a.sequence, k);
    ASSERT_EQ(rows.design_hash(row), k % 2 ? "def" : "abc");
    for (std::size_t i = 0; i < 4; ++i) ASSERT_EQ(row.w[i], expected.w[i]);
    for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(row.x_s[i], expected.x_s[i]);
    for (std::size_t i = 0; i < 2; ++i) ASSERT_EQ(row.innovation[i], expected.innovation[i]);
    ASSERT_EQ(row.x_v[0], expected.x_v[0]);
    ASSERT_EQ(row.x_v_sigma[0], expected.x_v_sigma[0]);
    ASSERT_EQ(row.x_v_sigma_filter[0], expected.x_v_sigma_filter[0]);
    for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(row.t[i], expected.t[i]);
    for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(row.t_sigma[i], expected.t_sigma[i]);
    for (std::size_t i = 0; i < 3; ++i) ASSERT_EQ(row.t_sigma_filter[i], expected.t_sigma_filter[i]);
    ASSERT_TRUE(std::isnan(row.t[3]));  // not recorded: the engine has three
  }
  EXPECT_EQ(k, 2500);
}

TEST_F(WriterTest, BitsOfOddValuesSurvive) {
  const std::string path = folder_.path("a.h5");
  const std::vector<std::uint64_t> odd{0x8000000000000000, 0x7ff0000000000000, 0xfff8000000000001, 0x7ff4000000000abc,
                                       1};
  {
    Writer writer(path, example_info());
    for (const auto bits : odd) {
      Row row = example_row(0);
      row.x_s[0] = std::bit_cast<double>(bits);
      row.a.sequence = static_cast<std::int64_t>(0xffffffffffffffff);
      row.a.source_time_ns = std::numeric_limits<std::int64_t>::min();
      writer.append(row, 0);
    }
  }
  const auto rows = read_all(path);
  ASSERT_EQ(rows.size(), odd.size());
  for (std::size_t i = 0; i < odd.size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(rows[i].x_s[0]), odd[i]);
    EXPECT_EQ(static_cast<std::uint64_t>(rows[i].a.sequence), 0xffffffffffffffff);
    EXPECT_EQ(rows[i].a.source_time_ns, std::numeric_limits<std::int64_t>::min());
  }
}

TEST_F(WriterTest, NeverOverwrites) {
  const std::string path = folder_.file("a.h5", "mine");
  EXPECT_THROW(Writer(path, example_info()), files::FileError);
  EXPECT_EQ(folder_.content("a.h5"), "mine");
  EXPECT_THROW(Writer(folder_.path("no/such/folder.h5"), example_info()), files::FileError);
}

TEST_F(WriterTest, TheEstimatorsComeBackAndAFileWithoutThemStatesNone) {
  FileInfo info = example_info();
  { const Writer writer(folder_.path("old.h5"), info); }
  info.published = "time_varying";
  info.shadows = "tuner,gauss_markov";
  { const Writer writer(folder_.path("new.h5"), info); }
  EXPECT_EQ(FileReader(folder_.path("old.h5")).info().published, "");
  EXPECT_EQ(FileReader(folder_.path("new.h5")).info().published, "time_varying");
  EXPECT_EQ(FileReader(folder_.path("new.h5")).info().shadows, "tuner,gauss_markov");
  // longer than the names of channels: offline compares only with the same list, so none of it may be cut
  info.shadows =
      "gauss_markov,time_varying,onboard,map,wls,rls,ekf,iekf,clipped_ekf,ukf,particle,ekpf,cekpf,constrained";
  { const Writer writer(folder_.path("many.h5"), info); }
  EXPECT_EQ(FileReader(folder_.path("many.h5")).info().shadows, info.shadows);
}

TEST_F(WriterTest, AnEngineWithoutAuxiliaryOutputsCanBeRecorded) {
  FileInfo info = example_info();
  info.channels.auxiliary.clear();
  const std::string path = folder_.path("a.h5");
  { Writer(path, info).append(example_row(3), 0); }
  const auto rows = read_all(path);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].t[2], example_row(3).t[2]);
  EXPECT_TRUE(std::isnan(rows[0].x_v[0]));
}

TEST_F(WriterTest, TheRowsOfAllPartsFollowEachOther) {
  const std::string path = folder_.path("a.h5");
  const auto write_part = [&](std::int64_t number, std::int64_t recording, std::int64_t part, std::int64_t first) {
    FileInfo info = example_info();
    info.recording_id = recording;
    info.part = part;
    Writer writer(part_name(path, number), info);
    for (std::int64_t k = first; k < first + 100; ++k) writer.append(example_row(k), 0);
  };
  write_part(1, 5, 1, 0);
  write_part(2, 5, 2, 100);
  write_part(3, 6, 1, 900);  // another recording that went on with the numbers
  write_part(4, 6, 2, 1000);
  const auto first = read_all(path), second = read_all(part_name(path, 3));
  ASSERT_EQ(first.size(), 200u);
  EXPECT_EQ(first.back().a.sequence, 199);
  ASSERT_EQ(second.size(), 200u);
  EXPECT_EQ(second.front().a.sequence, 900);
  EXPECT_EQ(second.back().a.sequence, 1099);
}

}  // namespace
