// SPDX-License-Identifier: Apache-2.0
#pragma once
// What engine_sim flies, as its loop sees it: the channels, one sample after another, and the orders that it takes
// between two samples. No clock, no DDS. Simulation is the nonlinear turbofan, LinearEngine a model of the user's own.
//
// @throws std::invalid_argument from an order that this engine cannot follow: which, and why.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine_sim/model/gas_path.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/sensors/sensor.h"

namespace ehm::engine_sim {

struct EngineChannel {
  std::string name, unit;
  double trim = 0.0;   ///< in `unit`
  double sigma = 0.0;  ///< noise of a sensor, in `unit`; 0 for others
};

struct EngineChannels {
  std::string engine_type;
  double sample_time_s = 0.0;
  std::vector<EngineChannel> actuators, sensors, health, auxiliary;
};

/// Absolute values in the channels' order and units.
struct EngineSample {
  std::uint64_t sequence = 0;
  FlightCondition flight;
  std::vector<double> actuators;
  std::vector<Reading> sensors;
  std::vector<double> health, auxiliary;  ///< the truth
};

struct HealthRange {
  double least, most;
};

class SimulatedEngine {
 public:
  virtual ~SimulatedEngine() = default;

  virtual const EngineChannels& channels() const = 0;
  /// For the log: what flies, and where.
  virtual std::string start_text() const = 0;
  /// How the engine that flies differs from its file, by cause (mismatch/mismatch.h); empty where there is no file.
  virtual std::span<const double> mismatch() const { return {}; }
  virtual double time_s() const = 0;
  virtual EngineSample next_sample() = 0;

  virtual void demand(const Demand& demand) = 0;
  /// The most that a demand of net thrust can get where the engine flies now.
  virtual double most_net_thrust_n() const = 0;
  virtual bool can_fly(const FlightCondition& flight) const = 0;
  virtual void fly(const FlightCondition& flight) = 0;
  /// In which an order may move this health parameter, in its unit.
  virtual HealthRange health_range(std::size_t parameter) const = 0;
  /// What an order moves it from: without process noise that is gone with its sample.
  virtual double health_of(std::size_t parameter) const = 0;
  virtual bool can_wear(std::size_t parameter, double target, double ramp_s) const = 0;
  virtual void order_health(std::size_t parameter, double target, double ramp_s) = 0;
  virtual void inject(std::size_t sensor, const SensorFault& fault) = 0;
};

}  // namespace ehm::engine_sim
