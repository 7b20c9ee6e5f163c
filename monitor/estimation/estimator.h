// SPDX-License-Identifier: Apache-2.0
#pragma once
// The seam between the data path and whatever estimates: one engine, one sample after another, in absolute channel
// units. Trims, the point where its model holds, and the theory of its error are the estimator's own affair.
//
//   before each sample    use(available)       which sensors may teach it; false: it has no answer without the others
//   for each sample       predict(before, steps) -> innovate(y, now) -> update(fused, hold) -> estimate()
//
// A sensor that is not fused is left out of this update; one that is not available is left out for longer, and may get
// a design of its own. After reset() it is as newly made. All of it is noexcept and allocates nothing, and what cannot
// be answered is a value. The same calls give the same bits. Made by design/make_estimator.h, which has the table of
// all of them; tests/unit/monitor/estimation/estimator_test.cpp is the suite that each must pass.

#include <cstdint>
#include <memory>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/estimate.h"
#include "monitor/estimation/estimator_state.h"
#include "monitor/estimation/learned.h"

namespace ehm::estimation {

/// What acted on the engine at a sample.
struct Conditions {
  linear_model::OperatingPoint flight;
  ActuatorVector actuators;  ///< absolute, channel units
};

/// Of all m sensors, sensor units and their squares. Not masked: NaN where there is no value.
struct Innovation {
  SensorVector value, variance;
  SensorVector noise = {};  ///< of the variance what the noise of a single reading is; of length 0: all of it
};

/// The least and the greatest reading of each sensor wherever an estimator holds, sensor units; of length 0: those at
/// its point, the trims.
struct SensorSpan {
  SensorVector least, greatest;
};

class Estimator {
 public:
  virtual ~Estimator() = default;
  /// A new one of the same design, which shares its constants. Allocates.
  [[nodiscard]] virtual std::unique_ptr<Estimator> clone() const = 0;

  /// Cold start, with all sensors.
  virtual void reset() noexcept = 0;
  /// Chooses what to estimate with. False: no design for these sensors; the last one goes on.
  virtual bool use(SensorMask available) noexcept = 0;
  /// `steps` samples further, of which all but the last are lost; the actuators were held as `before`.
  virtual void predict(const Conditions& before, int steps) noexcept = 0;
  /// How far the measured sensors are from the predicted ones.
  virtual void innovate(const SensorVector& y, const Conditions& now) noexcept = 0;
  /// Takes in those sensors. `hold`: the longest time, in samples, for which a sensor repeats its value without the
  /// design knowing, 1 for most; the error then falls more slowly by as much.
  virtual void update(SensorMask fused, std::int64_t hold) noexcept = 0;
  /// The engine stands beyond the fleet: the sigmas of what the fleet's spread told are too small by sqrt(excess)
  /// (diagnosis/fleet_watch.h). 1: within it.
  virtual void widen(double excess) noexcept = 0;

  /// What it goes on from, after a sample.
  virtual void save(EstimatorState& state) const noexcept = 0;
  /// Goes on from there as if nothing had been between: the next sample gives the bits that it would have given.
  /// estimate() holds from then on. False, and nothing is changed, if the state is not of this estimator and design.
  virtual bool restore(const EstimatorState& state) noexcept = 0;

  /// What this flight has taught so far of the very engine and holds beyond it; empty: this estimator keeps nothing.
  [[nodiscard]] virtual Learned learned() const noexcept { return {}; }
  /// Starts anew, now and whenever it starts cold, from what is known of this very engine, with wear of that standard
  /// deviation since. False, and nothing is changed, if it is not of this estimator's shape.
  virtual bool begin_with(const Learned& known, double wear_percent) noexcept {
    static_cast<void>(known);
    static_cast<void>(wear_percent);
    return false;
  }
  /// A flight is over: it goes on, and what may be otherwise in the next one becomes less certain, health by wear of
  /// that standard deviation. A cold start from now on begins with what the flight has taught.
  virtual void next_flight(double wear_percent) noexcept { static_cast<void>(wear_percent); }

  /// Covariance of the whole error of health over the fleet, channel units squared: health_sigma squared is its
  /// diagonal. Of size 0: not known.
  [[nodiscard]] virtual HealthCovariance health_covariance() const noexcept { return {}; }
  /// Goes on from health, channel units, that something beside the sensors has corrected (constrained/): what its own
  /// covariance says is correlated moves along, and the covariance stays. False, and nothing is changed: it cannot hold
  /// any health whatever.
  virtual bool correct_health(const HealthVector& health) noexcept {
    static_cast<void>(health);
    return false;
  }

  /// What healthy sensors read where it holds.
  [[nodiscard]] virtual SensorSpan span() const noexcept { return {}; }
  /// How far the conditions are from where the model holds, in tolerances; above 1 it extrapolates.
  [[nodiscard]] virtual double distance(const Conditions& conditions) const noexcept = 0;
  [[nodiscard]] virtual const Innovation& innovation() const noexcept = 0;
  [[nodiscard]] virtual const Estimate& estimate() const noexcept = 0;

 protected:
  Estimator() = default;
  Estimator(const Estimator&) = default;
  Estimator& operator=(const Estimator&) = default;
};

}  // namespace ehm::estimation
