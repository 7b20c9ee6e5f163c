#include "idl/dds/security.h"

#include <openssl/pem.h>
#include <openssl/x509.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "idl/dds/dds_error.h"

namespace ehm::wire {

using eprosima::fastrtps::rtps::Property;

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// Null where there is no such file; a file that is there and cannot be read is an error.
File open_if_there(const std::string& path) {
  File file(std::fopen(path.c_str(), "r"), &std::fclose);
  if (!file && errno != ENOENT) throw DdsError("security file '" + path + "' cannot be read: " + std::strerror(errno));
  return file;
}

File open_file(const std::string& path) {
  File file = open_if_there(path);
  if (!file)
    throw DdsError("security file '" + path +
                   "' does not exist; dds.security names a directory that make_security.sh made");
  return file;
}

/// PEM and S/MIME files are never empty; a directory opens, but gives no byte.
std::string readable(const std::string& path) {
  if (std::fgetc(open_file(path).get()) == EOF) throw DdsError("security file '" + path + "' is empty or a directory");
  return "file://" + path;
}

}  // namespace

double certificate_days_left(const std::string& directory) {
  const std::string path = directory + "/cert.pem";
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      PEM_read_X509(open_file(path).get(), nullptr, nullptr, nullptr), &X509_free);
  int days = 0, seconds = 0;
  if (!certificate || ASN1_TIME_diff(&days, &seconds, nullptr, X509_get0_notAfter(certificate.get())) != 1)
    throw DdsError("security file '" + path + "' is not an X.509 certificate in PEM");
  return days + seconds / 86400.0;
}

std::vector<Property> security_properties(const std::string& directory) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> files{{
      {"dds.sec.auth.builtin.PKI-DH.identity_ca", "identity_ca.pem"},
      {"dds.sec.auth.builtin.PKI-DH.identity_certificate", "cert.pem"},
      {"dds.sec.auth.builtin.PKI-DH.private_key", "key.pem"},
      {"dds.sec.access.builtin.Access-Permissions.permissions_ca", "permissions_ca.pem"},
      {"dds.sec.access.builtin.Access-Permissions.governance", "governance.p7s"},
      {"dds.sec.access.builtin.Access-Permissions.permissions", "permissions.p7s"},
  }};
  std::vector<Property> properties;
  properties.emplace_back("dds.sec.auth.plugin", "builtin.PKI-DH");
  properties.emplace_back("dds.sec.access.plugin", "builtin.Access-Permissions");
  properties.emplace_back("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
  for (const auto& [property, file] : files) properties.emplace_back(property, readable(directory + "/" + file));
  if (const std::string revoked = directory + "/identity_crl.pem"; open_if_there(revoked))
    properties.emplace_back("dds.sec.auth.builtin.PKI-DH.identity_crl", readable(revoked));
  if (certificate_days_left(directory) <= 0.0)
    throw DdsError("security file '" + directory +
                   "/cert.pem': the certificate has expired; make_security.sh --renew makes a new one");
  return properties;
}

void check_security(const std::string& directory) {
  if (!directory.empty()) security_properties(directory);
}

}  // namespace ehm::wire
