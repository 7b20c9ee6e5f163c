// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear/linear_engine.h"

#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "engine_sim/linear_model/stationary_covariance.h"

namespace ehm::engine_sim {

using Eigen::VectorXd;
using linear_model::LinearModel;

namespace {

std::vector<EngineChannel> described(const std::vector<linear_model::Channel>& channels) {
  std::vector<EngineChannel> list;
  for (const auto& channel : channels) list.push_back({channel.name, channel.unit, channel.trim});
  return list;
}

EngineChannels channels_of(const LinearModel& model) {
  EngineChannels c{model.engine_type,        model.sample_time_s,     described(model.controls),
                   described(model.sensors), described(model.health), described(model.auxiliary)};
  for (std::size_t i = 0; i < c.sensors.size(); ++i) c.sensors[i].sigma = linear_model::own_sigma(model, as_index(i));
  return c;
}

std::vector<Sensor> sensors_of(const LinearModel& model) {
  std::vector<Sensor> sensors;
  for (Eigen::Index i = 0; i < model.sensor_noise_sigma.size(); ++i)
    sensors.emplace_back(
        SensorOptions{.noise_sigma = linear_model::own_sigma(model, i),
                      .step = linear_model::resolution(model, i),
                      .held_samples = static_cast<std::uint64_t>(linear_model::held_samples(model, i))});
  return sensors;
}

/// trim + deviation
std::vector<double> absolute(const std::vector<EngineChannel>& channels, const VectorXd& deviation) {
  std::vector<double> values;
  for (std::size_t i = 0; i < channels.size(); ++i) values.push_back(channels[i].trim + deviation(as_index(i)));
  return values;
}

}  // namespace

LinearEngine::LinearEngine(const LinearModel& model, const Scenario& scenario)
    : model_(model),
      channels_(channels_of(model)),
      flown_health_(scenario),
      control_changes_(scenario.control_changes),
      pending_faults_(scenario.faults),
      sensors_(sensors_of(model)),
      noise_(static_cast<std::uint64_t>(scenario.seed)),
      motion_root_(linear_model::covariance_root(model.process_noise)) {
  // x = A x + B u + L h
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(model_.A.rows(), model_.A.cols());
  x_ = (I - model_.A).partialPivLu().solve(model_.B * control_deviation() + model_.L * health_deviation());
  x_ += random(linear_model::covariance_root(linear_model::stationary_covariance(model_.A, model_.process_noise)));
}

std::string LinearEngine::start_text() const {
  std::ostringstream text;
  text << "flies the linear model '" << model_.name << "': " << model_.states.size() << " states, "
       << model_.sensors.size() << " sensors, a sample each " << model_.sample_time_s << " s";
  return text.str();
}

VectorXd LinearEngine::health_deviation() const {
  VectorXd h(as_index(channels_.health.size()));
  for (std::size_t i = 0; i < channels_.health.size(); ++i)
    h(as_index(i)) = flown_health_.acting(time_s(), i) - channels_.health[i].trim;
  return h;
}

VectorXd LinearEngine::control_deviation() const {
  VectorXd u(as_index(channels_.actuators.size()));
  for (std::size_t i = 0; i < channels_.actuators.size(); ++i) u(as_index(i)) = sum_of(control_changes_, i, time_s());
  return u;
}

/// root n, n ~ N(0, I)
VectorXd LinearEngine::random(const Eigen::MatrixXd& root) {
  VectorXd n(root.cols());
  for (double& each : n) each = noise_.normal();
  return root * n;
}

std::vector<Reading> LinearEngine::read(const VectorXd& y) {
  const std::vector<double> truth = absolute(channels_.sensors, y);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < sensors_.size(); ++i)
    readings.push_back(sensors_[i].read(truth[i], time_s(), model_.sample_time_s, noise_));
  return readings;
}

EngineSample LinearEngine::next_sample() {
  for (const auto& [sensor, fault] : pending_faults_.due(time_s())) inject(sensor, fault);
  flown_health_.next_sample();
  const VectorXd h = health_deviation(), u = control_deviation();
  EngineSample sample;
  sample.sequence = sequence_;
  if (const auto& point = model_.operating_point) sample.flight = {point->altitude_m, point->mach, point->delta_isa_k};
  sample.actuators = absolute(channels_.actuators, u);
  sample.health = absolute(channels_.health, h);
  // y = C x + D u + M h,  z = F x + G u + N h
  sample.sensors = read(model_.C * x_ + model_.D * u + model_.M * h);
  sample.auxiliary = absolute(channels_.auxiliary, model_.F * x_ + model_.G * u + model_.N * h);
  // x = A x + B u + L h + w
  x_ = model_.A * x_ + model_.B * u + model_.L * h + random(motion_root_);
  ++sequence_;
  return sample;
}

void LinearEngine::demand(const Demand&) {
  most_net_thrust_n();
}

double LinearEngine::most_net_thrust_n() const {
  throw std::invalid_argument("a linear model has no demand: its controls stay at their trims, but for control_change");
}

bool LinearEngine::can_fly(const FlightCondition&) const {
  throw std::invalid_argument("a linear model flies at its own operating point only");
}

void LinearEngine::fly(const FlightCondition& flight) {
  can_fly(flight);
}

HealthRange LinearEngine::health_range(std::size_t parameter) const {
  const double unit = linear_model::unit_of_health(model_.health.at(parameter));
  return {health_min * unit, health_max * unit};
}

}  // namespace ehm::engine_sim
