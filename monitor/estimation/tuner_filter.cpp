// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/tuner_filter.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "deploy/runtime/numbers/index.h"

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

/// q[k+1] = q[k], and h = W q.
void check_tuner_structure(const std::string& set, const SubsetGain& gain, Eigen::Index states) {
  const Eigen::Index tuners = gain.A.rows() - states;
  const bool constant = tuners >= 1 && gain.A.bottomLeftCorner(tuners, states).isZero(0.0) &&
                        gain.A.bottomRightCorner(tuners, tuners).isIdentity(0.0) &&
                        gain.B.bottomRows(tuners).isZero(0.0);
  if (!constant) {
    throw std::invalid_argument("tuner filter: " + set + " the last " + std::to_string(tuners) +
                                " rows of A and B move the tuners; expected [0, I] and 0, at least one row");
  }
  if (!gain.health_output.leftCols(states).isZero(0.0))
    throw std::invalid_argument("tuner filter: " + set + " health_output has states in it; expected [0, Rh]");
}

void check_model(const TunerFilterModel& model) {
  require_shape("G", model.G, model.auxiliary_trim.size(), model.D.cols());
  check_gain("full set:", model.full, model);
  if (model.states < 1 || model.states > max_states || model.full.A.rows() <= model.states) {
    throw std::invalid_argument("tuner filter: states is " + std::to_string(model.states) + "; expected 1 to " +
                                std::to_string(max_states) + ", and at least one tuner besides");
  }
  check_tuner_structure("full set:", model.full, model.states);
  if (model.missing.size() != as_size(model.D.rows())) {
    throw std::invalid_argument("tuner filter: " + std::to_string(model.missing.size()) +
                                " designs for a missing sensor; expected one entry for each of the " +
                                std::to_string(model.D.rows()) + " sensors");
  }
  for (std::size_t i = 0; i < model.missing.size(); ++i) {
    if (!model.missing[i]) continue;
    const std::string set = "without sensor " + std::to_string(i) + ":";
    check_gain(set, *model.missing[i], model);
    check_tuner_structure(set, *model.missing[i], model.states);
  }
}

/// What a product starts from where nothing is to be added.
alignas(32) constexpr std::array<double, max_augmented> zeros{};

/// A product reads whole groups of rows.
template <typename Vector>
Vector with_zeros_behind(const Vector& vector) {
  Vector padded;
  padded.setZero(Vector::MaxRowsAtCompileTime);
  padded.conservativeResize(vector.size());
  padded = vector;
  return padded;
}

}  // namespace

TunerFilter::TunerFilter(TunerFilterModel model)
    : constants_(std::make_shared<const Constants>(constants_of(std::move(model)))) {
  innovation_.setZero(this->model().D.rows());
  fused_innovation_.setZero(this->model().D.rows());
  health_ = this->model().health_trim;
  auxiliary_ = this->model().auxiliary_trim;
  reset();
}

TunerFilter::Constants TunerFilter::constants_of(TunerFilterModel model) {
  check_model(model);
  Constants constants;
  constants.minus_D = PaddedMatrix(-model.D);
  constants.health_trim = with_zeros_behind(model.health_trim);
  constants.auxiliary_trim = with_zeros_behind(model.auxiliary_trim);
  constants.full_step = step_of(model.full, model);
  for (const auto& subset : model.missing) constants.missing_step.push_back(subset ? step_of(*subset, model) : Step{});
  constants.model = std::move(model);
  return constants;
}

TunerFilter::Step TunerFilter::step_of(const SubsetGain& gain, const TunerFilterModel& model) {
  const Eigen::Index a = gain.A.rows(), nu = model.D.cols();
  Eigen::MatrixXd prediction(a, a + nu), auxiliary(model.G.rows(), a + nu);
  prediction << gain.A, gain.B;
  auxiliary << gain.auxiliary_output, model.G;
  Step step;
  step.state_prediction = PaddedMatrix(prediction);
  step.sensor_prediction = PaddedMatrix(-gain.C * prediction);
  step.correction = PaddedMatrix(gain.K);
  step.health = PaddedMatrix(gain.health_output.rightCols(a - model.states));
  step.auxiliary = PaddedMatrix(auxiliary);
  return step;
}

void TunerFilter::predict(const ActuatorVector& du_previous) noexcept {
  // xpred = Axq xhat[k-1] + Bxq u[k-1] and what the sensors should then read
  const double *xhat = updated_.data(), *u = du_previous.data();
  const Eigen::Index size = updated_.size();
  step().state_prediction.product(zeros.data(), xhat, size, u, predicted_.data());
  step().sensor_prediction.product(zeros.data(), xhat, size, u, minus_sensors_.data());
}

void TunerFilter::innovation(const SensorVector& dy, const ActuatorVector& du) noexcept {
  // nu = y[k] - Cxq xpred - D u[k]
  du_ = du;
  constants_->minus_D.product(minus_sensors_.data(), du.data(), du.size(), nullptr, innovation_.data());
  innovation_ += dy;
}

void TunerFilter::update(SensorMask fused) noexcept {
  // Chosen, not multiplied by zero: a sensor without a value has NaN here.
  const SensorMask used = fused & gain().sensors;
  for (Eigen::Index i = 0; i < innovation_.size(); ++i) {
    fused_innovation_(i) = used[as_size(i)] ? innovation_(i) : 0.0;
  }
  if (carried_share_ > 0.0) carried_share_ -= carried_share_ * fading_;
  // xhat = xpred + K nu
  step().correction.product(predicted_.data(), fused_innovation_.data(), fused_innovation_.size(), nullptr,
                            updated_.data());
  read_out();
}

bool TunerFilter::switch_sensor_set(SensorSet set) noexcept {
  if (!available(set)) return false;
  if (set == set_) return true;
  drop_carried();
  // Through the full set: exact, because each step keeps the predicted sensors of the smaller set.
  if (!set_.is_full()) {
    re_reference(gain().to_full);
    set_ = SensorSet::full();
  }
  if (!set.is_full()) {
    set_ = set;
    re_reference(gain().from_full);
  }
  read_out();
  return true;
}

void TunerFilter::re_reference(const BoundedMatrix<max_augmented, max_augmented>& transfer) noexcept {
  predicted_.noalias() = transfer.lazyProduct(updated_);
  updated_ = predicted_;
}

void TunerFilter::shift(const AugmentedVector& delta) noexcept {
  updated_ += delta;
  read_out();
}

void TunerFilter::carry(const HealthVector& health, const AuxiliaryVector& auxiliary, double fading) noexcept {
  drop_carried();
  carried_health_ = health - health_;
  carried_auxiliary_ = auxiliary - auxiliary_;
  carried_share_ = 1.0;
  fading_ = fading;
  read_out();
}

void TunerFilter::drop_carried() noexcept {
  carried_share_ = 0.0;
  read_out();
}

bool TunerFilter::restore(SensorSet set, const AugmentedVector& estimate) noexcept {
  if (!available(set)) return false;
  const SensorSet before = set_;
  set_ = set;
  if (estimate.size() != gain().A.rows()) {
    set_ = before;
    return false;
  }
  carried_share_ = 0.0;
  updated_ = estimate;
  du_.setZero();
  innovation_.setZero();
  read_out();
  return true;
}

void TunerFilter::reset() noexcept {
  carried_share_ = 0.0;
  set_ = SensorSet::full();
  updated_.setZero(model().full.A.rows());
  du_.setZero(model().D.cols());
  innovation_.setZero();
  read_out();
}

bool TunerFilter::available(SensorSet set) const noexcept {
  if (set.is_full()) return true;
  const auto i = as_size(set.missing());
  return i < model().missing.size() && model().missing[i].has_value();
}

void TunerFilter::read_out() noexcept {
  // h = h_trim + W q, of Th = [0, W]
  const double* q = updated_.data() + model().states;
  step().health.product(constants_->health_trim.data(), q, updated_.size() - model().states, nullptr, health_.data());
  // z = z_trim + Tz xhat + G u[k]
  step().auxiliary.product(constants_->auxiliary_trim.data(), updated_.data(), updated_.size(), du_.data(),
                           auxiliary_.data());
  if (carried_share_ > 0.0) {
    health_ += carried_share_ * carried_health_;
    auxiliary_ += carried_share_ * carried_auxiliary_;
  }
}

}  // namespace ehm::estimation
