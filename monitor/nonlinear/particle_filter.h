// SPDX-License-Identifier: Apache-2.0
#pragma once
// The bootstrap particle filter, N particles of n states with weights w:
//
//   foresee   Y_i = g(X_i);  y^ = sum w_i Y_i
//   update    ln w_i += ln N(nu - (Y_i - y^); 0, R) over the fused sensors; x = sum w_i X_i, P of the cloud;
//             then, where N_eff = 1/sum w_i^2 < 2 N/3, systematic resampling
//   advance   X_i = f(X_i) + w,  w ~ N(0, Q)
//
// Few particles in many states hold only where Q keeps the cloud wide against the likelihood; where P is far above what
// N particles can fill, it degenerates, and its P then says too little. Weights in logarithms. Particles lie together
// by state (N x n), so that what is summed over them runs through memory.
// Source: Gordon, Salmond & Smith 1993; [L] equations 8 to 12. Errors: nonlinear_filter.h. Real-time safe: yes, after
// construction. The same seed and calls give the same bits.

#include <cstdint>
#include <vector>

#include "monitor/nonlinear/nonlinear_filter.h"
#include "monitor/nonlinear/particle_cloud.h"

namespace ehm::nonlinear {

struct ParticleOptions {
  Eigen::Index particles = 50;
  std::uint64_t seed = 1;
};

class ParticleFilter final : public NonlinearFilter {
 public:
  ParticleFilter(FilterNoise noise, ParticleOptions options);

  [[nodiscard]] std::unique_ptr<NonlinearFilter> clone() const override;
  void start(const OrderVector& x, const OrderMatrix& covariance) noexcept override;
  void open(const OrderVector& variance) noexcept override { cloud_.scatter(variance); }
  bool foresee(StateSpace& model, const SensorVector& sigma) noexcept override;
  bool update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept override;
  bool advance(StateSpace& model) noexcept override;

 private:
  FilterNoise noise_;
  ParticleOptions options_;
  ParticleCloud cloud_;
  Eigen::Array<bool, Eigen::Dynamic, 1> answered_;  ///< which particles' models did
  Eigen::MatrixXd readings_;                        ///< N x m
  SensorVector sigma_;
  Response response_;
};

}  // namespace ehm::nonlinear
