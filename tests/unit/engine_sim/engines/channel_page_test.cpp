// SPDX-License-Identifier: Apache-2.0
// The tables of deploy/docs/engine_files.md against the code that they describe.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/table_text.h"
#include "engine_sim/engines/channel_table.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;

/// Rows of the page that begin with a name in code marks and have four cells.
std::vector<std::string> rows() {
  std::istringstream page(files::read_text(std::string(EHM_SOURCE_DIR) + "/deploy/docs/engine_files.md"));
  std::vector<std::string> rows;
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `") && std::count(line.begin(), line.end(), '|') == 5) rows.push_back(line);
  return rows;
}

std::string code(std::string_view text) {
  return text.empty() ? "" : "`" + std::string(text) + "`";
}

template <class Channel>
std::string row(const Channel& channel, const std::string& third) {
  return "| `" + std::string(channel.name) + "` | " + std::string(channel.unit) + " | " + third + " | " +
         std::string(channel.description) + " |";
}

TEST(EnginePage, HasOneLineAChannelAsInTheCode) {
  std::vector<std::string> expected;
  for (const OutputChannel& channel : output_channels()) expected.push_back(row(channel, code(channel.column)));
  for (const ControlChannel& channel : control_channels())
    expected.push_back(row(channel, files::shortest(channel.lowest) + " to " + files::shortest(channel.highest)));
  EXPECT_EQ(rows(), expected);
}

TEST(EnginePage, NamesTheHealthParameters) {
  const std::string page = files::read_text(std::string(EHM_SOURCE_DIR) + "/deploy/docs/engine_files.md");
  for (const auto& name : health_names) EXPECT_NE(page.find(code(name)), std::string::npos) << name;
}

}  // namespace
