// SPDX-License-Identifier: Apache-2.0
#pragma once
// Linear model file, JSON, schema "ehm-linear-model/1", also for users' own engines:
//   name, time "continuous"|"discrete", sample_time_s; states, controls, health, sensors, auxiliary: arrays of
//   {name, unit, trim} plus `sigma` for health and `noise_sigma` for sensors (trim of health may be left out: 0);
//   process_noise n x n, per sample; A B L C D M F G N as nested arrays (F G N empty or absent without auxiliary
//   outputs, B D G without controls). Optional: operating_point {altitude_m, mach, delta_isa_k}, engine_type,
//   engine_hash, linearisation_error (m+r) x (m+r).
// Unknown keys are errors. Units and shapes: engine_sim/linear_model/linear_model.h.

#include <string>

#include "engine_sim/linear_model/capacity.h"
#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

inline constexpr const char* model_schema = "ehm-linear-model/1";

/// `sensor_capacity`: a list of candidate sensors may be longer than what a design holds.
/// @throws FileError (one message: file, key, value, allowed, what to do) for every defect of the file or of the model.
LinearModel read_model(const std::string& path, int sensor_capacity = max_sensors);

/// Writes atomically (temporary file, rename).
/// @throws FileError if the file cannot be written or the model has a defect.
void write_model(const LinearModel& model, const std::string& path);

}  // namespace ehm::linear_model
