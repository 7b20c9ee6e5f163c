// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/identify/steady_segments.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/linear/lyapunov.h"
#include "monitor/estimation/point_distance.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using linear_model::LinearModel;

constexpr double least_valid_share = 0.9, moving_distance = 0.1, jump_sigmas = 8.0;
constexpr double shortest_piece = 512.0, longest_piece = 4096.0, shortest_window = 64.0, longest_window = 512.0;

enum class Fate : unsigned char { good, missing, off_point, moving, too_short };

/// Samples after which 1/e of the slowest motion of x[k+1] = A x[k] is left.
double slowest_samples(const MatrixXd& A) {
  const double radius = estimation::spectral_radius(A);
  return radius > 0.0 && radius < 1.0 ? -1.0 / std::log(radius) : 1.0;
}

estimation::Conditions conditions(const VectorXd& flight, const VectorXd& controls) {
  estimation::Conditions now;
  now.flight = {flight(0), flight(1), flight(2)};
  now.actuators = controls;
  return now;
}

class Selection {
 public:
  Selection(const RecordedSamples& record, const LinearModel& model, const monitor::ValidityOptions& validity)
      : record_(record),
        model_(model),
        validity_(validity),
        fate_(as_size(record.sensors.cols()), Fate::good),
        cut_after_(as_size(record.sensors.cols()), false) {
    const double slowest = slowest_samples(model.A);
    result_.recorded = record.sensors.cols();
    const auto samples = [](double count) { return static_cast<Index>(std::ceil(count)); };
    result_.window = samples(std::clamp(2.0 * slowest, shortest_window, longest_window));
    result_.settling = samples(5.0 * slowest);
    result_.least_length = samples(std::clamp(12.0 * slowest, shortest_piece, longest_piece));
    result_.gaps = as_index(record.gap_after.size());
    for (const Index k : record.gap_after) cut_after_[as_size(k)] = true;
  }

  SteadySelection made() {
    choose_sensors();
    judge_samples();
    for (const int i : result_.sensors) cut_at_jumps(i);
    for (const Span& run : runs()) mark_motion(run);
    for (const Span& run : runs()) take(run);
    for (const Fate fate : fate_) {
      result_.missing += fate == Fate::missing;
      result_.off_point += fate == Fate::off_point;
      result_.moving += fate == Fate::moving;
      result_.too_short += fate == Fate::too_short;
    }
    return result_;
  }

 private:
  void choose_sensors() {
    for (Index i = 0; i < record_.sensors.rows(); ++i) {
      const auto valid = static_cast<double>(record_.sensors.row(i).array().isFinite().count());
      if (valid > 0.0 && valid >= least_valid_share * static_cast<double>(result_.recorded))
        result_.sensors.push_back(static_cast<int>(i));
    }
  }

  void judge_samples() {
    const estimation::PointDistance distance(validity_, model_);
    for (Index k = 0; k < result_.recorded; ++k) {
      const bool whole = record_.flight.col(k).allFinite() && record_.controls.col(k).allFinite() &&
                         record_.sensors(result_.sensors, k).allFinite();
      if (!whole)
        fate_[as_size(k)] = Fate::missing;
      else if (distance.of(conditions(record_.flight.col(k), record_.controls.col(k))) > 1.0)
        fate_[as_size(k)] = Fate::off_point;
    }
  }

  void cut_at_jumps(int sensor) {
    std::vector<double> steps;
    for (Index k = 0; k + 1 < result_.recorded; ++k)
      if (follows(k)) steps.push_back(step(sensor, k));
    if (steps.empty()) return;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    const double usual = 1.4826 * *middle;
    if (usual == 0.0) return;  // a sensor that holds its values
    for (Index k = 0; k + 1 < result_.recorded; ++k) {
      if (!follows(k) || step(sensor, k) <= jump_sigmas * usual) continue;
      cut_after_[as_size(k)] = true;
      ++result_.jumps;
    }
  }

  bool good(Index k) const { return fate_[as_size(k)] == Fate::good; }
  /// The next sample belongs to the same run.
  bool follows(Index k) const { return good(k) && good(k + 1) && !cut_after_[as_size(k)]; }
  double step(int sensor, Index k) const {
    return std::abs(record_.sensors(sensor, k + 1) - record_.sensors(sensor, k));
  }

  std::vector<Span> runs() const {
    std::vector<Span> all;
    for (Index k = 0; k < result_.recorded;) {
      const Index begin = k;
      if (!good(k++)) continue;
      while (k < result_.recorded && follows(k - 1)) ++k;
      all.push_back({begin, k - begin});
    }
    return all;
  }

  /// By how much of a tolerance the mean has moved from one window to the next.
  double moved(const Span& before, const Span& now) const {
    const auto mean = [](const MatrixXd& values, const Span& at) -> VectorXd {
      return values.middleCols(at.begin, at.length).rowwise().mean();
    };
    LinearModel there;
    there.controls = model_.controls;
    const VectorXd controls = mean(record_.controls, before), flight = mean(record_.flight, before);
    for (std::size_t i = 0; i < there.controls.size(); ++i) there.controls[i].trim = controls(as_index(i));
    there.operating_point = linear_model::OperatingPoint{flight(0), flight(1), flight(2)};
    return estimation::PointDistance(validity_, there)
        .of(conditions(mean(record_.flight, now), mean(record_.controls, now)));
  }

  void mark_motion(const Span& run) {
    const Index windows = std::max(Index{1}, run.length / result_.window);
    const auto window = [&](Index w) {
      const Index begin = w * run.length / windows, end = (w + 1) * run.length / windows;
      return Span{run.begin + begin, end - begin};
    };
    Span first = window(0);
    for (Index w = 1; w < windows; ++w) {
      const Span before = window(w - 1), now = window(w);
      if (moved(before, now) > moving_distance) {
        const Index end = std::min(run.begin + run.length, now.begin + now.length + result_.settling);
        std::fill(fate_.begin() + before.begin, fate_.begin() + end, Fate::moving);
        first = now;
      } else if (moved(first, now) > moving_distance) {
        cut_after_[as_size(now.begin - 1)] = true;
        ++result_.drifts;
        first = now;
      }
    }
  }

  void take(const Span& run) {
    if (run.length < result_.least_length) {
      std::fill_n(fate_.begin() + run.begin, run.length, Fate::too_short);
      return;
    }
    result_.segments.push_back(run);
    result_.used += run.length;
  }

  const RecordedSamples& record_;
  const LinearModel& model_;
  const monitor::ValidityOptions& validity_;
  SteadySelection result_;
  std::vector<Fate> fate_;
  std::vector<bool> cut_after_;
};

}  // namespace

SteadySelection select_steady(const RecordedSamples& record, const LinearModel& model,
                              const monitor::ValidityOptions& validity) {
  return Selection(record, model, validity).made();
}

}  // namespace ehm::tuner_design
