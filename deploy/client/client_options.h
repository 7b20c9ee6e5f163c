// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the tools that people start by hand join DDS: the same options and environment variables for each of them.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "idl/dds/participant.h"

namespace ehm::client {

struct ClientOptions {
  std::uint32_t domain = 0;
  std::string partition, profiles_file, profile = "ehm_participant", security;
};

/// --domain, --partition, --profiles-file, --profile, --security; each also by the services' name and variable.
void add_client_options(CLI::App& app, ClientOptions& options);
/// `program` is the name that other participants see, and begins each line on standard error about peers that cannot
/// be heard.
idl::ParticipantOptions participant_options(const ClientOptions& options, const std::string& program);
/// Does nothing if the files that are named can be used. @throws idl::DdsError naming the file
void check_files(const ClientOptions& options);

}  // namespace ehm::client
