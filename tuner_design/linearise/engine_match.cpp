// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/engine_match.h"

#include <stdexcept>

#include "engine_sim/engines/engine_file.h"

namespace ehm::tuner_design {
namespace {

std::string identity(const std::string& type, const std::string& hash) {
  constexpr std::size_t shown_digits = 12;
  return "'" + type + "'" + (hash.empty() ? "" : " (hash " + hash.substr(0, shown_digits) + ")");
}

}  // namespace

void require_engine(const linear_model::LinearModel& model, const engine_sim::EngineDefinition& engine,
                    const std::string& who) {
  if (!model.operating_point)
    throw std::invalid_argument(who + ": the design for the engine " + identity(model.engine_type, model.engine_hash) +
                                " has no operating_point; allowed: a design of what tuner_design linearise writes");
  const std::string type = engine_sim::engine_type(engine.data), hash = engine_sim::engine_hash(engine);
  if (model.engine_type == type && (model.engine_hash.empty() || model.engine_hash == hash)) return;
  throw std::invalid_argument(who + ": the design is for the engine " + identity(model.engine_type, model.engine_hash) +
                              ", but " + identity(type, hash) +
                              " is to fly; name the design's engine with --engine, or linearise this one");
}

}  // namespace ehm::tuner_design
