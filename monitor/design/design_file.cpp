// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/design_file.h"

#include <cmath>

#include "deploy/runtime/files/atomic_file.h"
#include "deploy/runtime/files/content_hash.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_text.h"
#include "engine_sim/linear_model/model_json.h"
#include "monitor/design/certificate_json.h"
#include "monitor/design/options_json.h"
#include "monitor/design/schedule_json.h"
#include "monitor/design/subset_json.h"

namespace ehm::design {
namespace {

constexpr const char* any_design_schema = "ehm-design/";
constexpr const char* make_again = "Make the design again with tuner_design design";

files::Json errors_to_json(const ErrorByChannel& errors, const std::string& file, const std::string& key) {
  return {{"health", files::vector_to_json(errors.health, file, key + ".health")},
          {"auxiliary", files::vector_to_json(errors.auxiliary, file, key + ".auxiliary")}};
}

ErrorByChannel errors_from_json(files::JsonObject& parent, const std::string& name,
                                const linear_model::LinearModel& model) {
  files::JsonObject object(parent.at(name), parent.file(), parent.key(name));
  ErrorByChannel errors{object.vector("health", model.L.cols()), object.vector("auxiliary", model.F.rows())};
  object.refuse_unknown();
  return errors;
}

files::Json scaling_to_json(const linear_model::Scaling& scaling, const std::string& file) {
  return {{"state", files::vector_to_json(scaling.state, file, "scaling.state")},
          {"sensor", files::vector_to_json(scaling.sensor, file, "scaling.sensor")},
          {"health", files::vector_to_json(scaling.health, file, "scaling.health")},
          {"auxiliary", files::vector_to_json(scaling.auxiliary, file, "scaling.auxiliary")},
          {"auxiliary_unit", scaling.auxiliary_unit}};
}

linear_model::Scaling scaling_from_json(files::JsonObject& parent, const linear_model::LinearModel& model) {
  files::JsonObject object(parent.at("scaling"), parent.file(), parent.key("scaling"));
  // The scaling follows from the model; the file states it for readers, and must agree.
  const linear_model::Scaling scaling = linear_model::scaling_of(model);
  const files::Json stated = {{"state", object.at("state")},
                              {"sensor", object.at("sensor")},
                              {"health", object.at("health")},
                              {"auxiliary", object.at("auxiliary")},
                              {"auxiliary_unit", object.at("auxiliary_unit")}};
  object.refuse_unknown();
  if (stated != scaling_to_json(scaling, parent.file())) {
    files::throw_defect(parent.file(), "scaling", "not the scaling of this model",
                        "percent of trim and reporting units", make_again);
  }
  return scaling;
}

files::Json content_of(const Design& design, const std::string& file) {
  const bool own_readout = design.model.linearisation_error.size() > 0;
  files::Json missing = files::Json::array();
  for (std::size_t i = 0; i < design.missing.size(); ++i) {
    const std::string path = "designs.missing[" + std::to_string(i) + "]";
    missing.push_back(design.missing[i] ? subset_to_json(*design.missing[i], own_readout, file, path)
                                        : files::Json(nullptr));
  }
  files::Json json = {
      {"schema", design_schema},
      {"model", linear_model::model_to_json(design.model, file)},
      {"scaling", scaling_to_json(design.scaling, file)},
      {"made_by", options_to_json(design.options)},
      {"certificate", certificate_to_json(design.certificate, file)},
      {"designs",
       {{"full", subset_to_json(design.full, own_readout, file, "designs.full")}, {"missing", std::move(missing)}}},
      {"errors",
       {{"ssee", errors_to_json(design.ssee, file, "errors.ssee")},
        {"linearisation", errors_to_json(design.linearisation, file, "errors.linearisation")},
        {"bayes_limit", errors_to_json(design.bayes_limit, file, "errors.bayes_limit")},
        {"full_map", errors_to_json(design.full_map, file, "errors.full_map")},
        {"reduced_map", errors_to_json(design.reduced_map, file, "errors.reduced_map")}}}};
  if (design.schedule) json["schedule"] = schedule_to_json(*design.schedule, file);
  return json;
}

/// Removes the hash from `root` and compares it with the hash of the rest.
std::string take_verified_hash(files::Json& root, const std::string& file) {
  files::JsonObject object(root, file, "");
  const std::string schema = object.text("schema");
  if (schema != design_schema) {
    files::throw_defect(
        file, "schema", "\"" + schema + "\"", std::string("\"") + design_schema + "\"",
        schema.starts_with(any_design_schema)
            ? "Designs of another version have other standard deviations (before version 3 without the engine's "
              "process noise): make it again from its model, which also stands under its key \"model\", with "
              "tuner_design design"
            : "The file is of another kind: make the design with tuner_design design");
  }
  const std::string stated = object.text("hash");
  root.erase("hash");
  const std::string actual = files::sha256_hex(root.dump());
  if (stated != actual) {
    files::throw_defect(file, "hash", "\"" + stated + "\"", "\"" + actual + "\", the SHA-256 of the content",
                        "The file was damaged or changed by hand: make the design again with tuner_design design");
  }
  return actual;
}

void read_designs(files::JsonObject& root, Design& design) {
  files::JsonObject object(root.at("designs"), root.file(), "designs");
  design.full = subset_from_json(object.at("full"), design.model, design.scaling, root.file(), "designs.full");
  const files::Json& missing = object.array("missing");
  object.refuse_unknown();
  if (missing.size() != design.model.sensors.size()) {
    files::throw_defect(root.file(), "designs.missing", std::to_string(missing.size()) + " entries long",
                        "one entry for each of the " + std::to_string(design.model.sensors.size()) + " sensors",
                        make_again);
  }
  for (std::size_t i = 0; i < missing.size(); ++i) {
    design.missing.emplace_back();
    if (missing[i].is_null()) continue;
    const std::string path = "designs.missing[" + std::to_string(i) + "]";
    design.missing.back() = subset_from_json(missing[i], design.model, design.scaling, root.file(), path);
  }
}

}  // namespace

Design read_design(const std::string& path) {
  files::Json json = files::parse_json_file(path);
  Design design;
  design.hash = take_verified_hash(json, path);
  files::JsonObject root(json, path, "");
  root.at("schema");
  design.model = linear_model::model_from_json(root.at("model"), path, "model");
  design.scaling = scaling_from_json(root, design.model);
  design.options = options_from_json(root.at("made_by"), design.model, path);
  design.certificate = certificate_from_json(root.at("certificate"), path);
  read_designs(root, design);
  files::JsonObject errors(root.at("errors"), path, "errors");
  design.ssee = errors_from_json(errors, "ssee", design.model);
  design.linearisation = errors_from_json(errors, "linearisation", design.model);
  design.bayes_limit = errors_from_json(errors, "bayes_limit", design.model);
  design.full_map = errors_from_json(errors, "full_map", design.model);
  design.reduced_map = errors_from_json(errors, "reduced_map", design.model);
  errors.refuse_unknown();
  if (const files::Json* schedule = root.find("schedule"))
    design.schedule = schedule_from_json(*schedule, design.model, path);
  root.refuse_unknown();
  return design;
}

std::string write_design(const Design& design, const std::string& path) {
  files::Json json = content_of(design, path);
  const std::string hash = files::sha256_hex(json.dump());
  json["hash"] = hash;
  files::write_file_atomically(path, files::readable_text(json));
  return hash;
}

}  // namespace ehm::design
