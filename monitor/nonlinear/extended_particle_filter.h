// SPDX-License-Identifier: Apache-2.0
#pragma once
// The extended Kalman particle filter (EKPF), N particles of n states, each drawn from the posterior that an extended
// Kalman filter of its own proposes, so that few of them are wasted:
//
//   foresee   Y_i = g(X_i-),  y^ = sum w_i Y_i
//   update    M_i = X_i- + K_i (nu - (Y_i - y^)),  P_i = (I - K_i H_i) P_i-;   X_i ~ N(M_i, P_i)
//             ln w_i += ln p(nu | g(X_i)) + ln N(X_i; X_i-, Q) - ln N(X_i; M_i, P_i);  at the start P for Q
//             x = sum w_i X_i;  then, where N_eff < 2 N/3, systematic resampling
//   advance   X_i- = f(X_i),  P_i- = F_i P_i F_i' + Q
//
// shared: one Jacobian at the mean for all particles, as the cost figures of [L] show, and then one K and one P; own:
// each particle has its own. With a box (cEKPF) a drawn particle outside it is pulled half-way to where it was, X_i-, and
// what is still outside is set to the bound; its weight is computed as if it had been drawn there, and so is no ratio of
// densities any more: the box's price, which the study of [L] shows. (Equation 15 of [L] is garbled; this is what its
// words say.) Where P is much wider than Q, the ratio's weights are those of few, and they cling to where they were:
// process_variance must be above 0 everywhere.
// Source: van der Merwe, de Freitas, Doucet & Wan 2000; [L] equations 13 to 16. Errors: nonlinear_filter.h;
// @throws std::invalid_argument from the constructor where a process variance is not above 0. Real-time safe: yes, after
// construction. The same seed and calls give the same bits.

#include <optional>

#include "monitor/nonlinear/nonlinear_filter.h"
#include "monitor/nonlinear/particle_cloud.h"
#include "monitor/nonlinear/particle_filter.h"

namespace ehm::nonlinear {

/// ratio: as above. likelihood: ln w_i += ln p(nu | g(X_i)) alone, which counts a reading twice and is no Bayes' rule,
/// but keeps many particles alive where P is much wider than Q: only with it do the figures of [L] come out.
enum class ParticleWeights { likelihood, ratio };
inline constexpr std::array<std::string_view, 2> particle_weights_names{"likelihood", "ratio"};

enum class ParticleJacobian { shared, own };
inline constexpr std::array<std::string_view, 2> particle_jacobian_names{"shared", "own"};

struct ExtendedParticleOptions {
  ParticleOptions cloud = {};
  ParticleWeights weights = ParticleWeights::likelihood;
  ParticleJacobian jacobian = ParticleJacobian::shared;
  std::optional<StateBox> box = {};
};

class ExtendedParticleFilter final : public NonlinearFilter {
 public:
  ExtendedParticleFilter(FilterNoise noise, ExtendedParticleOptions options);

  [[nodiscard]] std::unique_ptr<NonlinearFilter> clone() const override;
  void start(const OrderVector& x, const OrderMatrix& covariance) noexcept override;
  void open(const OrderVector& variance) noexcept override;
  bool foresee(StateSpace& model, const SensorVector& sigma) noexcept override;
  bool update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept override;
  bool advance(StateSpace& model) noexcept override;

 private:
  /// Of a Gaussian, by its Cholesky factor S: -|S^-1 d|^2/2 - ln det S, and a constant.
  struct Density {
    OrderMatrix factor;
    double log_volume = 0.0;
    bool factorise(const OrderMatrix& covariance) noexcept;
    double log_of(const OrderVector& deviation) const noexcept;
  };
  /// What a Jacobian leads to: all particles share one of them, or each has its own.
  struct Proposal {
    Slopes slopes;
    OrderMatrix prior, posterior;                                        ///< P_i-, P_i
    Density density;                                                     ///< of P_i
    estimation::BoundedMatrix<max_order, estimation::max_sensors> gain;  ///< K_i
  };
  bool own() const noexcept { return options_.jacobian == ParticleJacobian::own; }
  Proposal& proposal(Eigen::Index i) noexcept { return proposals_[own() ? static_cast<std::size_t>(i) : 0]; }
  bool make_gain(Proposal& p, SensorMask fused) const noexcept;
  bool draw_particle(StateSpace& model, Eigen::Index i, const SensorVector& innovation, SensorMask fused,
                     const Density& transition) noexcept;
  void follow_resampling() noexcept;
  OrderVector into_box(const OrderVector& drawn, const OrderVector& before) const noexcept;
  double log_likelihood(const SensorVector& readings, const SensorVector& innovation, SensorMask fused) const noexcept;

  FilterNoise noise_;
  ExtendedParticleOptions options_;
  ParticleCloud cloud_;
  std::vector<Proposal> proposals_, spare_proposals_;
  OrderMatrix transition_;                          ///< what leads to a particle: Q, and at the start P
  Eigen::Array<bool, Eigen::Dynamic, 1> answered_;  ///< which particles' models did
  Eigen::MatrixXd readings_, next_, spare_next_;    ///< N x m, N x n
  SensorVector sigma_;
  Response response_;
  bool moved_ = false;  ///< next_ is of these particles
};

}  // namespace ehm::nonlinear
