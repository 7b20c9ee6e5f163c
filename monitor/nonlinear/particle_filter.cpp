// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/particle_filter.h"

#include <utility>

#include "deploy/runtime/numbers/index.h"

namespace ehm::nonlinear {

ParticleFilter::ParticleFilter(FilterNoise noise, ParticleOptions options)
    : noise_(std::move(noise)),
      options_(options),
      cloud_(options.particles, noise_.process_variance.size(), options.seed),
      answered_(decltype(answered_)::Constant(options.particles, true)),
      readings_(Eigen::MatrixXd::Zero(options.particles, estimation::max_sensors)) {
  const Eigen::Index n = noise_.process_variance.size();
  start(OrderVector::Zero(n), OrderMatrix::Zero(n, n));
}

std::unique_ptr<NonlinearFilter> ParticleFilter::clone() const {
  return std::make_unique<ParticleFilter>(noise_, options_);
}

void ParticleFilter::start(const OrderVector& x, const OrderMatrix& covariance) noexcept {
  cloud_.restart();
  x_ = x;
  p_ = covariance;
  if (cloud_.draw(x, covariance)) return;
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) cloud_.set(i, x);  // known, or nearly so
}

bool ParticleFilter::foresee(StateSpace& model, const SensorVector& sigma) noexcept {
  const Eigen::Index m = sigma.size();
  predicted_.setZero(m);
  double answered = 0.0;  // of the weights
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    readings_.row(i).setZero();
    answered_(i) = model.respond(cloud_.state(i), response_);
    if (!answered_(i)) continue;
    readings_.row(i).head(m) = response_.readings.transpose();
    predicted_ += cloud_.weight(i) * response_.readings;
    answered += cloud_.weight(i);
  }
  if (answered == 0.0) return false;
  predicted_ /= answered;
  sigma_ = sigma;
  innovation_variance_ = sigma.cwiseAbs2();
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    if (!answered_(i)) continue;
    const SensorVector d = readings_.row(i).head(m).transpose() - predicted_;
    innovation_variance_ += cloud_.weight(i) / answered * d.cwiseAbs2();
  }
  return true;
}

bool ParticleFilter::update(StateSpace&, const SensorVector& innovation, SensorMask fused) noexcept {
  for (Eigen::Index i = 0; i < cloud_.count(); ++i)
    if (!answered_(i)) cloud_.discard(i);
  for (Eigen::Index s = 0; s < innovation.size(); ++s) {
    if (!fused[as_size(s)]) continue;
    for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
      const double e = (innovation(s) - (readings_(i, s) - predicted_(s))) / sigma_(s);
      cloud_.add_log_weight(i, -0.5 * e * e);
    }
  }
  if (!cloud_.normalise()) return false;
  x_ = cloud_.mean();
  p_ = cloud_.covariance(x_);
  cloud_.resample_if_needed();
  return true;
}

bool ParticleFilter::advance(StateSpace& model) noexcept {
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    // a particle whose engine has no answer stays where it is
    if (model.respond(cloud_.state(i), response_)) cloud_.set(i, response_.next);
  }
  cloud_.scatter(noise_.process_variance);
  x_ = cloud_.mean();
  p_ = cloud_.covariance(x_);
  return true;
}

}  // namespace ehm::nonlinear
