// SPDX-License-Identifier: Apache-2.0
#pragma once
// The simulator's and the replay's DDS participant, from the configuration; who is kept out of its secured domain is
// said in the log.

#include <spdlog/spdlog.h>

#include <memory>
#include <optional>
#include <string>

#include "deploy/runtime/service/security_watch.h"
#include "engine_sim/scenario/scenario_file.h"
#include "idl/dds/participant.h"
#include "idl/dds/security_files.h"

namespace ehm::engine_sim {

class WatchedParticipant {
 public:
  /// `name` is what other participants see. @throws idl::DdsError
  WatchedParticipant(const SimConfig& config, const std::string& name) : options_(options(config, name)) {
    auto incidents = service::receive_incidents(options_);
    participant_.emplace(options_);
    if (!config.security.empty())
      security_.emplace(
          *participant_, std::move(incidents),
          [](const auto& text, auto times) { spdlog::warn("{}", service::incident_text(text, times)); },
          idl::examine_identity(config.security).expires_s);
  }
  idl::Participant& get() { return *participant_; }
  double held_up_s() noexcept { return participant_->held_up_s(); }

 private:
  static idl::ParticipantOptions options(const SimConfig& config, const std::string& name) {
    idl::ParticipantOptions options;
    options.domain = static_cast<std::uint32_t>(config.domain);
    options.name = name;
    options.profiles_file = config.profiles_file;
    options.profile = config.profile;
    options.partition = config.partition;
    options.security = config.security;
    options.on_incompatible = [](const std::string& what) { spdlog::warn("{}", what); };
    options.on_unreadable = [](bool present, const std::string& what) {
      spdlog::log(present ? spdlog::level::warn : spdlog::level::info, "{}", what);
    };
    return options;
  }

  idl::ParticipantOptions options_;
  std::optional<idl::Participant> participant_;
  std::optional<service::SecurityWatch> security_;
};

}  // namespace ehm::engine_sim
