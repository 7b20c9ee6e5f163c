// SPDX-License-Identifier: Apache-2.0
// A folder of CSV files from somebody else: refused with a FileError, or a sound model. The input is the files one
// after the other, each begun by a line "=NAME"; the folder is in memory.

#include <unistd.h>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "deploy/runtime/files/file_error.h"
#include "tests/fuzz/require.h"
#include "tuner_design/import/import_model.h"

namespace {

/// A folder of this process, emptied before each input.
const std::filesystem::path& folder() {
  static const std::filesystem::path path = "/dev/shm/ehm-fuzz-" + std::to_string(getpid());
  return path;
}

void write_files(const std::string& text) {
  static const std::set<std::string> allowed{
      "A", "B", "L", "C", "D", "M", "F", "G", "N", "Q", "R", "linearisation_error", "channels", "settings"};
  std::filesystem::remove_all(folder());
  std::filesystem::create_directory(folder());
  std::istringstream lines(text);
  std::ofstream file;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() != '=') {
      file << line << '\n';
      continue;
    }
    file.close();
    if (allowed.count(line.substr(1))) file.open(folder() / (line.substr(1) + ".csv"));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace ehm;
  write_files({reinterpret_cast<const char*>(data), size});
  try {
    const auto imported = tuner_design::import_model(folder(), {});
    EHM_REQUIRE(imported.model.A.allFinite() && imported.model.M.allFinite());
    EHM_REQUIRE((imported.model.sensor_noise_sigma.array() > 0.0).all());
  } catch (const files::FileError& e) {
    EHM_REQUIRE(e.what()[0] != '\0');
  }
  std::filesystem::remove_all(folder());
  return 0;
}
