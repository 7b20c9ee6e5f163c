// SPDX-License-Identifier: Apache-2.0
#pragma once
// A companion that does as it is told, for tests of what the cycle makes of it.

#include <memory>
#include <utility>

#include "monitor/estimation/estimator.h"

namespace ehm::test {

/// Answers while it is told to; its health is the same of everything, its innovations are 0.
class Moody final : public estimation::Estimator {
 public:
  explicit Moody(std::shared_ptr<const bool> answers, double health = 0.5)
      : answers_(std::move(answers)), health_(health) {
    estimate_.health.setConstant(10, health);
    estimate_.health_sigma.setConstant(10, 0.5);
    estimate_.health_sigma_filter = estimate_.health_sigma;
    estimate_.auxiliary.setConstant(4, 1.0);
    estimate_.auxiliary_sigma = estimate_.auxiliary_sigma_filter = estimate_.auxiliary;
    innovation_.value.setZero(7);
    innovation_.variance.setOnes(7);
  }
  [[nodiscard]] std::unique_ptr<Estimator> clone() const override { return std::make_unique<Moody>(answers_, health_); }
  void reset() noexcept override {}
  bool use(estimation::SensorMask) noexcept override { return true; }
  void predict(const estimation::Conditions&, int) noexcept override {}
  void innovate(const estimation::SensorVector&, const estimation::Conditions&) noexcept override {}
  void update(estimation::SensorMask, std::int64_t) noexcept override { estimate_.holds = *answers_; }
  void widen(double) noexcept override {}
  void save(estimation::EstimatorState&) const noexcept override {}
  bool restore(const estimation::EstimatorState&) noexcept override { return false; }
  [[nodiscard]] double distance(const estimation::Conditions&) const noexcept override { return 0.0; }
  [[nodiscard]] const estimation::Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const estimation::Estimate& estimate() const noexcept override { return estimate_; }

 private:
  std::shared_ptr<const bool> answers_;
  double health_;
  estimation::Estimate estimate_;
  estimation::Innovation innovation_;
};

}  // namespace ehm::test
