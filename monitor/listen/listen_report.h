// SPDX-License-Identifier: Apache-2.0
#pragma once
// What --listen found, as text for people and as JSON.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "monitor/listen/wiring_check.h"

namespace ehm::monitor {

/// One source of one engine.
struct SourceFindings {
  SourceRecord record;
  const design::Design* design = nullptr;  ///< null: no design serves this engine
  WiringReport wiring;
};

using SourceKey = std::pair<std::uint32_t, std::uint32_t>;  ///< engine_id, source_id

struct ListenReport {
  double seconds = 0.0;
  std::map<SourceKey, SourceFindings> sources;
  std::vector<Finding> findings;  ///< of the wiring as a whole
  bool good() const;
};

std::string report_text(const ListenReport& report);
std::string report_json(const ListenReport& report);

}  // namespace ehm::monitor
