// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kosanam's tables 5.2 and 5.3 and figure 5.6: the steady Kalman filter and a robust one on batches of flights, where
// the sensors' noise is as the model says, and where it is not. The robust gain is the closed form of
// robust/robust_gain.h (the thesis: 96 h of descent to a gain that is unstable), by itself and mixed as the thesis had
// to,
//   K = eta Ks + (1 - eta) Kr,   eta = 0.7
// for J = rho1 (V1 + V2) + rho2 V2^2 (sigma1^2 = 0, sigma2^2 = 1), V in percent squared of health.
//
// *Readings*: "two standard deviations" is R x 9; rho2/rho1 is not given: here 40 a percent squared, with
// which J falls by the 80 % of figure 5.4; 50 flights reach the
// end of the wear table. qh is the factor of the model's at which the Kalman filter errs least at nominal noise.
// Errors: @throws what batch_problem, steady_filter and robust_gain throw.

#include <array>
#include <string>
#include <vector>

#include "tuner_design/kosanam/constrained_tables.h"
#include "tuner_design/robust/robust_gain.h"

namespace ehm::tuner_design {

struct RobustTablesOptions {
  BatchOptions batch{.flights = 50};
  double health_variance = 25e-6;
  std::vector<double> sweep{1.0, 3.0, 10.0, 30.0, 100.0, 300.0};  ///< of it
  double eta = 0.7, rho2 = 40.0;
  std::vector<double> noise_factors{1.0, 2.0, 4.0, 9.0, 16.0};  ///< figure 5.6; table 5.2 is that of 9, 5.3 of 1
};

/// In this order in every result.
namespace robust_case {
enum Case : std::size_t { standard, mixed, robust };
}

/// J over two elements of the gain, the others as in the standard one.
struct ObjectiveSurface {
  Eigen::Index parameter = 0, first = 0, second = 0;  ///< of health, whose row it is; two sensors
  std::vector<double> share;                          ///< of the standard element, along both sides
  Eigen::MatrixXd objective;  ///< over that of the standard gain; first x second; not a number: not stable
};

struct RobustTables {
  RobustTablesOptions options;
  std::string model;
  std::vector<std::string> health, not_known;
  double factor = 1.0;                                      ///< of qh
  double mu = 1.0;                                          ///< the robust gain is that for R x mu
  double standard_objective = 0.0, robust_objective = 0.0;  ///< J
  std::vector<BatchResult> by_noise;                        ///< as noise_factors
  std::vector<RobustTrade> trade;                           ///< figure 5.4: from the standard gain on
  ObjectiveSurface surface;                                 ///< figure 5.5
  std::vector<std::string> sensors;

  const BatchResult& at(double noise_factor) const;
};

/// As published, percent: standard, robust.
inline constexpr std::array<std::array<double, 2>, 8> published_5_2{
    {{14.0, 12.8}, {16.6, 17.3}, {8.1, 7.3}, {12.5, 12.3}, {6.7, 6.7}, {12.1, 11.0}, {9.3, 8.5}, {10.5, 9.7}}};
inline constexpr std::array<std::array<double, 2>, 8> published_5_3{
    {{5.5, 4.6}, {6.7, 7.1}, {2.9, 3.0}, {5.6, 5.7}, {2.6, 5.5}, {4.7, 5.0}, {4.4, 4.1}, {6.8, 6.7}}};
inline constexpr std::array<double, 2> published_5_2_average{11.3, 10.7}, published_5_3_average{4.9, 5.2};

RobustTables robust_tables(const linear_model::LinearModel& model, const RobustTablesOptions& options);

}  // namespace ehm::tuner_design
