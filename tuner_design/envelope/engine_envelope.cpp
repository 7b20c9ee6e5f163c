// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "engine_sim/model/parts/root_theta.h"
#include "engine_sim/model/thermo/ram.h"
#include "monitor/schedule/point_lookup.h"
#include "tuner_design/envelope/envelope.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;
using schedule::Axis;
using schedule::Schedule;

constexpr double least_n1 = 0.36, most_n1 = 1.06;  ///< of the corrected fan speed at the design point
constexpr double most_mach = 0.86, least_t2_k = 215.0, most_t2_k = 335.0;
constexpr double least_interval = 1.0 / 40.0;  ///< of an axis: a kink of the valves is no reason for ever more nodes
constexpr double bias_factor = 1.8;            ///< of lambda; chosen on fleets of seed 101
constexpr double share_of_refining = 0.3;      ///< of the work, for the bar
/// gamma of theory.md, section 13, without heat soak in the model: percent of a reading a percent of eta, by unit.
double eta_of_reading(const std::string& unit) {
  return unit == "rpm" ? 0.06 : unit == "K" ? 0.18 : 0.06;
}

std::vector<double> evenly(double from, double to, int points) {
  std::vector<double> all;
  for (int i = 0; i < points; ++i) all.push_back(from + (to - from) * i / (points - 1));
  return all;
}

class Grid {
 public:
  Grid(const EnvelopeOptions& options, const std::function<void(double)>& progress)
      : options_(options), progress_(progress), turbofan_(options.engine->data) {
    const auto& design = options.engine->data.design;
    design_n1_ = design.speeds.n1_rpm / sim::root_theta(options.engine->data.inlet, design.flight);
    schedule_.axes = {{schedule::Variable::n1_corrected, evenly(least_n1 * design_n1_, most_n1 * design_n1_, 7)},
                      {schedule::Variable::mach, evenly(0.0, most_mach, 3)},
                      {schedule::Variable::t2, evenly(least_t2_k, most_t2_k, 3)}};
    describe_channels();
  }

  EnvelopeResult build() {
    while (refine())
      progress_(share_of_refining * static_cast<double>(count()) / static_cast<double>(options_.most_nodes));
    schedule_.nodes.resize(count());
    long_work::parallel_for(
        count(), options_.threads,
        [&](std::size_t k) {
          schedule_.nodes[k] = engine_node(options_.engine, turbofan_, place_of(k), schedule_, options_.node);
        },
        [&](std::size_t done) {
          progress_(share_of_refining +
                    (1.0 - share_of_refining) * static_cast<double>(done) / static_cast<double>(count()));
        });
    EnvelopeResult result{schedule_, 0, 0, {}};
    for (const schedule::Node& node : schedule_.nodes) {
      result.valid += node.valid;
      result.unstable += node.valid && node.A.eigenvalues().real().maxCoeff() >= 0.0;
    }
    result.error = check(schedule::PointLookup(schedule_));
    return result;
  }

 private:
  std::size_t count() const {
    std::size_t n = 1;
    for (const Axis& axis : schedule_.axes) n *= axis.points.size();
    return n;
  }
  NodePlace place_of(std::size_t k) const {
    const auto& a = schedule_.axes;
    const std::size_t i = k % a[0].points.size(), rest = k / a[0].points.size();
    return {a[0].points[i], a[1].points[rest % a[1].points.size()], a[2].points[rest / a[1].points.size()]};
  }

  void describe_channels() {
    const auto& c = options_.engine->channels;
    schedule_.states = {similarity_of("Nf", "rpm"), similarity_of("Nc", "rpm")};
    for (const auto* control : c.controls)
      schedule_.actuators.push_back(similarity_of(std::string(control->name), std::string(control->unit)));
    schedule_.eta_y.resize(as_index(c.sensors.size()));
    for (std::size_t i = 0; i < c.sensors.size(); ++i) {
      const std::string unit(c.sensors[i].quantity->unit);
      schedule_.sensors.push_back(similarity_of(std::string(c.sensors[i].quantity->name), unit));
      schedule_.eta_y(as_index(i)) = eta_of_reading(unit);
    }
    schedule_.eta_z.resize(as_index(c.auxiliary.size()));
    for (std::size_t i = 0; i < c.auxiliary.size(); ++i) {
      const std::string unit(c.auxiliary[i]->unit);
      schedule_.auxiliary.push_back(similarity_of(std::string(c.auxiliary[i]->name), unit));
      schedule_.eta_z(as_index(i)) = unit == "K" ? 2.6 : unit == "N" ? 400.0 : 0.06;  // theory.md, section 13
    }
    schedule_.path_n1_rpm = 0.107 * design_n1_;
    schedule_.bias_factor = bias_factor;
  }

  /// Of [x0 u0 y0 z0]; each place is solved once.
  const Eigen::VectorXd& trim(const NodePlace& p) {
    const auto key = std::array{p.n1_corrected_rpm, p.mach, p.t2_k};
    const auto found = trims_.find(key);
    return found != trims_.end()
               ? found->second
               : trims_.emplace(key, engine_trim(options_.engine, turbofan_, p, schedule_)).first->second;
  }

  /// Halves the interval that misses most. False where no more nodes are allowed.
  bool refine() {
    double worst = 0.0;
    std::size_t worst_axis = 0, worst_interval = 0;
    for (std::size_t a = 0; a < schedule_.axes.size(); ++a) {
      const std::size_t more = count() / schedule_.axes[a].points.size();
      if (count() + more > options_.most_nodes) continue;
      const std::vector<double>& p = schedule_.axes[a].points;
      for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        if (p[i + 1] - p[i] < least_interval * (p.back() - p.front())) continue;
        // A plane of nodes costs as many as it has.
        const double miss = miss_of(a, i) / static_cast<double>(more);
        if (miss > worst) worst = miss, worst_axis = a, worst_interval = i;
      }
    }
    if (worst == 0.0) return false;
    auto& points = schedule_.axes[worst_axis].points;
    points.insert(points.begin() + static_cast<std::ptrdiff_t>(worst_interval) + 1,
                  0.5 * (points[worst_interval] + points[worst_interval + 1]));
    return true;
  }

  /// Sum of squares, relative to each quantity's largest, over the other axes.
  double miss_of(std::size_t axis, std::size_t interval) {
    const std::vector<double> points = schedule_.axes[axis].points;
    double sum = 0.0;
    const std::size_t places = count() / points.size();
    for (std::size_t k = 0; k < places; ++k) {
      std::array<double, 3> p{};
      std::size_t rest = k;
      for (std::size_t a = 0; a < 3; ++a) {
        if (a == axis) continue;
        p[a] = schedule_.axes[a].points[rest % schedule_.axes[a].points.size()];
        rest /= schedule_.axes[a].points.size();
      }
      const auto at = [&](double x) -> const Eigen::VectorXd& {
        p[axis] = x;
        return trim({p[0], p[1], p[2]});
      };
      const Eigen::VectorXd &low = at(points[interval]), &high = at(points[interval + 1]),
                            &middle = at(0.5 * (points[interval] + points[interval + 1]));
      if (low.size() == 0 || high.size() == 0 || middle.size() == 0) continue;
      const Eigen::VectorXd miss = (middle - 0.5 * (low + high)).cwiseQuotient(size_of(middle));
      sum += miss.squaredNorm();
    }
    return sum;
  }

  /// A quantity's size: as it is, and at least a third of its greatest: thrust near none, valves that begin to open.
  Eigen::VectorXd size_of(const Eigen::VectorXd& here) {
    if (greatest_.size() == 0) greatest_ = here.cwiseAbs();
    greatest_ = greatest_.cwiseMax(here.cwiseAbs());
    return here.cwiseAbs().cwiseMax(greatest_ / 3.0).cwiseMax(1e-9);
  }

  InterpolationError check(const schedule::PointLookup& lookup) {
    NoiseSource random(options_.node.seed + 1);
    const auto within = [&](double from, double to) {  // a uniform of a normal one, by its fraction
      const double x = 1000.0 * random.normal();
      return from + (to - from) * (x - std::floor(x));
    };
    const auto m = schedule_.sensors.size(), r = schedule_.auxiliary.size();
    InterpolationError error{std::vector<double>(m + r), std::vector<double>(m + r), options_.checks, 0};
    for (int k = 0; k < options_.checks; ++k) {
      const NodePlace p{within(least_n1 * design_n1_, most_n1 * design_n1_), within(0.0, most_mach),
                        within(least_t2_k, most_t2_k)};
      const Eigen::VectorXd own = engine_trim(options_.engine, turbofan_, p, schedule_);
      schedule::PointModel model;
      if (own.size() == 0 ||
          !lookup.at({p.n1_corrected_rpm, p.mach, p.t2_k / sim::reference_temperature_k, 1.0, 0.0}, model))
        continue;
      // The table answers at sea level pressure and this theta; the trim is reduced to theta 1.
      ++error.answered;
      const double theta = p.t2_k / sim::reference_temperature_k;
      for (std::size_t i = 0; i < m + r; ++i) {
        const bool sensor = i < m;
        const auto at = as_index(sensor ? i : i - m);
        const double power = (sensor ? schedule_.sensors[i] : schedule_.auxiliary[i - m]).theta_power;
        const double truth = own(own.size() - as_index(m + r) + as_index(i)) * std::pow(theta, power);
        const double told = sensor ? model.y0(at) : model.z0(at);
        const double size = size_of(own)(own.size() - as_index(m + r) + as_index(i)) * std::pow(theta, power);
        const double miss = 100.0 * std::abs(told - truth) / size;
        error.rms_percent[i] += miss * miss;
        error.most_percent[i] = std::max(error.most_percent[i], miss);
      }
    }
    for (double& e : error.rms_percent) e = std::sqrt(e / std::max(1, error.answered));
    return error;
  }

  const EnvelopeOptions& options_;
  const std::function<void(double)>& progress_;
  sim::Turbofan turbofan_;
  double design_n1_ = 0.0;
  Schedule schedule_;
  Eigen::VectorXd greatest_;  ///< of the trims seen
  std::map<std::array<double, 3>, Eigen::VectorXd> trims_;
};

}  // namespace

EnvelopeResult engine_envelope(const EnvelopeOptions& options, const std::function<void(double)>& progress) {
  return Grid(options, progress).build();
}

}  // namespace ehm::tuner_design
