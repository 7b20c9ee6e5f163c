// SPDX-License-Identifier: Apache-2.0
#pragma once
// The extended Kalman filter and two of its kin, n states, m sensors:
//
//   foresee   y^ = g(x-),  H = dg/dx at x-
//   update    x_0 = x-;  x_(j+1) = x- + K_j (nu - (g(x_j) - g(x-)) - H_j (x- - x_j)),  P = (I - K_J H_J) P-
//             J = 1: the extended filter; more: the iterated one, which ends where a step is small against P
//   box       x <- min(max(x, least), greatest): the clipped filter; P stays, and so says nothing of the box
//   advance   x- = f(x_J) + F (x - x_J),  P- = F P F' + Q
//
// The iterated filter is Gauss-Newton on the sample's own likelihood (Bell & Cathey 1993). f and F are those of the last
// question within the sample, moved along the tangent: exact to the first order of the last step, which saves a
// solution of the engine. Readings in turn, scaled by nothing: R is diagonal (scalar_update.h).
// Source: Simon, Optimal State Estimation, ch. 13; [L] equations 3 to 6. Errors and real time: nonlinear_filter.h.

#include <optional>

#include "monitor/nonlinear/nonlinear_filter.h"

namespace ehm::nonlinear {

struct ExtendedOptions {
  int iterations = 1;    ///< at most
  double enough = 0.01;  ///< the longest step, in standard deviations, after which it iterates no more
  std::optional<StateBox> box = {};
};

class ExtendedFilter final : public NonlinearFilter {
 public:
  ExtendedFilter(FilterNoise noise, ExtendedOptions options);

  [[nodiscard]] std::unique_ptr<NonlinearFilter> clone() const override;
  void start(const OrderVector& x, const OrderMatrix& covariance) noexcept override;
  void open(const OrderVector& variance) noexcept override { p_.diagonal() += variance; }
  bool foresee(StateSpace& model, const SensorVector& sigma) noexcept override;
  bool update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept override;
  bool advance(StateSpace& model) noexcept override;

 private:
  bool ask(StateSpace& model, const OrderVector& x) noexcept;
  bool near(const OrderVector& x, const OrderMatrix& p) const noexcept;
  OrderVector correction(const SensorVector& innovation, SensorMask fused, OrderMatrix& p) const noexcept;

  FilterNoise noise_;
  ExtendedOptions options_;
  SensorVector variance_;  ///< R
  Response response_;      ///< at asked_
  Slopes slopes_;
  OrderVector asked_;
  bool answered_ = false;  ///< asked_ is of this sample
};

}  // namespace ehm::nonlinear
