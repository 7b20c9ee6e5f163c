// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/kalman_experiment.h"

#include <spdlog/fmt/fmt.h>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "monitor/design/make_error_model.h"
#include "monitor/design/make_filter.h"
#include "monitor/diagnosis/fleet_watch.h"
#include "monitor/estimation/error_propagation.h"
#include "tuner_design/monte_carlo/engine_average.h"
#include "tuner_design/monte_carlo/engine_motion.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

using estimation::AuxiliaryVector;
using estimation::HealthVector;
using estimation::SensorVector;
using estimation::StateVector;

constexpr double sigmas_of_95_percent = 1.959963984540054;  // normal quantile of 0.975

/// What is published at one sample of the window, but for the engine's distance from the fleet.
struct Published {
  estimation::VarianceParts<estimation::max_health> health;
  estimation::VarianceParts<estimation::max_auxiliary> auxiliary;
};

std::vector<Published> published_in(const Window& window, const estimation::ErrorModel& model) {
  estimation::ErrorPropagation error(model);
  std::vector<Published> published;
  for (int k = 0; k < window.samples; ++k) {
    error.step();
    if (k >= window.first()) published.push_back({error.health_variance(), error.auxiliary_variance()});
  }
  return published;
}

/// Sums over a window of the squared errors of some channels and of how often they lay within the interval.
template <class Vector>
class WindowSums {
 public:
  explicit WindowSums(Eigen::Index channels)
      : squares_(Vector::Zero(channels)), within_(Vector::Zero(channels)), error_(Vector::Zero(channels)) {}

  template <class Error, class Interval>
  void add(const Error& error, const Interval& interval) {
    error_ = error;
    for (Eigen::Index i = 0; i < error_.size(); ++i) {
      squares_(i) += error_(i) * error_(i);
      within_(i) += std::abs(error_(i)) <= interval(i) ? 1.0 : 0.0;
    }
  }
  Eigen::VectorXd mean_square(const Eigen::VectorXd& scale, int samples) const {
    return squares_.cwiseQuotient(scale.cwiseAbs2()) / samples;
  }
  Eigen::VectorXd coverage(int samples) const { return within_ / samples; }

 private:
  Vector squares_, within_, error_;
};

class Flights {
 public:
  Flights(const design::Design& design, const Truth& truth, const KalmanOptions& options)
      : design_(design),
        truth_(truth),
        options_(options),
        filter_(design::make_filter(design)),
        motion_(discretise(design.model), options.process_noise),
        error_(design::make_error_model(design, design.full)),
        fleet_(monitor::fleet_table(design, design.full, error_)),
        published_(published_in(options.window, error_)) {}

  Eigen::Index size() const { return 2 * (channels() + 1); }
  Eigen::Index channels() const { return design_.model.L.cols() + design_.model.F.rows(); }

  /// One engine: [squared errors of h and z | their sums | coverage of h and z].
  bool fly(std::size_t index, Eigen::VectorXd& numbers) const {
    RandomStream random(options_.seed, index);
    HealthVector health(design_.model.health_sigma.size());
    for (Eigen::Index i = 0; i < health.size(); ++i)
      health(i) = options_.wear * design_.model.health_sigma(i) * random.normal();
    const std::optional<EngineInBalance> engine = truth_.engine(health);
    if (!engine) return false;

    estimation::TunerFilter filter = filter_;
    const HealthVector true_health = filter.model().health_trim + health;
    const AuxiliaryVector true_auxiliary = filter.model().auxiliary_trim + engine->auxiliary;
    WindowSums<HealthVector> health_sums(health.size());
    WindowSums<AuxiliaryVector> auxiliary_sums(true_auxiliary.size());
    StateVector dx = motion_.begin(random);
    for (int k = 0; k < options_.window.samples; ++k) {
      if (k > 0) motion_.advance(dx, random);
      step(filter, *engine, dx, random);
      const int in_window = k - options_.window.first();
      if (in_window < 0) continue;
      const Published& now_published = published_[as_size(in_window)];
      const double excess = fleet_.excess(fleet_.distance2(filter.tuners()));
      health_sums.add(filter.health() - true_health,
                      sigmas_of_95_percent * now_published.health.sigma(excess, error_.health_scale));
      AuxiliaryVector now = true_auxiliary;
      motion_.add_to_auxiliary(now, dx);
      auxiliary_sums.add(filter.auxiliary() - now,
                         sigmas_of_95_percent * now_published.auxiliary.sigma(excess, error_.auxiliary_scale));
    }
    const int samples = options_.window.averaged;
    const Eigen::VectorXd health_error = health_sums.mean_square(design_.scaling.health, samples);
    const Eigen::VectorXd auxiliary_error = auxiliary_sums.mean_square(design_.scaling.auxiliary, samples);
    numbers << health_error, auxiliary_error, health_error.sum(), auxiliary_error.sum(), health_sums.coverage(samples),
        auxiliary_sums.coverage(samples);
    return true;
  }

 private:
  /// One noisy sample into the filter.
  void step(estimation::TunerFilter& filter, const EngineInBalance& engine, const StateVector& dx,
            RandomStream& random) const {
    const Eigen::VectorXd& sigma = design_.model.sensor_noise_sigma;
    SensorVector dy = engine.sensors;
    for (Eigen::Index i = 0; i < dy.size(); ++i) dy(i) += sigma(i) * random.normal();
    motion_.add_to_sensors(dy, dx);
    filter.predict(engine.controls);
    filter.innovation(dy, engine.controls);
    filter.update(all_);
  }

  const design::Design& design_;
  const Truth& truth_;
  const KalmanOptions& options_;
  const estimation::TunerFilter filter_;
  const EngineMotion motion_;
  const estimation::ErrorModel error_;
  const monitor::FleetTable fleet_;
  const std::vector<Published> published_;
  const estimation::SensorMask all_ = ~estimation::SensorMask();
};

}  // namespace

Experiment kalman_experiment(const design::Design& design, const Truth& truth, const KalmanOptions& options,
                             const std::function<void(std::size_t)>& done) {
  const Flights flights(design, truth, options);
  const EngineAverage average = average_over_engines(
      options.runs, flights.size(), options.threads,
      [&](std::size_t index, Eigen::VectorXd& numbers) { return flights.fly(index, numbers); }, done);

  const Eigen::Index p = design.model.L.cols(), r = design.model.F.rows(), behind = p + r + 2;
  const auto by_channel = [&](const Eigen::VectorXd& numbers, Eigen::Index at) {
    return design::ErrorByChannel{numbers.segment(at, p), numbers.segment(at + p, r)};
  };
  Experiment result;
  result.estimator = "Kalman filter";
  result.truth = truth.description +
                 (options.wear == 1.0 ? "" : fmt::format(", health {:g} times wider than the fleet's", options.wear)) +
                 (options.process_noise ? ", with process noise w" : ", without process noise");
  result.nonlinear = truth.nonlinear;
  result.engines = average.engines;
  result.without_steady_point = average.left_out;
  const WindowError theory = finite_window_error(design, options.window, options.process_noise);
  result.theory = theory.linear;
  result.linearisation = theory.linearisation;
  if (!truth.nonlinear) result.linearisation.health.setZero(), result.linearisation.auxiliary.setZero();
  result.settled = settled_error(design, options.process_noise);
  result.experiment = by_channel(average.mean, 0);
  result.standard_error = by_channel(average.standard_error, 0);
  result.standard_error_of_total = {average.standard_error(p + r), average.standard_error(p + r + 1)};
  result.coverage = by_channel(average.mean, behind);
  result.coverage_standard_error = by_channel(average.standard_error, behind);
  return result;
}

}  // namespace ehm::tuner_design
