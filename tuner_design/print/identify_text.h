// SPDX-License-Identifier: Apache-2.0
#pragma once
// Identified noise for people and as JSON with the same numbers: channel units, beside what the model counts with.

#include <cstdint>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>

#include "tuner_design/identify/identify_noise.h"

namespace ehm::tuner_design {

/// Which files, which engine.
struct IdentifySource {
  std::string recording, model;
  std::int64_t engine_id = 0;
  Eigen::Index not_accepted = 0;
  std::string out;  ///< the model that was written; empty: none
};

void print_identified(const IdentifiedNoise& noise, const IdentifySource& source, std::ostream& out);

/// Keys: recording, model, engine_id, samples, sensors, states, walk, walks, walks_differ, condition, remarks, fit.
nlohmann::ordered_json identified_as_json(const IdentifiedNoise& noise, const IdentifySource& source);

}  // namespace ehm::tuner_design
