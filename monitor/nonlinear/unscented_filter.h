// SPDX-License-Identifier: Apache-2.0
#pragma once
// The unscented Kalman filter, n states, m sensors, sigma points chi_i with weights Wm, Wc (sigma_points.h):
//
//   foresee   X_i = x- + S chi_i, S S' = P-;  Y_i = g(X_i);  y^ = sum Wm_i Y_i
//             Pyy = sum Wc_i (Y_i - y^)(Y_i - y^)' + R,   Pxy = sum Wc_i (X_i - x-)(Y_i - y^)'
//   update    K = Pxy Pyy^-1 over the fused sensors,  x = x- + K nu,  P = P- - K Pyy K'
//   advance   X_i = f(x + S chi_i);  x- = sum Wm_i X_i,  P- = sum Wc_i (X_i - x-)(X_i - x-)' + Q
//
// additive: points are drawn anew around x- for g. augmented: the points are of [x; w], 2 n dimensions, w enters f, and
// the very points that f led to go on to g; v stays additive, which loses nothing, since y is linear in it. Readings
// count in their noise's sigma (R = I), so that Pyy is well scaled; it is solved by its Cholesky factors.
// Source: Julier & Uhlmann 2004; Simon, Optimal State Estimation, ch. 14; [E] ch. 4.
// Errors: nonlinear_filter.h; besides, false where P has lost its definiteness. Real-time safe: yes.

#include "monitor/nonlinear/nonlinear_filter.h"
#include "monitor/nonlinear/sigma_points.h"

namespace ehm::nonlinear {

enum class UnscentedForm { additive, augmented };
inline constexpr std::array<std::string_view, 2> unscented_form_names{"additive", "augmented"};

struct UnscentedOptions {
  SigmaOptions points = {};
  UnscentedForm form = UnscentedForm::additive;
};

class UnscentedFilter final : public NonlinearFilter {
 public:
  UnscentedFilter(FilterNoise noise, UnscentedOptions options);

  [[nodiscard]] std::unique_ptr<NonlinearFilter> clone() const override;
  void start(const OrderVector& x, const OrderMatrix& covariance) noexcept override;
  void open(const OrderVector& variance) noexcept override;
  bool foresee(StateSpace& model, const SensorVector& sigma) noexcept override;
  bool update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept override;
  bool advance(StateSpace& model) noexcept override;

 private:
  /// The points around x_; the part of w is left to advance(). False: P is not definite.
  bool draw() noexcept;
  /// Mean and covariance of points_ become x_ and p_.
  void sum_up() noexcept;

  static constexpr int max_points = 4 * max_order + 1;

  FilterNoise noise_;
  UnscentedOptions options_;
  SigmaPoints set_;
  estimation::BoundedMatrix<max_order, max_points> points_;
  bool drawn_ = false;  ///< points_ are those of the last advance()
  estimation::BoundedMatrix<estimation::max_sensors, max_points> readings_;
  SensorVector sigma_;
  ReadingMatrix pyy_;                                                  ///< in sigmas
  estimation::BoundedMatrix<max_order, estimation::max_sensors> pxy_;  ///< the same
  Response response_;
};

}  // namespace ehm::nonlinear
