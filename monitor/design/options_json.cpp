// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/options_json.h"

#include <array>
#include <limits>

#include "deploy/runtime/files/file_error.h"

namespace ehm::design {
namespace {

constexpr const char* make_again = "Make the design again with tuner_design design";

constexpr std::array<Tuning, 3> tunings{Tuning::closed_form, Tuning::kalman, Tuning::map};

Tuning tuning_from(files::JsonObject& object) {
  const std::string name = object.text("tuning");
  for (const Tuning tuning : tunings) {
    if (name == name_of(tuning)) return tuning;
  }
  files::throw_defect(object.file(), object.key("tuning"), "\"" + name + "\"", "closed-form, kalman, map", make_again);
}

std::uint64_t unsigned_number(files::JsonObject& object, const std::string& key, std::uint64_t most) {
  const files::Json& value = object.at(key);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
    files::throw_defect(object.file(), object.key(key), files::shown(value),
                        "an integer from 0 to " + std::to_string(most), make_again);
  return value.get<std::uint64_t>();
}

double weight(files::JsonObject& object, const std::string& key) {
  const double value = object.number(key);
  if (value < 0.0)
    files::throw_defect(object.file(), object.key(key), files::shown(value), "a number that is not negative",
                        make_again);
  return value;
}

}  // namespace

const char* name_of(Tuning tuning) {
  switch (tuning) {
    case Tuning::closed_form:
      return "closed-form";
    case Tuning::kalman:
      return "kalman";
    case Tuning::map:
      return "map";
  }
  return "?";
}

files::Json options_to_json(const DesignOptions& options) {
  return {{"program", options.created_by},
          {"version", options.version},
          {"tuning", name_of(options.tuning)},
          {"qh_percent2", options.qh_percent2},
          {"health_weight", options.weights.health},
          {"auxiliary_weight", options.weights.auxiliary},
          {"channel_weights", options.weights.channel},
          {"random_starts", options.random_starts},
          {"seed", options.seed}};
}

DesignOptions options_from_json(const files::Json& json, const linear_model::LinearModel& model,
                                const std::string& file) {
  files::JsonObject object(json, file, "made_by");
  DesignOptions options;
  options.created_by = object.text("program");
  options.version = object.text("version");
  options.tuning = tuning_from(object);
  options.qh_percent2 = object.positive_number("qh_percent2");
  options.weights.health = weight(object, "health_weight");
  options.weights.auxiliary = weight(object, "auxiliary_weight");
  if (!object.array("channel_weights").empty()) {
    const Eigen::VectorXd channel = object.vector("channel_weights", model.F.rows());
    options.weights.channel.assign(channel.begin(), channel.end());
  }
  options.random_starts = static_cast<int>(unsigned_number(object, "random_starts", 1'000'000));
  options.seed = unsigned_number(object, "seed", std::numeric_limits<std::uint64_t>::max());
  object.refuse_unknown();
  return options;
}

}  // namespace ehm::design
