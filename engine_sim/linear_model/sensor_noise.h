// SPDX-License-Identifier: Apache-2.0
#pragma once
// The noise that the filter counts with for a sensor that is rounded and that speaks more slowly than samples come:
//
//   R = n (s^2 + q^2 / 12),     n = update period / sample time, rounded, at least 1
//
// s standard deviation of the noise before rounding, q resolution (the step of the sensor's values), both in channel
// units. q^2 / 12 is the variance of a uniform rounding error (Widrow & Kollar, Quantization Noise, 2008, ch. 1); it is
// white where s is about q / 2 or more, and a constant offset where the noise is less: its average then does not
// shrink with time. A value that is held for n samples is one measurement, not n: its noise has n times the power at
// the low frequencies that the filter passes, as white noise of n times the variance has.

#include <algorithm>
#include <cmath>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::linear_model {

/// Samples for which a sensor holds each value; 1 where nothing is stated.
inline int held_samples(const LinearModel& model, Eigen::Index sensor) {
  if (model.sensor_update_period_s.size() == 0) return 1;
  return std::max(1, static_cast<int>(std::lround(model.sensor_update_period_s(sensor) / model.sample_time_s)));
}

/// q; 0 where it is not stated.
inline double resolution(const LinearModel& model, Eigen::Index sensor) {
  return model.sensor_resolution.size() == 0 ? 0.0 : model.sensor_resolution(sensor);
}

/// sqrt(R) from s.
inline double counted_sigma(const LinearModel& model, Eigen::Index sensor, double own_sigma) {
  const double q = resolution(model, sensor);
  const int n = held_samples(model, sensor);
  return q == 0.0 && n == 1 ? own_sigma : std::sqrt(n * (own_sigma * own_sigma + q * q / 12.0));
}

/// s from sqrt(R). A noise below a millionth of the resolution is told as that millionth: it does not count beside it.
inline double own_sigma(const LinearModel& model, Eigen::Index sensor) {
  const double q = resolution(model, sensor), sigma = model.sensor_noise_sigma(sensor);
  const int n = held_samples(model, sensor);
  if (q == 0.0 && n == 1) return sigma;
  return std::max(1e-6 * q, std::sqrt(std::max(0.0, sigma * sigma / n - q * q / 12.0)));
}

}  // namespace ehm::linear_model
