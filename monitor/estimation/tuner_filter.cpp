#include "monitor/estimation/tuner_filter.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace ehm::estimation {
namespace {

template <typename Matrix>
void require_shape(const std::string& name, const Matrix& matrix, Eigen::Index rows, Eigen::Index cols) {
  if (matrix.rows() == rows && matrix.cols() == cols) return;
  throw std::invalid_argument("tuner filter: " + name + " is " + std::to_string(matrix.rows()) + " x " +
                              std::to_string(matrix.cols()) + "; expected " + std::to_string(rows) + " x " +
                              std::to_string(cols));
}

/// Shapes of one sensor set against the full model's; t differs between sets.
void check_gain(const std::string& set, const SubsetGain& gain, const TunerFilterModel& model) {
  const Eigen::Index a = gain.A.rows(), full = model.full.A.rows(), m = model.D.rows(), nu = model.D.cols();
  const Eigen::Index p = model.health_trim.size(), r = model.auxiliary_trim.size();
  require_shape(set + " A", gain.A, a, a);
  require_shape(set + " B", gain.B, a, nu);
  require_shape(set + " C", gain.C, m, a);
  require_shape(set + " K", gain.K, a, m);
  require_shape(set + " health_output", gain.health_output, p, a);
  require_shape(set + " auxiliary_output", gain.auxiliary_output, r, a);
  require_shape(set + " from_full", gain.from_full, a, full);
  require_shape(set + " to_full", gain.to_full, full, a);
  require_shape(set + " innovation_variance", gain.innovation_variance, m, 1);
  require_shape(set + " health_sigma_total", gain.health_sigma_total, p, 1);
  require_shape(set + " health_sigma_filter", gain.health_sigma_filter, p, 1);
  require_shape(set + " auxiliary_sigma_total", gain.auxiliary_sigma_total, r, 1);
  require_shape(set + " auxiliary_sigma_filter", gain.auxiliary_sigma_filter, r, 1);
  require_shape(set + " health_noise_covariance", gain.health_noise_covariance, p, p);
  require_shape(set + " auxiliary_noise_covariance", gain.auxiliary_noise_covariance, r, r);
}

}  // namespace

TunerFilter::TunerFilter(TunerFilterModel model) : model_(std::move(model)) {
  require_shape("G", model_.G, model_.auxiliary_trim.size(), model_.D.cols());
  check_gain("full set:", model_.full, model_);
  if (model_.states < 1 || model_.full.A.rows() <= model_.states) {
    throw std::invalid_argument("tuner filter: states is " + std::to_string(model_.states) +
                                "; expected 1 or more, and at least one tuner besides");
  }
  if (model_.missing.size() != static_cast<std::size_t>(model_.D.rows())) {
    throw std::invalid_argument("tuner filter: " + std::to_string(model_.missing.size()) +
                                " designs for a missing sensor; expected one entry for each of the " +
                                std::to_string(model_.D.rows()) + " sensors");
  }
  for (std::size_t i = 0; i < model_.missing.size(); ++i) {
    if (model_.missing[i]) check_gain("without sensor " + std::to_string(i) + ":", *model_.missing[i], model_);
  }
  innovation_.setZero(model_.D.rows());
  fused_innovation_.setZero(model_.D.rows());
  actuators_.setZero(model_.D.cols());
  health_ = model_.health_trim;
  auxiliary_ = model_.auxiliary_trim;
  reset();
}

void TunerFilter::predict(const ActuatorVector& du_previous) noexcept {
  // xpred = Axq xhat[k-1] + Bxq u[k-1]
  predicted_.noalias() = gain().A * estimate_;
  predicted_.noalias() += gain().B * du_previous;
}

void TunerFilter::innovation(const SensorVector& dy, const ActuatorVector& du) noexcept {
  // nu = y[k] - Cxq xpred - D u[k]
  actuators_ = du;
  innovation_ = dy;
  innovation_.noalias() -= gain().C * predicted_;
  innovation_.noalias() -= model_.D * actuators_;
}

void TunerFilter::update(SensorMask fused) noexcept {
  // Chosen, not multiplied by zero: a sensor without a value has NaN here.
  const SensorMask used = fused & gain().sensors;
  for (Eigen::Index i = 0; i < innovation_.size(); ++i) {
    fused_innovation_(i) = used[static_cast<std::size_t>(i)] ? innovation_(i) : 0.0;
  }
  // xhat = xpred + K nu
  estimate_ = predicted_;
  estimate_.noalias() += gain().K * fused_innovation_;
  read_out();
}

bool TunerFilter::switch_sensor_set(SensorSet set) noexcept {
  if (!available(set)) return false;
  if (set == set_) return true;
  // Through the full set: exact, because each step keeps the predicted sensors of the smaller set.
  if (!set_.is_full()) {
    scratch_.noalias() = gain().to_full * estimate_;
    estimate_ = scratch_;
    set_ = SensorSet::full();
  }
  if (!set.is_full()) {
    set_ = set;
    scratch_.noalias() = gain().from_full * estimate_;
    estimate_ = scratch_;
  }
  predicted_ = estimate_;
  read_out();
  return true;
}

void TunerFilter::reset() noexcept {
  set_ = SensorSet::full();
  estimate_.setZero(model_.full.A.rows());
  predicted_ = estimate_;
  innovation_.setZero();
  actuators_.setZero();
  read_out();
}

bool TunerFilter::available(SensorSet set) const noexcept {
  if (set.is_full()) return true;
  const auto i = static_cast<std::size_t>(set.missing());
  return i < model_.missing.size() && model_.missing[i].has_value();
}

void TunerFilter::read_out() noexcept {
  // h = h_trim + Th xhat
  health_ = model_.health_trim;
  health_.noalias() += gain().health_output * estimate_;
  // z = z_trim + Tz xhat + G u[k]
  auxiliary_ = model_.auxiliary_trim;
  auxiliary_.noalias() += gain().auxiliary_output * estimate_;
  auxiliary_.noalias() += model_.G * actuators_;
}

}  // namespace ehm::estimation
