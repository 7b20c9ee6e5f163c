// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/temporary_folder.h"

namespace ehm::files {
namespace {

/// The number of a process that is no more.
pid_t ended_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

TEST(AtomicFile, RemovesWhatAKilledProcessLeftOfTheSameTargetOnly) {
  const test::TemporaryFolder folder;
  const std::string dead = std::to_string(ended_process());
  const std::string left = folder.file("engine_1.json.tmp" + dead, "half");
  const std::string others = folder.file("engine_2.json.tmp" + dead, "half");
  const std::string alive = folder.file("engine_1.json.tmp" + std::to_string(getppid()), "half");
  const std::string no_number = folder.file("engine_1.json.tmp12x", "a user's");
  write_file_atomically(folder.path("engine_1.json"), "whole");
  EXPECT_EQ(folder.content("engine_1.json"), "whole");
  EXPECT_FALSE(std::filesystem::exists(left));
  EXPECT_TRUE(std::filesystem::exists(others));
  EXPECT_TRUE(std::filesystem::exists(alive));
  EXPECT_TRUE(std::filesystem::exists(no_number));
  write_file_atomically(folder.path("engine_2.json"), "whole");
  EXPECT_FALSE(std::filesystem::exists(others));
}

}  // namespace
}  // namespace ehm::files
