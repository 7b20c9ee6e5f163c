// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/extended_filter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/nonlinear/scalar_update.h"

namespace ehm::nonlinear {

ExtendedFilter::ExtendedFilter(FilterNoise noise, ExtendedOptions options)
    : noise_(std::move(noise)), options_(std::move(options)) {
  const Eigen::Index n = noise_.process_variance.size();
  start(OrderVector::Zero(n), OrderMatrix::Zero(n, n));
}

std::unique_ptr<NonlinearFilter> ExtendedFilter::clone() const {
  return std::make_unique<ExtendedFilter>(noise_, options_);
}

void ExtendedFilter::start(const OrderVector& x, const OrderMatrix& covariance) noexcept {
  x_ = x;
  p_ = covariance;
  answered_ = false;
}

bool ExtendedFilter::ask(StateSpace& model, const OrderVector& x) noexcept {
  if (!model.respond(x, response_, slopes_)) return false;
  asked_ = x;
  answered_ = true;
  return true;
}

bool ExtendedFilter::foresee(StateSpace& model, const SensorVector& sigma) noexcept {
  answered_ = false;
  if (!ask(model, x_)) return false;
  predicted_ = response_.readings;
  variance_ = sigma.cwiseAbs2();
  innovation_variance_ = variance_;
  for (Eigen::Index i = 0; i < variance_.size(); ++i)
    innovation_variance_(i) += slopes_.g.row(i) * p_ * slopes_.g.row(i).transpose();
  return true;
}

/// How far x- moves by the tangent at asked_; p: P- becomes P.
OrderVector ExtendedFilter::correction(const SensorVector& innovation, SensorMask fused,
                                       OrderMatrix& p) const noexcept {
  const OrderVector back = x_ - asked_;
  OrderVector change = OrderVector::Zero(x_.size());
  for (Eigen::Index i = 0; i < innovation.size(); ++i) {
    if (!fused[as_size(i)]) continue;
    const OrderVector row = slopes_.g.row(i).transpose();
    const double left = innovation(i) - (response_.readings(i) - predicted_(i)) - row.dot(back) - row.dot(change);
    change += take_in(row, variance_(i), p) * left;
  }
  return change;
}

/// Whether x is where the model was asked last, as far as P tells.
bool ExtendedFilter::near(const OrderVector& x, const OrderMatrix& p) const noexcept {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (std::abs(x(i) - asked_(i)) > options_.enough * std::sqrt(std::max(p(i, i), 0.0))) return false;
  return true;
}

bool ExtendedFilter::update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept {
  if (!answered_) return false;
  OrderMatrix p = p_;
  OrderVector x = x_ + correction(innovation, fused, p);
  for (int j = 1; j < options_.iterations; ++j) {
    // where the engine has no answer on the way, the last one stands
    if (near(x, p) || !ask(model, x)) break;
    p = p_;
    x = x_ + correction(innovation, fused, p);
  }
  x_ = options_.box ? OrderVector(x.cwiseMax(options_.box->least).cwiseMin(options_.box->greatest)) : x;
  p_ = p;
  return true;
}

bool ExtendedFilter::advance(StateSpace& model) noexcept {
  if (!answered_ && !ask(model, x_)) return false;
  x_ = response_.next + slopes_.f * (x_ - asked_);
  p_ = carried(slopes_.f, p_, noise_.process_variance);
  answered_ = false;
  return true;
}

}  // namespace ehm::nonlinear
