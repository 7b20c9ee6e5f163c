// SPDX-License-Identifier: Apache-2.0
#pragma once
// Any estimator, and what no sensor tells but everybody knows: no health parameter gets better by itself
// (health_constraint.h). After each update of the one inside, with its estimate xhat of health and the covariance P of
// that, the published health is
//
//   projection            the nearest point of the box by W = P^-1 (box_projection.h)
//   projection_identity   the nearest by W = I: the clamp; also where P has no way into the box
//   truncation            the mean of N(xhat, P) inside the box (truncated_gaussian.h)
//
// and the box closes on it, `margin_sigma` of the sigma inside behind, as soon as the one inside has settled: a start,
// whose first estimates are noise, binds nobody. The sigma of a projection is that of the one inside, since it says
// nothing of its own; that of the truncation is the truncated Gaussian's. Auxiliary outputs, innovations and the
// filter's own sigma are those of the one inside; where the constrained health feeds back (Estimator::correct_health)
// they follow it from the next sample on.
//
// **The ratchet.** The box is made of noisy estimates and only ever closes: without a margin the estimate is biased the
// way of wear, and where it feeds back the more so, since the filter forgets what it saw against it. A truncated mean
// lies always before its bound, so that a bound at that mean runs away by itself: it needs a margin, and must not feed
// back, which would count the same constraint again at every sample (theory.md, "Constrained filters", has the
// figures). A reset, a start from a known engine, and with them maintenance open the box.
//
// Source: Simon & Simon, ASME GT2003-38584; Int. J. of Systems Science 41 (2010). Errors: none after construction.
// Real-time safe: yes, all but construction and clone().

#include <memory>

#include "monitor/estimation/constrained/health_constraint.h"
#include "monitor/estimation/estimator.h"

namespace ehm::estimation {

enum class ConstraintWay { projection, projection_identity, truncation };

struct ConstrainedOptions {
  ConstraintWay way = ConstraintWay::projection;
  bool feeds_back = false;
  double margin_sigma = 3.0;
  HealthVector direction;  ///< health_constraint.h, p
};

class ConstrainedEstimator final : public Estimator {
 public:
  ConstrainedEstimator(std::unique_ptr<Estimator> inner, const ConstrainedOptions& options);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(SensorMask available) noexcept override;
  void predict(const Conditions& before, int steps) noexcept override { inner_->predict(before, steps); }
  void innovate(const SensorVector& y, const Conditions& now) noexcept override { inner_->innovate(y, now); }
  void update(SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(EstimatorState& state) const noexcept override;
  bool restore(const EstimatorState& state) noexcept override;
  [[nodiscard]] Learned learned() const noexcept override { return inner_->learned(); }
  bool begin_with(const Learned& known, double wear_percent) noexcept override;
  void next_flight(double wear_percent) noexcept override { inner_->next_flight(wear_percent); }
  [[nodiscard]] SensorSpan span() const noexcept override { return inner_->span(); }
  [[nodiscard]] double distance(const Conditions& conditions) const noexcept override {
    return inner_->distance(conditions);
  }
  [[nodiscard]] const Innovation& innovation() const noexcept override { return inner_->innovation(); }
  [[nodiscard]] const Estimate& estimate() const noexcept override { return estimate_; }

  [[nodiscard]] const HealthConstraint& constraint() const noexcept { return constraint_; }

 private:
  void start() noexcept;
  void constrain() noexcept;
  void publish(const HealthVector& health) noexcept;

  std::unique_ptr<Estimator> inner_;
  ConstrainedOptions options_;
  HealthConstraint constraint_;
  bool bound_ = false;        ///< the box has closed on an estimate
  HealthVector sigma_share_;  ///< of the sigma inside, that the constraint leaves
  Estimate estimate_;
};

}  // namespace ehm::estimation
