// SPDX-License-Identifier: Apache-2.0
// What was designed and from what.

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/print/design_text.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {
namespace {

std::string weights_of(const design::Design& design) {
  const design::ErrorWeights& weights = design.options.weights;
  std::string text = "health " + number(weights.health);
  if (design.model.auxiliary.empty()) return text;
  text += ", auxiliary outputs " + number(weights.auxiliary);
  for (std::size_t i = 0; i < weights.channel.size(); ++i)
    text += (i == 0 ? " (" : ", ") + design.model.auxiliary[i].name + " " + number(weights.channel[i]);
  return !weights.channel.empty() ? text + ")" : text;
}

DataTable facts(const ReportData& data) {
  const auto& design = data.design;
  const auto& model = design.model;
  DataTable table{{"item", "value"}, {}};
  const auto add = [&](const std::string& item, const std::string& value) { table.rows.push_back({item, value}); };
  add("Model", model.name);
  if (!model.engine_type.empty()) add("Engine", model.engine_type);
  if (model.operating_point) {
    const auto& point = *model.operating_point;
    add("Operating point", quantity(point.altitude_m, "m", 5) + ", Mach " + number(point.mach) + ", ISA " +
                               (point.delta_isa_k < 0.0 ? "" : "+") + quantity(point.delta_isa_k, "K"));
  } else {
    add("Operating point", "the model does not say");
  }
  add("Time", (model.discrete ? std::string("discrete") : std::string("continuous, discretised exactly")) +
                  ", sample " + quantity(1e3 * model.sample_time_s, "ms"));
  add("Dimensions",
      counted(model.states.size(), "state") + ", " + counted(model.controls.size(), "actuator") + ", " +
          counted(model.sensors.size(), "sensor") + ", " + counted(model.health.size(), "health parameter") + ", " +
          counted(model.auxiliary.size(), "auxiliary output") + ", " + counted(as_size(design.full.V.rows()), "tuner"));
  add("Scaling",
      "states and sensors in percent of trim; health in percent; temperatures in K; margins in points; other "
      "auxiliary outputs in percent of trim");
  add("Linearisation error", model.linearisation_error.size() > 0 ? "measured, part of every published sigma"
                                                                  : "not given: the engine is taken as linear");
  add("Tuners", reduction(design));
  add("Qh", quantity(design.options.qh_percent2, "percent²") + " per sample");
  add("Weights in the objective", weights_of(design));
  add("Search",
      counted(as_size(design.options.random_starts), "random start") + ", seed " + std::to_string(design.options.seed));
  add("Made by", design.options.created_by + " " + design.options.version);
  add("Design hash (SHA-256)", design.hash);
  return table;
}

DataTable channels(const ReportData& data) {
  const auto& model = data.design.model;
  const auto& scaling = data.design.scaling;
  DataTable table{{"channel", "kind", "unit", "trim", "spread or noise (1 sigma)", "scaled unit", "scale"}, {}};
  const auto add = [&](const std::vector<linear_model::Channel>& list, const std::string& kind,
                       const Eigen::VectorXd* sigma, const Eigen::VectorXd* scale, const auto& unit_of) {
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto at = as_index(i);
      const auto value = [&](const Eigen::VectorXd* vector) {
        return vector == nullptr ? std::string("–") : number((*vector)(at), 4);
      };
      table.rows.push_back(
          {list[i].name, kind, list[i].unit, number(list[i].trim, 5), value(sigma), unit_of(i), value(scale)});
    }
  };
  const auto percent_of_trim = [](const std::vector<linear_model::Channel>& list, const std::string& otherwise) {
    return [&list, otherwise](std::size_t i) -> std::string {
      if (linear_model::size_of_trim(list[i]) > 0.0) return "percent of trim";
      return list[i].unit == "percent" || list[i].unit == "%" ? "percent, as it is" : otherwise;
    };
  };
  add(model.health, "health", &model.health_sigma, &scaling.health, [](std::size_t) { return std::string("percent"); });
  add(model.sensors, "sensor", &model.sensor_noise_sigma, &scaling.sensor,
      percent_of_trim(model.sensors, "noise sigma"));
  add(model.auxiliary, "auxiliary", nullptr, &scaling.auxiliary,
      [&](std::size_t i) { return scaling.auxiliary_unit[i]; });
  add(model.states, "state", nullptr, &scaling.state, percent_of_trim(model.states, "as it is"));
  add(model.controls, "actuator", nullptr, nullptr, [](std::size_t) { return std::string("as it is"); });
  return table;
}

}  // namespace

Section origin_section(const ReportData& data) {
  Section section{"origin", "What was designed, and from what"};
  section.add_table("facts", "The design and the model that it was made from", facts(data));
  section.add_table("channels", "Channels in the model's units; the scale is what one scaled unit means in them",
                    channels(data));
  return section;
}

}  // namespace ehm::tuner_design::report
