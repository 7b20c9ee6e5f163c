#include "idl/dds/security.h"

#include <openssl/pem.h>
#include <openssl/x509.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "deploy/files/file_error.h"
#include "deploy/files/input_file.h"
#include "idl/dds/dds_error.h"

namespace ehm::wire {

using eprosima::fastrtps::rtps::Property;

namespace {

std::string content_of(const std::string& path) {
  try {
    return files::read_input_file(path, files::security_file);
  } catch (const files::FileError& e) {
    throw DdsError(std::string("security file ") + e.what() +
                   " dds.security names a directory that make_security.sh made");
  }
}

/// PEM and S/MIME files are never empty.
std::string readable(const std::string& path) {
  if (content_of(path).empty()) throw DdsError("security file " + path + ": is empty");
  return "file://" + path;
}

}  // namespace

double certificate_days_left(const std::string& directory) {
  const std::string path = directory + "/cert.pem";
  const std::string text = content_of(path);
  const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())),
                                                      &BIO_free);
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr),
                                                                &X509_free);
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
  if (const std::string revoked = directory + "/identity_crl.pem"; std::filesystem::exists(revoked))
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
