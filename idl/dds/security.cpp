// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/security.h"

#include <array>
#include <ctime>
#include <filesystem>
#include <utility>

#include "idl/dds/security_files.h"

namespace ehm::idl {

using eprosima::fastrtps::rtps::Property;

std::vector<Property> security_properties(const std::string& directory) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> files{{
      {"dds.sec.auth.builtin.PKI-DH.identity_ca", "identity_ca.pem"},
      {"dds.sec.auth.builtin.PKI-DH.identity_certificate", "cert.pem"},
      {"dds.sec.auth.builtin.PKI-DH.private_key", "key.pem"},
      {"dds.sec.access.builtin.Access-Permissions.permissions_ca", "permissions_ca.pem"},
      {"dds.sec.access.builtin.Access-Permissions.governance", "governance.p7s"},
      {"dds.sec.access.builtin.Access-Permissions.permissions", "permissions.p7s"},
  }};
  examine_identity(directory);
  std::vector<Property> properties;
  properties.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
  properties.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
  properties.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
  const std::string in = "file://" + directory + "/";
  for (const auto& [property, file] : files) properties.emplace_back(property, in + file);
  if (std::filesystem::exists(directory + "/identity_crl.pem"))
    properties.emplace_back("dds.sec.auth.builtin.PKI-DH.identity_crl", in + "identity_crl.pem");
  return properties;
}

void check_security(const std::string& directory) {
  if (!directory.empty()) examine_identity(directory);
}

}  // namespace ehm::idl
