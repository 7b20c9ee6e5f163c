// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is a source wired as the monitor needs it? Order and time of its samples, its channels against the design: counts,
// validity, stuck, noise, plausibility against the trim; where a value is not plausible, whether it would be as another
// channel (swapped) or in another unit. What a finding says can be acted on.

#include <string>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/listen/source_record.h"

namespace ehm::monitor {

struct Finding {
  bool error = true;  ///< otherwise a warning: the monitor would estimate, with restrictions
  std::string text;
};

/// One sensor as the report shows it.
struct SensorView {
  double expected = 0.0, spread = 0.0;  ///< expectation.h
  double deviation = 0.0;               ///< (mean - expected) / spread
};

struct WiringReport {
  std::vector<SensorView> sensors;  ///< empty where the counts do not fit the design
  std::vector<Finding> findings;
  bool has_error() const;
};

/// `description`: what the source says of itself on EngineDescription; null where it says nothing.
WiringReport check_wiring(const SourceRecord& source, const design::Design& design, const CycleOptions& options,
                          const EngineDescription* description);

}  // namespace ehm::monitor
