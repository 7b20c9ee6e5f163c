// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/lu/lu_flight.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/solve/transient.h"
#include "monitor/nonlinear/engine_state_space.h"
#include "monitor/nonlinear/extended_filter.h"
#include "monitor/nonlinear/extended_particle_filter.h"
#include "monitor/nonlinear/unscented_filter.h"
#include "monitor/onboard/engine_channels.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;
using namespace nonlinear;
using estimation::SensorVector;

constexpr int judged_samples = 100, fault_at = 50;
constexpr int most_lost = 25;
constexpr double most_error_percent = 15.0, box_margin = 1.1;
constexpr double speed_noise_percent = 0.05;

/// Two speeds, and the health.
OrderVector stacked(double speeds, const LuHealth& health) {
  OrderVector x(onboard::speed_count + as_index(lu_health_count));
  x << speeds, speeds, health;
  return x;
}

std::unique_ptr<NonlinearFilter> make_filter(const LuFlight& flight) {
  const auto square = [](double x) { return x * x; };
  const FilterNoise noise{stacked(square(speed_noise_percent), LuHealth::Constant(square(lu_health_noise_percent)))};
  const ParticleOptions cloud{flight.particles, flight.seed + 7919 * (flight.run + 1)};
  ExtendedParticleOptions particles{
      .cloud = cloud,
      .weights = flight.ratio_weights ? ParticleWeights::ratio : ParticleWeights::likelihood,
      .jacobian = flight.own_jacobian ? ParticleJacobian::own : ParticleJacobian::shared,
      .box = {}};
  switch (flight.filter) {
    case LuFilter::extended:
      return std::make_unique<ExtendedFilter>(noise, ExtendedOptions{});
    case LuFilter::unscented:
      return std::make_unique<UnscentedFilter>(noise, UnscentedOptions{});
    case LuFilter::particle:
      return std::make_unique<ParticleFilter>(noise, cloud);
    case LuFilter::extended_particle:
      break;
    case LuFilter::boxed_particle: {
      // it knows the size of the fault: their constraint, two-sided here
      const LuHealth reach = box_margin * lu_most_wear().cwiseAbs().cwiseMax(lu_fault(flight.fault).cwiseAbs());
      const OrderVector bound = stacked(std::numeric_limits<double>::infinity(), reach);
      particles.box = StateBox{-bound, bound};
    }
  }
  return std::make_unique<ExtendedParticleFilter>(noise, particles);
}

/// The nonlinear engine, its fuel and nozzle held.
class Truth {
 public:
  Truth(const LuEngine& engine, const LuFlight& flight)
      : engine_(engine),
        channels_(engine.model),
        noise_(flight.noise),
        random_(flight.seed, flight.run),
        operation_(engine.trim.operation),
        transient_(engine.model->engine(), engine.trim) {}

  /// The sensors at this sample, and on to the next.
  SensorVector next(const LuHealth& health) {
    for (std::size_t i = 0; i < lu_health_count; ++i)
      operation_.health[engine_.parameters[i]] =
          0.01 * (health(as_index(i)) + lu_health_noise_percent * deviate(noise_, random_));
    SensorVector y = channels_.readings(transient_.output(operation_));
    for (Eigen::Index i = 0; i < y.size(); ++i) y(i) += engine_.sigma(i) * random_.normal();
    constexpr int steps = static_cast<int>(lu_filter_step_s / lu_model_step_s + 0.5);
    for (int k = 0; k < steps; ++k) transient_.step(operation_, lu_model_step_s);
    return y;
  }

 private:
  const LuEngine& engine_;
  onboard::EngineChannels channels_;
  NoiseDistribution noise_;
  RandomStream random_;
  sim::Operation operation_;
  sim::Transient transient_;
};

/// Mean and spread of the error over a window.
struct Window {
  LuHealth sum = LuHealth::Zero(), squares = LuHealth::Zero();
  int count = 0;
  void take(const LuHealth& error) {
    sum += error;
    squares += error.cwiseAbs2();
    ++count;
  }
  LuHealth mean() const { return sum / count; }
  LuHealth sigma() const { return (squares / count - mean().cwiseAbs2()).cwiseMax(0.0).cwiseSqrt(); }
};

class Flight {
 public:
  Flight(const LuEngine& engine, const LuFlight& flight)
      : engine_(engine),
        flight_(flight),
        truth_(engine, flight),
        space_(engine.model, EngineStateSpace::Metal::without),
        filter_(make_filter(flight)) {
    for (std::size_t i = 0; i < lu_sensor_count; ++i) fused_.set(i);
    if (flight.missing_sensor) fused_.reset(*flight.missing_sensor);
    space_.set(engine.conditions);
    OrderVector x = stacked(0.0, LuHealth::Zero());
    const sim::SpoolSpeeds& speeds = engine.trim.gas.speeds;
    space_.start({speeds.n1_rpm, speeds.n2_rpm}, false, x);
    OrderVector p = stacked(speed_noise_percent * speed_noise_percent,
                            LuHealth::Constant(lu_health_noise_percent * lu_health_noise_percent));
    filter_->start(x, OrderMatrix(p.asDiagonal()));
  }

  LuScore run() {
    const int points = flight_.fault == 0 ? lu_gradual_points : 1;
    for (int point = 0; point < points && !score_.diverged; ++point) fly_point(point);
    score_.filter_s_per_s = filter_s_ / (static_cast<double>(samples_) * lu_filter_step_s);
    return score_;
  }

 private:
  void fly_point(int point) {
    Window window;
    for (int k = 0; k < lu_samples_a_point && !score_.diverged; ++k, ++samples_) {
      const LuHealth health = lu_truth(flight_.fault, point * lu_samples_a_point + k);
      take(truth_.next(health));
      const LuHealth error = estimate_ - health;
      score_.estimates.push_back(estimate_);
      if (!(error.cwiseAbs().maxCoeff() < most_error_percent)) score_.diverged = k >= 2 * fault_at;
      if (k >= lu_samples_a_point - judged_samples) window.take(error);
    }
    if (score_.diverged) return;
    score_.mean = window.mean();
    score_.sigma = window.sigma();
    score_.sme += score_.mean.cwiseAbs().sum();
  }

  void take(const SensorVector& y) {
    const auto began = std::chrono::steady_clock::now();
    bool answered = (flight_.filter == LuFilter::extended || space_.refer(filter_->estimate())) &&
                    filter_->foresee(space_, engine_.sigma) &&
                    filter_->update(space_, y - filter_->predicted(), fused_);
    estimate_ = filter_->estimate().tail<lu_health_count>();
    answered = filter_->advance(space_) && answered;
    filter_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    lost_ = answered ? 0 : lost_ + 1;
    if (lost_ > most_lost) score_.diverged = true;
  }

  const LuEngine& engine_;
  const LuFlight& flight_;
  Truth truth_;
  EngineStateSpace space_;
  std::unique_ptr<NonlinearFilter> filter_;
  SensorMask fused_;
  LuHealth estimate_ = LuHealth::Zero();
  LuScore score_;
  double filter_s_ = 0.0;
  int samples_ = 0, lost_ = 0;
};

}  // namespace

LuHealth lu_truth(int fault, int sample) {
  if (fault != 0) return sample < fault_at ? LuHealth::Zero().eval() : lu_fault(fault);
  return lu_most_wear() * (sample / lu_samples_a_point) / (lu_gradual_points - 1);
}

LuScore fly_lu(const LuEngine& engine, const LuFlight& flight) {
  return Flight(engine, flight).run();
}

}  // namespace ehm::tuner_design
