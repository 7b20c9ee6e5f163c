// SPDX-License-Identifier: Apache-2.0
#include "deploy/client/client_options.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>

#include "idl/dds/security.h"

namespace ehm::client {

void add_client_options(CLI::App& app, ClientOptions& options) {
  app.add_option("--domain,--dds-domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->envname("EHM_DDS_DOMAIN")
      ->capture_default_str();
  app.add_option("--partition,--dds-partition", options.partition, "DDS partition")->envname("EHM_DDS_PARTITION");
  app.add_option("--profiles-file,--dds-profiles-file", options.profiles_file,
                 "Fast DDS XML profiles, as for a Discovery Server; without it the built-in UDP profile")
      ->envname("EHM_DDS_PROFILES_FILE");
  app.add_option("--profile,--dds-profile", options.profile, "participant profile to take from that file")
      ->envname("EHM_DDS_PROFILE")
      ->capture_default_str();
  app.add_option("--security,--dds-security", options.security,
                 "directory of certificates and permissions that make_security.sh made")
      ->envname("EHM_DDS_SECURITY");
}

idl::ParticipantOptions participant_options(const ClientOptions& options, const std::string& program) {
  idl::ParticipantOptions participant;
  participant.domain = options.domain;
  participant.name = program;
  participant.profiles_file = options.profiles_file;
  participant.profile = options.profile;
  participant.partition = options.partition;
  participant.security = options.security;
  participant.on_incompatible = [program](const std::string& what) { std::cerr << program << ": " << what << '\n'; };
  participant.on_unreadable = [program](bool, const std::string& what) {
    std::cerr << program << ": " << what << '\n';
  };
  return participant;
}

void check_files(const ClientOptions& options) {
  idl::check_security(options.security);
  idl::check_profile(participant_options(options, ""));
}

}  // namespace ehm::client
