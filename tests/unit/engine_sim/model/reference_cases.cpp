// SPDX-License-Identifier: Apache-2.0
#include "reference_cases.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace ehm::engine_sim::reference {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Lines before the header begin with #.
std::vector<Case> read_cases(const std::string& file, double lowest_power_code) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line.starts_with('#')) {
  }
  const std::vector<std::string> names = split(line);
  std::vector<Case> cases;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    if (cells.size() != names.size()) throw std::runtime_error(file + ": a row is not as long as the header: " + line);
    Case c;
    for (std::size_t i = 0; i < names.size(); ++i) c[names[i]] = std::stod(cells[i]);
    if (c["conv"] == 1.0 && c["PC"] >= lowest_power_code) cases.push_back(c);
  }
  if (cases.empty()) throw std::runtime_error(file + ": no case");
  return cases;
}

}  // namespace

std::string path(const std::string& file) {
  return std::string(EHM_REFERENCE_DIR) + "/" + file;
}

bool available() {
  return std::filesystem::exists(path("jt9d_npss_cases.csv"));
}

std::string fixture(const std::string& file) {
  return std::string(EHM_SOURCE_DIR) + "/tests/unit/engine_sim/fixtures/" + file;
}

std::vector<Case> npss_cases(double lowest_power_code) {
  return read_cases(path("jt9d_npss_cases.csv"), lowest_power_code);
}

std::vector<Case> npss_points(double lowest_power_code) {
  return read_cases(fixture("npss_points.csv"), lowest_power_code);
}

}  // namespace ehm::engine_sim::reference
