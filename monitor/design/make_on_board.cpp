// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_on_board.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/sensor_lags.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/mismatch/mismatch.h"
#include "monitor/onboard/on_board_estimator.h"

namespace ehm::design {
namespace {

namespace sim = engine_sim;
using EnginePointer = std::shared_ptr<const sim::EngineDefinition>;

/// The shipped engine whose type this is, or null.
EnginePointer engine_of_type(const std::string& type) {
  for (const std::string& name : sim::shipped_engine_list())
    if (auto engine = sim::named_engine(name); sim::engine_type(engine->data) == type) return engine;
  return nullptr;
}

EnginePointer engine_for(const Design& design, const std::string& name_or_file) {
  try {
    if (!name_or_file.empty()) return sim::named_engine(name_or_file);
  } catch (const files::FileError& error) {
    throw std::invalid_argument(std::string("estimator 'onboard': 'estimator.engine': ") + error.what());
  }
  if (auto engine = engine_of_type(design.model.engine_type)) return engine;
  throw std::invalid_argument("estimator 'onboard' needs an engine, but the design names '" + design.model.engine_type +
                              "'; shipped are " + sim::shipped_engine_names() +
                              "; give 'estimator.engine' a name or an engine file");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// @throws std::invalid_argument unless the design has these channels of this kind
void require_same(const std::vector<linear_model::Channel>& of_design, const std::vector<std::string>& of_engine,
                  const char* kind) {
  std::vector<std::string> names;
  for (const auto& channel : of_design) names.push_back(channel.name);
  if (names != of_engine)
    throw std::invalid_argument(std::string("estimator 'onboard': the design has the ") + kind + " " + listed(names) +
                                ", the engine " + listed(of_engine) + "; make the design of this engine anew");
}

template <class Channels, class Name>
std::vector<std::string> names_of(const Channels& channels, Name name) {
  std::vector<std::string> names;
  for (const auto& channel : channels) names.emplace_back(name(channel));
  return names;
}

void require_channels(const Design& design, const sim::NamedChannels& c) {
  const auto& model = design.model;
  require_same(model.sensors, names_of(c.sensors, [](const auto& s) { return s.quantity->name; }), "sensors");
  require_same(model.controls, names_of(c.controls, [](const auto* s) { return s->name; }), "actuators");
  require_same(model.health, names_of(c.health, [](const auto& h) { return sim::health_names[h.parameter]; }),
               "health parameters");
  require_same(model.auxiliary, names_of(c.auxiliary, [](const auto* s) { return s->name; }), "auxiliary outputs");
}

}  // namespace

std::shared_ptr<const onboard::OnBoardModel> make_on_board_model(const Design& design,
                                                                 const monitor::EstimatorOptions& options) {
  const auto engine = std::make_shared<sim::EngineDefinition>(*engine_for(design, options.engine));
  require_channels(design, engine->channels);
  sim::add_lags({options.lag_speed_s, options.lag_pressure_s, options.lag_temperature_s}, engine->channels.sensors);
  onboard::OnBoardOptions settings;
  settings.sample_time_s = design.model.sample_time_s;
  settings.build = settings.soak = options.mismatch != "none";
  settings.inputs = options.mismatch == "all";
  settings.health_walk_percent = options.health_walk_percent;
  std::vector<double> noise_sigma;
  if (options.noise_of == "trim")
    noise_sigma.assign(design.model.sensor_noise_sigma.begin(), design.model.sensor_noise_sigma.end());
  return std::make_shared<const onboard::OnBoardModel>(engine, settings, noise_sigma);
}

std::vector<std::string> learned_names(const onboard::OnBoardModel& model) {
  std::vector<std::string> names =
      names_of(model.definition().channels.health, [](const auto& h) { return sim::health_names[h.parameter]; });
  for (const onboard::OnBoardCause& cause : model.causes())
    names.emplace_back(sim::mismatch_causes()[cause.index].name);
  return names;
}

std::unique_ptr<estimation::Estimator> make_on_board_estimator(const Design& design,
                                                               const monitor::EstimatorOptions& options) {
  return std::make_unique<onboard::OnBoardEstimator>(make_on_board_model(design, options));
}

}  // namespace ehm::design
