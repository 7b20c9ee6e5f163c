// SPDX-License-Identifier: Apache-2.0
// A recording is readable up to its last commit, whenever its writer dies: a child process writes and is killed.

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <optional>
#include <random>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/recording/file_reader.h"
#include "tests/temporary_folder.h"
#include "tests/unit/deploy/runtime/recording/example_rows.h"

namespace {

using namespace ehm;
using namespace ehm::recording;
using test::example_row;

/// Writes without end, and tells through the pipe how many rows are committed.
[[noreturn]] void write_until_killed(const std::string& path, int pipe) {
  Writer writer(path, test::example_info());
  for (std::int64_t k = 0;; ++k) {
    writer.append(example_row(k), 0);
    if (k % 100 != 99) continue;
    writer.commit(k % 1000 == 999);
    const std::uint64_t rows = writer.rows();
    if (write(pipe, &rows, sizeof rows) != sizeof rows) _exit(1);
  }
}

class ChildWriter {
 public:
  explicit ChildWriter(const std::string& path) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    child_ = fork();
    if (child_ == 0) write_until_killed(path, ends[1]);
    close(ends[1]);
    reading_end_ = ends[0];
  }
  ~ChildWriter() {
    kill_it();
    close(reading_end_);
  }
  ChildWriter(const ChildWriter&) = delete;
  ChildWriter& operator=(const ChildWriter&) = delete;

  /// Rows that are committed after so many more commits.
  std::uint64_t await_commits(int commits) {
    for (int i = 0; i < commits; ++i)
      if (read(reading_end_, &rows_, sizeof rows_) != sizeof rows_) throw std::runtime_error("the writer has died");
    return rows_;
  }
  /// Rows that were committed before it died.
  std::uint64_t kill_it() {
    if (child_ < 0) return rows_;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = -1;
    for (std::uint64_t more = 0; read(reading_end_, &more, sizeof more) == sizeof more;) rows_ = more;
    return rows_;
  }

 private:
  pid_t child_ = -1;
  int reading_end_ = -1;
  std::uint64_t rows_ = 0;
};

/// Rows of an unfinished file, each checked; nothing if the kill has left half a change of HDF5's metadata.
std::optional<std::uint64_t> readable_rows(const std::string& path) {
  std::uint64_t rows = 0;
  try {
    FileReader reader(path);
    EXPECT_TRUE(reader.unfinished());
    for (Row row; !testing::Test::HasFailure() && reader.next(row); ++rows) {
      const Row expected = example_row(row.a.sequence);
      EXPECT_EQ(row.a.sequence, static_cast<std::int64_t>(rows));
      EXPECT_EQ(row.t_sigma_filter[2], expected.t_sigma_filter[2]);
      EXPECT_EQ(row.w[0], expected.w[0]);
    }
  } catch (const files::FileError& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with(path)) << e.what();
    return std::nullopt;
  }
  return rows;
}

TEST(CutOff, EveryCommittedRowIsReadableWheneverTheWriterDies) {
  const test::TemporaryFolder folder;
  std::mt19937 random(1);
  int refused = 0;
  for (int kills = 0; kills < 40; ++kills) {
    const std::string path = folder.path("cut" + std::to_string(kills) + ".h5");
    ChildWriter writer(path);
    writer.await_commits(1 + static_cast<int>(random() % 20));
    usleep(static_cast<useconds_t>(random() % 3000));  // any moment within the next commits will do
    const std::uint64_t committed = writer.kill_it();
    const auto rows = readable_rows(path);
    refused += rows ? 0 : 1;
    EXPECT_GE(rows.value_or(committed), committed) << kills;
  }
  // This writer does nothing but commit, a recorder does so one part in a hundred of its time: one of a hundred such
  // kills was refused, so three of forty are less likely than 1 in 100.
  EXPECT_LE(refused, 2);
  std::printf("%d of 40 killed writers left a file that is refused\n", refused);
}

TEST(CutOff, AGrowingRecordingIsReadableWhileItIsWritten) {
  const test::TemporaryFolder folder;
  ChildWriter writer(folder.path("a.h5"));
  const std::uint64_t committed = writer.await_commits(3);
  const auto rows = readable_rows(folder.path("a.h5"));
  ASSERT_TRUE(rows.has_value());
  EXPECT_GE(*rows, committed);
}

}  // namespace
