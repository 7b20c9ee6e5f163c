// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear engine whose noise is known, as a recording: x[k+1] = A x + L h + w, h[k+1] = h + g, y = C x + M h + v.

#include <cmath>

#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "tests/unit/tuner_design/test_models.h"
#include "tuner_design/identify/recorded_samples.h"

namespace ehm::test {

struct KnownNoise {
  Eigen::VectorXd sensors, motion, walk;  ///< standard deviations of v, w, g; percent
};

/// That of the model, and the same walk for all health parameters.
inline KnownNoise noise_of(const linear_model::LinearModel& model, double walk_percent2) {
  const linear_model::LinearModel scaled = linear_model::scaled(model, linear_model::scaling_of(model));
  return {scaled.sensor_noise_sigma, scaled.process_noise.diagonal().cwiseSqrt(),
          Eigen::VectorXd::Constant(scaled.L.cols(), std::sqrt(walk_percent2))};
}

/// `model` discrete; controls at their trims. The motion is stationary from the first sample on, the walk begins at 0.
inline tuner_design::RecordedSamples walking_engine(const linear_model::LinearModel& model, const KnownNoise& noise,
                                                    Eigen::Index samples, std::uint64_t seed) {
  const linear_model::Scaling scaling = linear_model::scaling_of(model);
  const linear_model::LinearModel scaled = linear_model::scaled(model, scaling);
  Random random(seed);
  const Eigen::MatrixXd Q = noise.motion.cwiseAbs2().asDiagonal();
  Eigen::VectorXd x = linear_model::covariance_root(linear_model::stationary_covariance(scaled.A, Q)) *
                      random.normal_vector(scaled.A.rows());
  Eigen::VectorXd h = Eigen::VectorXd::Zero(scaled.L.cols());
  tuner_design::RecordedSamples record;
  record.flight = Eigen::MatrixXd::Zero(3, samples);
  if (const auto& point = model.operating_point)
    record.flight.colwise() = Eigen::Vector3d(point->altitude_m, point->mach, point->delta_isa_k);
  record.controls = linear_model::trims(model.controls).replicate(1, samples);
  record.sensors.resize(scaled.C.rows(), samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const Eigen::VectorXd v = noise.sensors.cwiseProduct(random.normal_vector(scaled.C.rows()));
    record.sensors.col(k) =
        linear_model::trims(model.sensors) + scaling.sensor.cwiseProduct(scaled.C * x + scaled.M * h + v);
    x = scaled.A * x + scaled.L * h + noise.motion.cwiseProduct(random.normal_vector(scaled.A.rows()));
    h += noise.walk.cwiseProduct(random.normal_vector(scaled.L.cols()));
  }
  return record;
}

}  // namespace ehm::test
