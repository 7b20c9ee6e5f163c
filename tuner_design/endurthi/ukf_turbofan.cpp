// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/ukf_turbofan.h"

#include <chrono>
#include <cmath>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/nonlinear/engine_state_space.h"
#include "monitor/nonlinear/extended_filter.h"
#include "monitor/nonlinear/unscented_filter.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design::endurthi {
namespace {

using namespace nonlinear;
using estimation::SensorVector;

constexpr std::array names{"ekf", "ukf"};

/// The study's engine without its metal sensor, as the model on board.
std::shared_ptr<const onboard::OnBoardModel> model_of(const StudyPoint& point, double step_s) {
  auto engine = std::make_shared<engine_sim::EngineDefinition>(*point.engine->layout.engine);
  engine->channels.sensors.pop_back();
  onboard::OnBoardOptions options;
  options.build = options.soak = options.inputs = false;
  options.sample_time_s = step_s;
  return std::make_shared<const onboard::OnBoardModel>(engine, options);
}

/// Speeds first, then health.
OrderVector stacked(double speeds, double health, Eigen::Index parameters) {
  OrderVector x = OrderVector::Constant(onboard::speed_count + parameters, health);
  x.head<onboard::speed_count>().setConstant(speeds);
  return x;
}

struct Sums {
  Eigen::VectorXd squares;
  double covered = 0.0, judged = 0.0, seconds = 0.0;
  std::size_t lost = 0;
};

class Contender {
 public:
  Contender(const StudyPoint& point, std::shared_ptr<const onboard::OnBoardModel> model, const FilterSettings& settings,
            bool unscented)
      : space_(model, EngineStateSpace::Metal::without), sigma_(point.noise_sigma.head(space_.sensor_count())) {
    const Eigen::Index p = point.plant.health;
    const double q = settings.process_noise_percent, p0 = settings.p0_percent;
    const FilterNoise noise{stacked(q * q, settings.qh_percent2, p)};
    if (unscented)
      filter_ = std::make_unique<UnscentedFilter>(noise, UnscentedOptions{});
    else
      filter_ = std::make_unique<ExtendedFilter>(noise, ExtendedOptions{});
    set(point, point.control_trim());
    OrderVector x = stacked(0.0, 0.0, p);
    space_.start({point.trim.gas.speeds.n1_rpm, point.trim.gas.speeds.n2_rpm}, false, x);
    filter_->start(x, OrderMatrix(stacked(p0 * p0, p0 * p0, p).asDiagonal()));
  }

  void fly(const StudyPoint& point, const FlightTruth& truth, RandomStream& random, Sums& sums) {
    set(point, truth.u);
    const Eigen::Index m = space_.sensor_count();
    for (int k = 0; k < samples_a_flight; ++k) {
      SensorVector y = truth.y.head(m);
      for (Eigen::Index i = 0; i < m; ++i) y(i) += sigma_(i) * random.normal();
      const auto began = std::chrono::steady_clock::now();
      const bool answered = space_.refer(filter_->estimate()) && filter_->foresee(space_, sigma_) &&
                            filter_->update(space_, y - filter_->predicted(), SensorMask((1u << m) - 1u));
      if (!answered || !filter_->advance(space_)) ++sums.lost;
      sums.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    }
    const Eigen::Index p = truth.health_percent.size();
    const Eigen::VectorXd error = filter_->estimate().tail(p) - truth.health_percent;
    sums.squares += error.cwiseAbs2();
    for (Eigen::Index i = 0; i < p; ++i) {
      const double sigma = std::sqrt(filter_->covariance()(onboard::speed_count + i, onboard::speed_count + i));
      sums.covered += std::abs(error(i)) <= 1.96 * sigma ? 1.0 : 0.0;
      ++sums.judged;
    }
  }

 private:
  void set(const StudyPoint& point, const Eigen::VectorXd& controls) {
    space_.set(
        {{point.flight.altitude_m, point.flight.mach, point.flight.delta_isa_k}, estimation::ActuatorVector(controls)});
  }
  EngineStateSpace space_;
  SensorVector sigma_;
  std::unique_ptr<NonlinearFilter> filter_;
};

}  // namespace

std::vector<TurbofanPoint> run_ukf_turbofan(const HealthStudyOptions& options) {
  std::vector<TurbofanPoint> out;
  for (const StudyPoint& point : study_points(*options.engine)) {
    const auto model = model_of(point, options.filter.sample_time_s);
    std::vector<FlightTruth> truths;
    for (std::size_t k = 0; k < options.flights; ++k)
      truths.push_back(truth_of(point, options.cycles_per_flight * static_cast<double>(k + 1)));
    TurbofanPoint result{point.name, point.health_names(), {}};
    for (std::size_t kind = 0; kind < names.size(); ++kind) {
      std::vector<Sums> runs(options.runs);
      long_work::parallel_for(options.runs, options.threads, [&](std::size_t run) {
        runs[run].squares = Eigen::VectorXd::Zero(point.plant.health);
        Contender contender(point, model, options.filter, kind == 1);
        RandomStream random(options.seed, run);
        for (const FlightTruth& truth : truths) contender.fly(point, truth, random, runs[run]);
      });
      Sums all{.squares = Eigen::VectorXd::Zero(point.plant.health)};
      for (const Sums& run : runs) {
        all.squares += run.squares / static_cast<double>(options.runs * options.flights);
        all.covered += run.covered;
        all.judged += run.judged;
        all.seconds += run.seconds;
        all.lost += run.lost;
      }
      result.filters.push_back({names[kind], errors_of(all.squares, truths.back().health_percent), all.seconds,
                                all.covered / all.judged, all.lost});
    }
    out.push_back(std::move(result));
  }
  return out;
}

}  // namespace ehm::tuner_design::endurthi
