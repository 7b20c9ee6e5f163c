// SPDX-License-Identifier: Apache-2.0
#pragma once
// Every estimate beside its truth as CSV, for plots: time_s, then <name>_truth, <name>_estimate, <name>_sigma by
// channel; the truth is empty where there is none.

#include <fstream>
#include <string>

#include "deploy/demo/watch_data.h"

namespace ehm::demo {

class WatchCsv {
 public:
  /// @throws std::runtime_error if the file cannot be created.
  explicit WatchCsv(const std::string& path);
  /// Appends the latest estimate; nothing until its description is known.
  void write(const WatchData& data);

 private:
  std::ofstream file_;
  bool has_header_ = false;
};

}  // namespace ehm::demo
