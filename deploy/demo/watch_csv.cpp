// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/watch_csv.h"

#include <spdlog/fmt/fmt.h>

#include <stdexcept>

namespace ehm::demo {

WatchCsv::WatchCsv(const std::string& path) : file_(path) {
  if (!file_) throw std::runtime_error(path + ": cannot be created; name a file in a folder that exists");
}

void WatchCsv::write(const WatchData& data) {
  auto rows = data.health();
  const auto auxiliary = data.auxiliary();
  if (rows.empty() || auxiliary.empty()) return;
  rows.insert(rows.end(), auxiliary.begin(), auxiliary.end());
  if (!has_header_) {
    file_ << "time_s";
    for (const auto& row : rows) file_ << fmt::format(",{0}_truth,{0}_estimate,{0}_sigma", row.name);
    file_ << '\n';
    has_header_ = true;
  }
  file_ << fmt::format("{:.3f}", data.flight_time_s());
  for (const auto& row : rows)
    file_ << fmt::format(",{},{},{}", row.truth ? fmt::format("{}", *row.truth) : "", row.estimate, row.sigma);
  file_ << '\n';
}

}  // namespace ehm::demo
