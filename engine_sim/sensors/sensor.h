// SPDX-License-Identifier: Apache-2.0
#pragma once
// One sensor: lag -> fault -> noise -> quantisation -> holding, in the order in which a real channel does it.
//
//   lag           s[k] = s[k-1] + (1 - exp(-dt/tau)) (truth[k] - s[k-1]),  tau = 0: none
//   bias          + magnitude                       unit
//   drift         + magnitude * time since start    unit per second
//   noise         (sigma + fraction |s|) * n * (fault factor): absolute, or of the present reading
//   stuck         repeats the last delivered value
//   dropout       NaN, not valid
//   quantisation  round to the next multiple of step, 0: none
//   holding       a new value every held_samples samples, which stands until the next

#include <cstdint>
#include <optional>

#include "deploy/runtime/numbers/noise_source.h"

namespace ehm::engine_sim {

enum class FaultKind { none, bias, drift, stuck, dropout, noise };

struct SensorFault {
  FaultKind kind = FaultKind::none;
  double magnitude = 0.0;
  double start_s = 0.0;
  double duration_s = 0.0;  ///< 0: until cleared
  bool active(double time_s) const {
    return kind != FaultKind::none && time_s >= start_s && (duration_s <= 0.0 || time_s < start_s + duration_s);
  }
};

struct SensorOptions {
  double noise_sigma = 0.0;  ///< the sensor's unit
  double lag_s = 0.0;
  double step = 0.0;
  std::uint64_t held_samples = 1;
  double noise_fraction = 0.0;  ///< of the present reading, besides
};

struct Reading {
  double value = 0.0;
  bool valid = true;
};

class Sensor {
 public:
  explicit Sensor(const SensorOptions& options) : options_(options) {}

  Reading read(double truth, double time_s, double dt_s, NoiseSource& noise);
  void inject(const SensorFault& fault) { fault_ = fault; }

 private:
  SensorOptions options_;
  SensorFault fault_;
  std::optional<double> lagged_;
  std::optional<double> delivered_;
  std::uint64_t samples_ = 0;
};

}  // namespace ehm::engine_sim
