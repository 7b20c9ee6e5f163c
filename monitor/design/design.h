// SPDX-License-Identifier: Apache-2.0
#pragma once
// A finished tuner design: the model, how it was scaled, one filter per sensor set, and how good it is.
//
// All matrices of a SubsetDesign are in scaled units (engine_sim/linear_model/scaling.h): states and sensors in percent
// of trim, health in percent, auxiliary outputs in their reporting unit, controls in channel units. make_filter turns
// them into the filter that flies, in channel units. n states, m sensors, p health, r auxiliary, t tuners.
// Source: Simon & Garg, NASA/TM-2010-216077, eqs. 5-8, 15-17; the error theory is theory.md, section 4.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/design/certificate.h"
#include "monitor/schedule/schedule.h"

namespace ehm::design {

/// How V* is chosen: the closed form H Ph, or a search for the least error of the Kalman filter or of the MAP
/// estimator.
enum class Tuning { closed_form, kalman, map };

/// What a design is to be good at (certificate.h).
struct ErrorWeights {
  double health = 1.0;          ///< w_h
  double auxiliary = 1.0;       ///< w_z
  std::vector<double> channel;  ///< of each auxiliary output; empty: 1 each
};

/// How a design was made; the same options on the same model give the same file.
struct DesignOptions {
  double qh_percent2 = 1e-3;  ///< process noise of each health parameter per sample
  Tuning tuning = Tuning::kalman;
  ErrorWeights weights;
  int random_starts = 8;   ///< of the search, beside the closed form and the SVD tuners
  std::uint64_t seed = 1;  ///< of the random starts
  std::string created_by = "tuner_design";
  std::string version = "unversioned";
};

/// The filter for one set of sensors and its theoretical error.
struct SubsetDesign {
  std::vector<int> sensors;           ///< indices of the sensors that it uses, ascending
  Eigen::MatrixXd V;                  ///< t x p, orthonormal rows; q = V h
  Eigen::MatrixXd W;                  ///< p x t, pseudoinverse of V; the filter models h = W q
  Eigen::MatrixXd health_readout;     ///< p x t, Rh; published h = Rh q. W, unless the model knows its linearisation
                                      ///< error (tuner_design/theory/read_out.h)
  Eigen::MatrixXd auxiliary_readout;  ///< r x t, Rz; published z = F x + Rz q. N W likewise
  Eigen::MatrixXd A;                  ///< (n+t) x (n+t), Axq
  Eigen::MatrixXd B;                  ///< (n+t) x nu, Bxq
  Eigen::MatrixXd C;                  ///< m x (n+t), Cxq, a row for every sensor of the model
  Eigen::MatrixXd K;                  ///< (n+t) x m, Kinf, zero columns for sensors that are not used
  Eigen::MatrixXd P;                  ///< (n+t) x (n+t), predicted covariance, solves the Riccati equation
  Eigen::MatrixXd health_total_covariance, auxiliary_total_covariance;  ///< G Ph G^T + T S T^T + linearisation
  Eigen::MatrixXd health_linearisation_covariance, auxiliary_linearisation_covariance;  ///< part of the total
  Eigen::MatrixXd health_filter_covariance, auxiliary_filter_covariance;                ///< T P_updated T^T
  Eigen::MatrixXd health_noise_covariance, auxiliary_noise_covariance;                  ///< T S T^T
  Eigen::VectorXd innovation_variance;                                                  ///< m, percent^2
  double slowest_time_constant_s = 0.0;                                                 ///< of the closed loop

  /// A thousandth is left of a start after that.
  [[nodiscard]] double settling_s() const noexcept { return 7.0 * slowest_time_constant_s; }
  [[nodiscard]] int settling_samples(double sample_time_s) const noexcept {
    return static_cast<int>(std::ceil(settling_s() / sample_time_s));
  }
  /// Over so many samples, at least one, the slowest part of the filter averages the noise.
  [[nodiscard]] double averaged_samples(double sample_time_s) const noexcept {
    return std::max(1.0, slowest_time_constant_s / sample_time_s);
  }
};

/// Expected squared error by channel: health in percent^2, auxiliary in reporting units^2.
struct ErrorByChannel {
  Eigen::VectorXd health, auxiliary;
};

struct Design {
  linear_model::LinearModel model;  ///< as it was given, continuous or discrete
  linear_model::Scaling scaling;
  DesignOptions options;
  SubsetDesign full;
  std::vector<std::optional<SubsetDesign>> missing;  ///< [i] without sensor i; empty where that is not observable
  ErrorByChannel ssee;                               ///< of `full` on the linear engine: theory.md, section 4
  ErrorByChannel linearisation;                      ///< what the real engine's nonlinearity adds to that
  ErrorByChannel bayes_limit;            ///< no linear estimator on steady data at this point errs less of the real
                                         ///< engine: ssee + linearisation is what compares with it
  ErrorByChannel full_map, reduced_map;  ///< MAP on one noisy snapshot, on h and on the tuners
  Certificate certificate;               ///< of the tuners of `full`
  std::optional<schedule::Schedule> schedule;  ///< of the estimator `scheduled`; most designs have none
  std::string hash;                            ///< SHA-256 of the content; set by write_design and read_design

  /// Of `full` on the real engine, as far as the model knows what it misses.
  [[nodiscard]] ErrorByChannel real_error() const {
    return {ssee.health + linearisation.health, ssee.auxiliary + linearisation.auxiliary};
  }
};

}  // namespace ehm::design
