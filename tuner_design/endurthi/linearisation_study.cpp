// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/linearisation_study.h"

#include <cmath>

#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/linearise/step_study.h"

namespace ehm::tuner_design::endurthi {
namespace {

constexpr double seconds = 6.0;
constexpr double closed_loop_step_s = 0.001, open_loop_step_s = 0.01;  ///< fine: their own error must not count
constexpr double traced_each_s = 0.05;
constexpr std::size_t percents = studied_percents.size();

ColumnSteps steps_of(double percent) {
  return {.relative = -0.01 * percent, .central = false, .response_s = ColumnSteps{}.response_s};
}

/// All states and health parameters lowered by this share of their values.
struct Perturbation {
  Eigen::VectorXd states, health;
};
Perturbation lowered(const Plant& plant, double percent) {
  return {-0.01 * percent * plant.v0.head(plant.states), Eigen::VectorXd::Constant(plant.health, -0.01 * percent)};
}

ModelErrors errors_of(const Plant& plant, const std::array<Eigen::MatrixXd, model_count>& models,
                      const Eigen::MatrixXd& tangent, const Record& record, double percent) {
  ModelErrors errors;
  for (std::size_t i = 0; i < model_count; ++i) errors[i] = error_of(plant, models[i], record, percent);
  errors[tangent_model] = error_of(plant, tangent, record, percent);
  return errors;
}

ModelErrors errors_with_corner(const Plant& smooth) {
  const Plant plant = with_corner(smooth, corner_health, corner_steeper);
  const double percent = studied_percents.front();
  const Perturbation p = lowered(plant, percent);
  const Record record = open_loop(plant, p.states, p.health, seconds, open_loop_step_s);
  return errors_of(plant, jacobians(plant, steps_of(percent)), study_steps(plant).jacobian, record, percent);
}

/// The work on one point, in pieces that need nothing of each other but the records.
class PointWork {
 public:
  explicit PointWork(const StudyPoint& point, LinearisationPoint& result) : point_(point), result_(result) {
    result_.name = point.name;
    result_.n1_rpm = point.n1_rpm;
  }

  void fly(std::size_t test) {
    const Perturbation p = lowered(point_.plant, studied_percents[test]);
    records_[test] = closed_loop(point_, p.states, p.health, seconds, closed_loop_step_s);
  }
  void compare(std::size_t linearised) {
    const Plant& plant = point_.plant;
    const auto models = jacobians(plant, steps_of(studied_percents[linearised]));
    const Eigen::MatrixXd tangent = study_steps(plant).jacobian;
    for (std::size_t test = 0; test < percents; ++test)
      result_.errors[linearised][test] = errors_of(plant, models, tangent, records_[test], studied_percents[test]);
    result_.groups[linearised] = coinciding(plant, models, closeness);
    if (linearised > 0) return;
    result_.with_corner = errors_with_corner(plant);
    trace(models[traced_model], tangent);
  }

 private:
  void trace(const Eigen::MatrixXd& model, const Eigen::MatrixXd& tangent) {
    const Record& record = records_.back();
    const auto each = static_cast<Eigen::Index>(std::lround(traced_each_s / record.step_s));
    const auto in_percent = [&](const Eigen::MatrixXd& y) -> Eigen::MatrixXd {
      const auto traced = Eigen::seq(0, y.cols() - 1, each);
      return 100.0 * point_.sensor_trim().cwiseAbs().cwiseInverse().asDiagonal() * y(Eigen::all, traced);
    };
    result_.trace = {.sensors = {},
                     .step_s = traced_each_s,
                     .nonlinear = in_percent(record.y),
                     .model = in_percent(record.y + missed_by(point_.plant, model, record)),
                     .tangent = in_percent(record.y + missed_by(point_.plant, tangent, record))};
    for (const auto& sensor : point_.engine->layout.channels().sensors)
      result_.trace.sensors.emplace_back(sensor.quantity->name);
  }

  const StudyPoint& point_;
  LinearisationPoint& result_;
  std::array<Record, percents> records_;
};

}  // namespace

LinearisationStudy run_linearisation_study(const LinearisationStudyOptions& options,
                                           const std::function<void(double)>& progress) {
  const std::vector<StudyPoint> points = study_points(*options.engine);
  LinearisationStudy study{options, std::vector<LinearisationPoint>(points.size())};
  std::vector<PointWork> work;
  for (std::size_t i = 0; i < points.size(); ++i) work.emplace_back(points[i], study.points[i]);
  const std::size_t pieces = points.size() * percents;
  long_work::parallel_for(
      pieces, options.threads, [&](std::size_t i) { work[i / percents].fly(i % percents); },
      [&](std::size_t done) { progress(0.5 * static_cast<double>(done) / static_cast<double>(pieces)); });
  long_work::parallel_for(
      pieces, options.threads, [&](std::size_t i) { work[i / percents].compare(i % percents); },
      [&](std::size_t done) { progress(0.5 + 0.5 * static_cast<double>(done) / static_cast<double>(pieces)); });
  return study;
}

}  // namespace ehm::tuner_design::endurthi
