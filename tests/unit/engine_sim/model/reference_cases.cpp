// SPDX-License-Identifier: Apache-2.0
#include "reference_cases.h"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace ehm::engine_sim::reference {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

std::string path(const std::string& file) {
  return std::string(EHM_REFERENCE_DIR) + "/" + file;
}

bool available() {
  return std::filesystem::exists(path("jt9d_npss_cases.csv"));
}

std::vector<Case> npss_cases(double lowest_power_code) {
  std::ifstream in(path("jt9d_npss_cases.csv"));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line);
  std::vector<Case> cases;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    Case c;
    for (std::size_t i = 0; i < names.size(); ++i) c[names[i]] = std::stod(cells.at(i));
    if (c["conv"] == 1.0 && c["PC"] >= lowest_power_code) cases.push_back(c);
  }
  return cases;
}

}  // namespace ehm::engine_sim::reference
