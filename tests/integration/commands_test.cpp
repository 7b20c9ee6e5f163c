// SPDX-License-Identifier: Apache-2.0
// The offline commands of engine_sim as real processes: files, pipes, exit codes, signals.

#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/integration/pair/process.h"
#include "tests/temporary_folder.h"

namespace {

using namespace ehm::test;
using std::chrono::seconds;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* header = "altitude_m,mach,delta_isa_k,t40_k\n";

class CommandsTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path(name); }
  std::string file(const std::string& name, const std::string& text) const { return folder_.file(name, text); }
  std::string content(const std::string& name) const { return folder_.content(name); }
  TemporaryFolder folder_;
};

TEST_F(CommandsTest, DeckFromFileToFileAndThroughPipes) {
  const std::string cases = file("cases.csv", std::string(header) + "0,0,15,1500\n10668,0.8,0,1300\n");
  Process deck({EHM_ENGINE_SIM, "deck", "--cases", cases, "--out", path("deck.csv"), "--threads", "2"});
  EXPECT_EQ(deck.wait(seconds(20)), 0) << deck.log();
  EXPECT_EQ(deck.log(), "");
  EXPECT_THAT(content("deck.csv"), StartsWith("altitude_m,mach,delta_isa_k,t40_k,converged,w_2_kg_s,"));
  EXPECT_THAT(content("deck.csv"), HasSubstr("\n10668,0.8,0,1300,1,"));

  Process piped({"/bin/sh", "-c",
                 std::string("'") + EHM_ENGINE_SIM + "' deck --cases - --out - < '" + cases + "' | cat > '" +
                     path("piped.csv") + "'"});
  EXPECT_EQ(piped.wait(seconds(20)), 0) << piped.log();
  EXPECT_EQ(content("piped.csv"), content("deck.csv"));
}

TEST_F(CommandsTest, DeckRefusesABadFileAndWritesNothing) {
  const std::string cases = file("cases.csv", std::string(header) + "0,0,15,1500\n10668,2,0,1300\n");
  Process deck({EHM_ENGINE_SIM, "deck", "--cases", cases, "--out", path("deck.csv")});
  EXPECT_EQ(deck.wait(seconds(20)), 2);
  EXPECT_EQ(deck.log(), "engine_sim deck: " + cases + ":3: 'mach' is '2', allowed is a number from 0 to 0.95\n");
  EXPECT_FALSE(std::filesystem::exists(path("deck.csv")));
}

TEST_F(CommandsTest, AStoppedDeckLeavesTheOldFileAndNothingElse) {
  std::string text = header;
  for (int i = 0; i < 300'000; ++i) text += "0,0,15," + std::to_string(1300 + i % 200) + "\n";
  const std::string cases = file("cases.csv", text), old = file("deck.csv", "old\n");
  Process deck({EHM_ENGINE_SIM, "deck", "--cases", cases, "--out", old, "--threads", "1"});
  // its temporary file shows that it is at work
  const auto files = [&] {
    const std::filesystem::directory_iterator folder(folder_.path());
    return std::distance(begin(folder), end(folder));
  };
  while (files() < 3 && deck.running()) {
  }
  deck.signal(SIGTERM);
  EXPECT_EQ(deck.wait(seconds(20)), 1);
  EXPECT_THAT(deck.log(), HasSubstr("stopped by a signal"));
  EXPECT_EQ(content("deck.csv"), "old\n");
  EXPECT_EQ(files(), 2);
}

TEST_F(CommandsTest, AnUnknownCommandIsNamed) {
  Process wrong({EHM_ENGINE_SIM, "mpas"});
  EXPECT_EQ(wrong.wait(seconds(20)), 2);
  EXPECT_EQ(wrong.log(),
            "engine_sim: unknown command 'mpas'; did you mean maps? Allowed are deck, engine, maps, or the service's "
            "options. See engine_sim --help\n");
}

}  // namespace
