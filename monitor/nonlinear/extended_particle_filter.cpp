// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/extended_particle_filter.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/nonlinear/scalar_update.h"

namespace ehm::nonlinear {

bool ExtendedParticleFilter::Density::factorise(const OrderMatrix& covariance) noexcept {
  const Eigen::LLT<OrderMatrix> llt(covariance);
  if (llt.info() != Eigen::Success) return false;
  factor = llt.matrixL();
  log_volume = factor.diagonal().array().log().sum();
  return true;
}

double ExtendedParticleFilter::Density::log_of(const OrderVector& deviation) const noexcept {
  const OrderVector z = factor.triangularView<Eigen::Lower>().solve(deviation);
  return -0.5 * z.squaredNorm() - log_volume;
}

ExtendedParticleFilter::ExtendedParticleFilter(FilterNoise noise, ExtendedParticleOptions options)
    : noise_(std::move(noise)),
      options_(std::move(options)),
      cloud_(options_.cloud.particles, noise_.process_variance.size(), options_.cloud.seed),
      proposals_(own() ? as_size(options_.cloud.particles) : 1),
      spare_proposals_(own() ? proposals_.size() : 0),
      answered_(decltype(answered_)::Constant(options_.cloud.particles, true)),
      readings_(Eigen::MatrixXd::Zero(options_.cloud.particles, estimation::max_sensors)),
      next_(Eigen::MatrixXd::Zero(options_.cloud.particles, noise_.process_variance.size())),
      spare_next_(next_) {
  if (!(noise_.process_variance.array() > 0.0).all())
    throw std::invalid_argument("an extended Kalman particle filter needs process noise on every state");
  const Eigen::Index n = noise_.process_variance.size();
  start(OrderVector::Zero(n), OrderMatrix::Zero(n, n));
}

std::unique_ptr<NonlinearFilter> ExtendedParticleFilter::clone() const {
  return std::make_unique<ExtendedParticleFilter>(noise_, options_);
}

/// All begin at the mean, and the first draw is from what is known then.
void ExtendedParticleFilter::start(const OrderVector& x, const OrderMatrix& covariance) noexcept {
  cloud_.restart();
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) cloud_.set(i, x);
  x_ = x;
  p_ = covariance;
  for (Proposal& p : proposals_) p.prior = p.posterior = covariance;
  transition_ = covariance;
  moved_ = false;
}

void ExtendedParticleFilter::open(const OrderVector& variance) noexcept {
  for (Proposal& p : proposals_) {
    p.prior.diagonal() += variance;
    p.posterior.diagonal() += variance;
  }
  p_.diagonal() += variance;
  transition_.diagonal() += variance;
}

bool ExtendedParticleFilter::foresee(StateSpace& model, const SensorVector& sigma) noexcept {
  const Eigen::Index m = sigma.size();
  // the shared Jacobian is that of the mean
  if (!own() && !model.respond(x_, response_, proposals_.front().slopes)) return false;
  sigma_ = sigma;
  predicted_.setZero(m);
  double answered = 0.0;
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    readings_.row(i).setZero();
    answered_(i) = own() ? model.respond(cloud_.state(i), response_, proposal(i).slopes)
                         : model.respond(cloud_.state(i), response_);
    if (!answered_(i)) continue;
    readings_.row(i).head(m) = response_.readings.transpose();
    predicted_ += cloud_.weight(i) * response_.readings;
    answered += cloud_.weight(i);
  }
  if (answered == 0.0) return false;
  predicted_ /= answered;
  innovation_variance_ = sigma.cwiseAbs2();
  const Proposal& of_first = proposals_.front();
  for (Eigen::Index s = 0; s < m; ++s)
    innovation_variance_(s) += of_first.slopes.g.row(s) * of_first.prior * of_first.slopes.g.row(s).transpose();
  return true;
}

/// K by one sensor after the other: each column is corrected by those that come after it.
bool ExtendedParticleFilter::make_gain(Proposal& p, SensorMask fused) const noexcept {
  const Eigen::Index n = x_.size(), m = sigma_.size();
  p.posterior = p.prior;
  p.gain.setZero(n, m);
  for (Eigen::Index s = 0; s < m; ++s) {
    if (!fused[as_size(s)]) continue;
    const OrderVector row = p.slopes.g.row(s).transpose();
    const OrderVector k = take_in(row, sigma_(s) * sigma_(s), p.posterior);
    for (Eigen::Index before = 0; before < s; ++before) p.gain.col(before) -= k * row.dot(p.gain.col(before));
    p.gain.col(s) = k;
  }
  return p.density.factorise(p.posterior);
}

OrderVector ExtendedParticleFilter::into_box(const OrderVector& drawn, const OrderVector& before) const noexcept {
  if (!options_.box) return drawn;
  const StateBox& box = *options_.box;
  if ((drawn.array() >= box.least.array()).all() && (drawn.array() <= box.greatest.array()).all()) return drawn;
  return (0.5 * (drawn + before)).cwiseMax(box.least).cwiseMin(box.greatest);
}

double ExtendedParticleFilter::log_likelihood(const SensorVector& readings, const SensorVector& innovation,
                                              SensorMask fused) const noexcept {
  double sum = 0.0;
  for (Eigen::Index s = 0; s < innovation.size(); ++s) {
    if (!fused[as_size(s)]) continue;
    const double e = (innovation(s) - (readings(s) - predicted_(s))) / sigma_(s);
    sum -= 0.5 * e * e;
  }
  return sum;
}

bool ExtendedParticleFilter::draw_particle(StateSpace& model, Eigen::Index i, const SensorVector& innovation,
                                           SensorMask fused, const Density& transition) noexcept {
  const Proposal& p = proposal(i);
  const OrderVector before = cloud_.state(i);
  SensorVector left = SensorVector::Zero(innovation.size());
  for (Eigen::Index s = 0; s < left.size(); ++s)
    if (fused[as_size(s)]) left(s) = innovation(s) - (readings_(i, s) - predicted_(s));
  const OrderVector mean = before + p.gain * left;
  const OrderVector x = into_box(mean + p.density.factor * cloud_.normal_vector(), before);
  if (!model.respond(x, response_)) return false;
  double log_weight = log_likelihood(response_.readings, innovation, fused);
  if (options_.weights == ParticleWeights::ratio)
    log_weight += transition.log_of(x - before) - p.density.log_of(x - mean);
  cloud_.add_log_weight(i, log_weight);
  cloud_.set(i, x);
  next_.row(i) = response_.next.transpose();
  return true;
}

bool ExtendedParticleFilter::update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept {
  for (Proposal& p : proposals_)
    if (!make_gain(p, fused)) return false;
  Density transition;
  if (!transition.factorise(transition_)) return false;
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    if (cloud_.discarded(i)) continue;
    if (!answered_(i) || !draw_particle(model, i, innovation, fused, transition)) cloud_.discard(i);
  }
  if (!cloud_.normalise()) return false;
  x_ = cloud_.mean();
  p_ = cloud_.covariance(x_);
  moved_ = true;
  if (cloud_.resample_if_needed()) follow_resampling();
  return true;
}

void ExtendedParticleFilter::follow_resampling() noexcept {
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) spare_next_.row(i) = next_.row(cloud_.sources()[as_size(i)]);
  next_.swap(spare_next_);
  if (!own()) return;
  for (std::size_t i = 0; i < proposals_.size(); ++i) spare_proposals_[i] = proposals_[as_size(cloud_.sources()[i])];
  proposals_.swap(spare_proposals_);
}

bool ExtendedParticleFilter::advance(StateSpace& model) noexcept {
  for (Eigen::Index i = 0; i < cloud_.count(); ++i) {
    if (cloud_.discarded(i)) continue;
    if (!moved_) {
      if (!model.respond(cloud_.state(i), response_)) continue;  // it stays where it is
      next_.row(i) = response_.next.transpose();
    }
    cloud_.set(i, next_.row(i).transpose());
  }
  for (Proposal& p : proposals_) {
    p.prior = carried(p.slopes.f, p.posterior, noise_.process_variance);
    p.posterior = p.prior;
  }
  transition_ = noise_.process_variance.asDiagonal();
  moved_ = false;
  x_ = cloud_.mean();
  p_.diagonal() += noise_.process_variance;
  return true;
}

}  // namespace ehm::nonlinear
