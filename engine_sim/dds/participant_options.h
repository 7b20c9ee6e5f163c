#pragma once
// The simulator's and the replay's DDS participant, from the configuration.

#include <spdlog/spdlog.h>

#include "engine_sim/scenario/scenario_file.h"
#include "idl/dds/participant.h"

namespace ehm::engine {

inline wire::ParticipantOptions participant_options(const SimConfig& config, const std::string& name) {
  wire::ParticipantOptions options;
  options.domain = static_cast<std::uint32_t>(config.domain);
  options.name = name;
  options.profiles_file = config.profiles_file;
  options.profile = config.profile;
  options.partition = config.partition;
  options.security = config.security;
  options.on_incompatible = [](const std::string& what) { spdlog::warn("{}", what); };
  return options;
}

}  // namespace ehm::engine
