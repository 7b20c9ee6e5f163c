// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine of a recording, or of a CSV file by a column map, in a model's channels and units. Sensors and actuators
// are found by their names, in any order; others are passed over. Samples that the monitor did not accept (malformed,
// duplicate, overtaken, foreign) are left out; up to three in a row that were lost become samples without values. Two
// samples follow each other if their sequence numbers do; in a CSV
// file, whose rows are numbered as they stand, also if the time between them is at most 1.5 sample times, unless its
// clock is coarse (column_map.h).

#include <cstdint>
#include <optional>
#include <string>

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/identify/recorded_samples.h"

namespace ehm::tuner_design {

struct RecordedEngine {
  RecordedSamples samples;
  std::int64_t engine_id = 0;
  Eigen::Index not_accepted = 0;
};

/// `column_map`: empty for a recording. `engine_id`: not needed where there is one engine only.
/// @throws files::FileError if the file is no recording, the map has a defect, the file lacks a channel of the model or
///         has it in a unit that does not convert, has no samples of the engine, or another sample time than the model.
RecordedEngine read_recorded_engine(const std::string& file, const std::string& column_map,
                                    std::optional<std::int64_t> engine_id, const linear_model::LinearModel& model);

}  // namespace ehm::tuner_design
