// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/gauss_markov_filter.h"

#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/index.h"

namespace ehm::estimation {

GaussMarkovFilter::GaussMarkovFilter(std::shared_ptr<const FullOrderModel> model,
                                     std::shared_ptr<const GaussMarkovGain> gain)
    : model_(std::move(model)), gain_(std::move(gain)) {
  if (!(gain_->rho > 0.0 && gain_->rho < 1.0)) {
    throw std::invalid_argument("Gauss-Markov filter: rho is " + std::to_string(gain_->rho) +
                                "; allowed: above 0 and below 1");
  }
  const Eigen::Index m = model_->sensor_output.rows();
  if (gain_->K.rows() != model_->sensor_output.cols() || gain_->K.cols() != m ||
      gain_->innovation_variance.size() != m) {
    throw std::invalid_argument(
        "Gauss-Markov filter: K is " + std::to_string(gain_->K.rows()) + " x " + std::to_string(gain_->K.cols()) +
        " with " + std::to_string(gain_->innovation_variance.size()) + " innovation variances; expected " +
        std::to_string(model_->sensor_output.cols()) + " x " + std::to_string(m) + " with " + std::to_string(m));
  }
  reset();
}

void GaussMarkovFilter::reset() noexcept {
  estimate_.setZero(gain_->K.rows());
  innovation_.setZero(gain_->K.cols());
  actuators_.setZero(model_->D.cols());
  read_out();
}

bool GaussMarkovFilter::restore(const AugmentedVector& estimate) noexcept {
  if (estimate.size() != estimate_.size()) return false;
  estimate_ = estimate;
  read_out();
  return true;
}

void GaussMarkovFilter::predict(const ActuatorVector& du_previous) noexcept {
  const Eigen::Index n = model_->A.rows(), p = model_->L.cols();
  // xpred = A x + B u + L h,  hpred = rho h
  state_.noalias() = model_->A.lazyProduct(estimate_.head(n));
  state_ += model_->B.lazyProduct(du_previous);
  state_ += model_->L.lazyProduct(estimate_.tail(p));
  estimate_.head(n) = state_;
  estimate_.tail(p) *= gain_->rho;
}

void GaussMarkovFilter::innovation(const SensorVector& dy, const ActuatorVector& du) noexcept {
  // nu = y - [C M] [xpred; hpred] - D u
  actuators_ = du;
  innovation_ = dy;
  innovation_ -= model_->sensor_output.lazyProduct(estimate_);
  innovation_ -= model_->D.lazyProduct(du);
}

void GaussMarkovFilter::update(SensorMask fused) noexcept {
  // Chosen, not multiplied by zero: a sensor without a value has NaN here.
  for (Eigen::Index i = 0; i < innovation_.size(); ++i) {
    if (fused[as_size(i)]) estimate_ += gain_->K.col(i) * innovation_(i);
  }
  read_out();
}

void GaussMarkovFilter::read_out() noexcept {
  health_ = estimate_.tail(model_->L.cols());
  auxiliary_ = model_->auxiliary_output.lazyProduct(estimate_);
  auxiliary_ += model_->G.lazyProduct(actuators_);
}

}  // namespace ehm::estimation
