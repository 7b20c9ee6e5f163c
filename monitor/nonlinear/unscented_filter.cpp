// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/unscented_filter.h"

#include <Eigen/Cholesky>
#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::nonlinear {
namespace {

Eigen::Index dimension(Eigen::Index order, UnscentedForm form) {
  return form == UnscentedForm::augmented ? 2 * order : order;
}

}  // namespace

UnscentedFilter::UnscentedFilter(FilterNoise noise, UnscentedOptions options)
    : noise_(std::move(noise)),
      options_(options),
      set_(sigma_points(dimension(noise_.process_variance.size(), options.form), options.points)) {
  const Eigen::Index n = noise_.process_variance.size();
  points_.setZero(n, set_.points.cols());
  start(OrderVector::Zero(n), OrderMatrix::Zero(n, n));
}

std::unique_ptr<NonlinearFilter> UnscentedFilter::clone() const {
  return std::make_unique<UnscentedFilter>(noise_, options_);
}

void UnscentedFilter::start(const OrderVector& x, const OrderMatrix& covariance) noexcept {
  x_ = x;
  p_ = covariance;
  drawn_ = false;
}

void UnscentedFilter::open(const OrderVector& variance) noexcept {
  p_.diagonal() += variance;
  drawn_ = false;
}

bool UnscentedFilter::draw() noexcept {
  const Eigen::LLT<OrderMatrix> factor(p_);
  if (factor.info() != Eigen::Success) return false;
  const OrderMatrix s = factor.matrixL();
  for (Eigen::Index i = 0; i < points_.cols(); ++i) points_.col(i) = x_ + s * set_.points.col(i).head(x_.size());
  return true;
}

void UnscentedFilter::sum_up() noexcept {
  x_.setZero();
  for (Eigen::Index i = 0; i < points_.cols(); ++i) x_ += set_.mean_weights(i) * points_.col(i);
  p_.setZero();
  for (Eigen::Index i = 0; i < points_.cols(); ++i) {
    const OrderVector d = points_.col(i) - x_;
    p_.noalias() += (set_.covariance_weights(i) * d) * d.transpose();
  }
  p_ = (0.5 * (p_ + p_.transpose())).eval();
}

bool UnscentedFilter::foresee(StateSpace& model, const SensorVector& sigma) noexcept {
  if (!drawn_ && !draw()) return false;
  const Eigen::Index m = sigma.size(), n = x_.size();
  readings_.resize(m, points_.cols());
  SensorVector mean = SensorVector::Zero(m);
  for (Eigen::Index i = 0; i < points_.cols(); ++i) {
    if (!model.respond(points_.col(i), response_)) return false;
    readings_.col(i) = response_.readings.cwiseQuotient(sigma);
    mean += set_.mean_weights(i) * readings_.col(i);
  }
  sigma_ = sigma;
  predicted_ = mean.cwiseProduct(sigma);
  pyy_.setIdentity(m, m);
  pxy_.setZero(n, m);
  for (Eigen::Index i = 0; i < points_.cols(); ++i) {
    const SensorVector d = readings_.col(i) - mean;
    pyy_.noalias() += (set_.covariance_weights(i) * d) * d.transpose();
    pxy_.noalias() += (set_.covariance_weights(i) * (points_.col(i) - x_)) * d.transpose();
  }
  innovation_variance_ = pyy_.diagonal().cwiseProduct(sigma.cwiseAbs2());
  return true;
}

bool UnscentedFilter::update(StateSpace&, const SensorVector& innovation, SensorMask fused) noexcept {
  const Eigen::Index m = innovation.size();
  SensorVector nu(m);
  ReadingMatrix pyy(m, m);
  estimation::BoundedMatrix<max_order, estimation::max_sensors> pxy(x_.size(), m);
  Eigen::Index used = 0;
  std::array<Eigen::Index, estimation::max_sensors> place{};
  for (Eigen::Index i = 0; i < m; ++i)
    if (fused[as_size(i)]) place[as_size(used++)] = i;
  drawn_ = false;
  if (used == 0) return true;
  for (Eigen::Index i = 0; i < used; ++i) {
    const Eigen::Index from = place[as_size(i)];
    nu(i) = innovation(from) / sigma_(from);
    pxy.col(i) = pxy_.col(from);
    for (Eigen::Index j = 0; j < used; ++j) pyy(i, j) = pyy_(from, place[as_size(j)]);
  }
  nu.conservativeResize(used);
  pyy.conservativeResize(used, used);
  pxy.conservativeResize(x_.size(), used);
  // Pyy = L L':  W = Pxy L'^-1,  x + W L^-1 nu,  P - W W'
  const Eigen::LLT<ReadingMatrix> factor(pyy);
  if (factor.info() != Eigen::Success) return false;
  factor.matrixL().solveInPlace(nu);
  estimation::BoundedMatrix<estimation::max_sensors, max_order> w = pxy.transpose();
  factor.matrixL().solveInPlace(w);
  x_ += w.transpose() * nu;
  p_.noalias() -= w.transpose() * w;
  return true;
}

bool UnscentedFilter::advance(StateSpace& model) noexcept {
  const OrderVector x = x_;
  if (!draw()) return false;
  const OrderVector spread = noise_.process_variance.cwiseSqrt();
  const bool augmented = options_.form == UnscentedForm::augmented;
  for (Eigen::Index i = 0; i < points_.cols(); ++i) {
    if (!model.respond(points_.col(i), response_)) {
      x_ = x;
      return false;
    }
    points_.col(i) = response_.next;
    if (augmented) points_.col(i) += spread.cwiseProduct(set_.points.col(i).tail(x_.size()));
  }
  sum_up();
  if (!augmented) p_.diagonal() += noise_.process_variance;
  drawn_ = augmented;
  return true;
}

}  // namespace ehm::nonlinear
