// SPDX-License-Identifier: Apache-2.0
#pragma once
// The full-order Gauss-Markov filter as an Estimator: it follows changes of health for ever, with one time constant for
// what the sensors see, and forgets what they do not see within its memory. The theory of its total error is that of
// error_propagation.h with its own A and K. Its state [x; h] means the same for every set of sensors, so that a change
// of the set carries nothing over but the gain.

#include <memory>
#include <optional>
#include <vector>

#include "monitor/estimation/channel_units.h"
#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/estimator.h"
#include "monitor/estimation/gauss_markov_filter.h"
#include "monitor/estimation/point_distance.h"

namespace ehm::estimation {

/// Its constants for one set of sensors; scaled units.
struct GaussMarkovSet {
  SensorMask sensors;
  std::shared_ptr<const GaussMarkovGain> gain;
  ErrorModel error;
  HealthVector health_sigma_filter;        ///< of the filter's own covariance, channel units
  AuxiliaryVector auxiliary_sigma_filter;  ///< the same
};

struct GaussMarkovModel {
  std::shared_ptr<const FullOrderModel> model;      ///< scaled
  std::vector<std::optional<GaussMarkovSet>> sets;  ///< [0] all sensors, [1 + i] without sensor i, if that sees enough
  ChannelUnits units;
};

class GaussMarkovEstimator final : public Estimator {
 public:
  GaussMarkovEstimator(std::shared_ptr<const GaussMarkovModel> model, const PointDistance& distance);

  [[nodiscard]] std::unique_ptr<Estimator> clone() const override;
  void reset() noexcept override;
  bool use(SensorMask available) noexcept override;
  void predict(const Conditions& before, int steps) noexcept override;
  void innovate(const SensorVector& y, const Conditions& now) noexcept override;
  void update(SensorMask fused, std::int64_t hold) noexcept override;
  void widen(double excess) noexcept override;
  void save(EstimatorState& state) const noexcept override;
  bool restore(const EstimatorState& state) noexcept override;
  [[nodiscard]] HealthCovariance health_covariance() const noexcept override { return error_.health_covariance(); }
  /// The state moves as the balance of the engine does, by (I-A)^-1 L dh.
  bool correct_health(const HealthVector& health) noexcept override;
  [[nodiscard]] double distance(const Conditions& conditions) const noexcept override {
    return distance_.of(conditions);
  }
  [[nodiscard]] const Innovation& innovation() const noexcept override { return innovation_; }
  [[nodiscard]] const Estimate& estimate() const noexcept override { return estimate_; }

 private:
  const GaussMarkovSet& set() const noexcept { return *model_->sets[set_]; }
  void read_out() noexcept;
  void read_out_sigmas() noexcept;

  std::shared_ptr<const GaussMarkovModel> model_;
  std::size_t set_ = 0;
  GaussMarkovFilter filter_;
  ErrorPropagation error_;
  PointDistance distance_;
  ActuatorVector du_;
  std::int64_t held_samples_ = 0;  ///< since the error's theory went on
  Innovation innovation_;
  Estimate estimate_;
};

}  // namespace ehm::estimation
