// SPDX-License-Identifier: Apache-2.0
#pragma once
// Spectra that each noise of the model gives the differenced residual d (model_residual.h), at the angular frequency w
// per sample, z = exp(i w). With the model x[k+1] = A x + L h + w, h[k+1] = h + g, y = C x + M h + v:
//
//   walk    of health parameter i   a = C (zI - A)^-1 L e_i + M e_i                    S = a a^H    per percent^2
//   motion  of state j              a = (1 - z^-1) C (zI - A)^-1 e_j                   S = a a^H    per unit of Q
//   sensor  l                       S_ll = |1 - z^-1|^2 |D(w)/n|^2                                  per percent^2 of R
//
// S m x m, Hermitian; the spectrum of d is the sum, each times its variance: linear in what is looked for. n: samples
// for which a sensor holds its value (sensor_noise.h), D(w) = 1 + z^-1 + ... + z^-(n-1); R counts what is held n times,
// and the sensor's row of a is multiplied by D/n, on average over the phase of the holding.
//
// A process noise Q of the model that is not diagonal is one term, its whole matrix times a factor: sensors seldom tell
// more. States whose Q is 0 are taken to have none; where all of Q is 0, each state has a term.
// Errors: none. Matrices discrete and scaled.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"

namespace ehm::tuner_design {

enum class NoiseKind { sensor, motion, walk };

struct NoiseTerm {
  NoiseKind kind;
  int channel;  ///< sensor, state (-1: all of them, by the model's Q), health parameter
};

class NoiseSpectra {
 public:
  explicit NoiseSpectra(const linear_model::LinearModel& scaled);

  const std::vector<NoiseTerm>& terms() const { return terms_; }
  Eigen::Index sensors() const { return model_.C.rows(); }
  /// sums[t] += weight * spectrum of term t
  void add_at(double omega, double weight, std::vector<Eigen::MatrixXcd>& sums) const;
  /// Above that, what the slowest sensor holds is aliased.
  double highest_omega() const;

 private:
  linear_model::LinearModel model_;
  std::vector<NoiseTerm> terms_;
  std::vector<int> held_;
  std::vector<Eigen::MatrixXd> motion_roots_;  ///< n x k, of each motion term
};

}  // namespace ehm::tuner_design
