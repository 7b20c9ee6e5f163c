// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/on_board_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "engine_sim/model/onboard/gas_path_quantities.h"
#include "engine_sim/model/parts/root_theta.h"
#include "monitor/onboard/flight_span.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;

QuantityPlace place_of(const sim::OutputChannel& channel) {
  if (channel.column == "egt_margin_k") return {*sim::gas_path_quantity::place("tt_48_k"), -1.0};
  if (const auto place = sim::gas_path_quantity::place(channel.column)) return {*place};
  throw std::invalid_argument("the on-board estimator has no slopes of channel '" + std::string(channel.name) +
                              "'; allowed are the gas path's quantities (columns of a deck) and EGTM");
}

bool wanted(sim::MismatchGroup group, const OnBoardOptions& options) {
  return group == sim::MismatchGroup::build   ? options.build
         : group == sim::MismatchGroup::metal ? options.soak
                                              : options.inputs;
}

CauseKind kind_of(const sim::MismatchCause& cause) {
  if (cause.group == sim::MismatchGroup::inputs) return CauseKind::input;
  if (cause.group == sim::MismatchGroup::build) return CauseKind::engine;
  return cause.name == "soak_capacity" ? CauseKind::capacity : CauseKind::conductance;
}

std::vector<OnBoardCause> causes_of(const sim::EngineData& data, const OnBoardOptions& options) {
  std::vector<OnBoardCause> causes;
  for (std::size_t i = 0; i < sim::mismatch_count; ++i) {
    const sim::MismatchCause& cause = sim::mismatch_causes()[i];
    if (!wanted(cause.group, options)) continue;
    const CauseKind kind = kind_of(cause);
    causes.push_back({kind, i, cause.sigma, nullptr});
    if (kind != CauseKind::engine) continue;
    sim::Mismatch one{};
    one[i] = cause.sigma;
    causes.back().altered = std::make_shared<const sim::Turbofan>(sim::built(data, one));
  }
  return causes;
}

}  // namespace

OnBoardModel::OnBoardModel(std::shared_ptr<const sim::EngineDefinition> engine, const OnBoardOptions& options,
                           std::vector<double> noise_sigma)
    : definition_(std::move(engine)),
      options_(options),
      engine_(definition_->data),
      noise_sigma_(std::move(noise_sigma)),
      causes_(causes_of(definition_->data, options)),
      soak_time_s_(1.0),
      span_(flight_span(engine_, definition_->channels)) {
  for (const sim::SensorChannel& sensor : definition_->channels.sensors) sensors_.push_back(place_of(*sensor.quantity));
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i].place == *sim::gas_path_quantity::place("n1_rpm")) speed_sensors_[0] = static_cast<int>(i);
    if (sensors_[i].place == *sim::gas_path_quantity::place("n2_rpm")) speed_sensors_[1] = static_cast<int>(i);
  }
  for (const sim::OutputChannel* output : definition_->channels.auxiliary) auxiliary_.push_back(place_of(*output));
  const sim::DesignPoint& design = definition_->data.design;
  design_n1_corrected_rpm_ = design.speeds.n1_rpm / sim::root_theta(definition_->data.inlet, design.flight);
  for (const sim::HeatSoakData& metal : definition_->data.metal)
    soak_time_s_ = std::max(soak_time_s_, metal.capacity_j_k / metal.conductance_w_k);
}

double OnBoardModel::noise_sigma(std::size_t sensor, double reading) const {
  const sim::SensorChannel& channel = definition_->channels.sensors[sensor];
  const double own = noise_sigma_.empty() ? 0.01 * channel.noise_percent * std::abs(reading) : noise_sigma_[sensor];
  return std::hypot(own, channel.resolution / std::sqrt(12.0));  // rounding is uniform within a step
}

}  // namespace ehm::onboard
