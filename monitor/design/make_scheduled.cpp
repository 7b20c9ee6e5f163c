// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_scheduled.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "deploy/runtime/units/units.h"
#include "monitor/schedule/scheduled_estimator.h"

namespace ehm::design {
namespace {

using schedule::ScheduledModel;

/// The sensor that measures each state: of its unit and trim, and whose reading is the state. -1: none.
std::vector<int> sensors_of_states(const linear_model::LinearModel& model) {
  std::vector<int> sensors;
  for (std::size_t j = 0; j < model.states.size(); ++j) {
    sensors.push_back(-1);
    for (std::size_t i = 0; i < model.sensors.size() && sensors.back() < 0; ++i) {
      Eigen::VectorXd row = model.C.row(as_index(i));
      row(as_index(j)) -= 1.0;
      if (model.sensors[i].unit == model.states[j].unit && row.cwiseAbs().maxCoeff() < 1e-6)
        sensors.back() = static_cast<int>(i);
    }
  }
  return sensors;
}

/// By its kind; a sensor of another kind has none.
double lag_of(const std::string& unit, const monitor::EstimatorOptions& options) {
  const auto is = [&](const char* si) { return !unit.empty() && units::conversion(unit, si).has_value(); };
  return is("rpm")  ? options.lag_speed_s
         : is("K")  ? options.lag_temperature_s
         : is("Pa") ? options.lag_pressure_s
                    : 0.0;
}

}  // namespace

std::unique_ptr<estimation::Estimator> make_scheduled_estimator(const Design& design,
                                                                const monitor::EstimatorOptions& options) {
  if (!design.schedule)
    throw std::invalid_argument(
        "estimator 'scheduled' needs a design with a schedule of points; tuner_design envelope makes one");
  const linear_model::LinearModel& model = design.model;
  schedule::ScheduledOptions settings;
  settings.sample_time_s = model.sample_time_s;
  for (const schedule::Axis& axis : design.schedule->axes)
    if (axis.variable == schedule::Variable::n1_corrected) settings.least_n1_corrected_rpm = axis.points.front();
  auto made = std::make_shared<ScheduledModel>(*design.schedule, settings);
  made->state_scale = design.scaling.state;
  made->sensor_scale = design.scaling.sensor;
  made->noise = model.sensor_noise_sigma;
  made->trim = linear_model::trims(model.sensors);
  made->lag_s.resize(as_index(model.sensors.size()));
  for (std::size_t i = 0; i < model.sensors.size(); ++i)
    made->lag_s(as_index(i)) = lag_of(model.sensors[i].unit, options);
  made->health_scale = design.scaling.health;
  made->health_sigma = model.health_sigma.cwiseQuotient(design.scaling.health);
  made->sensor_of_state = sensors_of_states(model);
  made->noise_of_reading = options.noise_of == "reading";
  return std::make_unique<schedule::ScheduledEstimator>(std::move(made));
}

}  // namespace ehm::design
