// SPDX-License-Identifier: Apache-2.0
#include "idl/dds/security_files.h"

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <memory>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/input_file.h"
#include "idl/dds/dds_error.h"

namespace ehm::idl {

namespace {

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Bio = std::unique_ptr<BIO, Freed<BIO_free_all>>;
using Pkcs7 = std::unique_ptr<PKCS7, Freed<PKCS7_free>>;
using Store = std::unique_ptr<X509_STORE, Freed<X509_STORE_free>>;
using RevocationList = std::unique_ptr<X509_CRL, Freed<X509_CRL_free>>;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw DdsError("security file " + path + ": " + what);
}

std::string content_of(const std::string& path) {
  std::string content;
  try {
    content = files::read_input_file(path, files::security_file);
  } catch (const files::FileError& e) {
    throw DdsError(std::string("security file ") + e.what() +
                   " dds.security names a directory that make_security.sh made");
  }
  if (content.empty()) refuse(path, "is empty");
  return content;
}

/// Reads from `text`, which must outlive it.
Bio reader_of(const std::string& text) {
  return Bio(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

Certificate read_certificate(const std::string& path) {
  const std::string text = content_of(path);
  Certificate certificate(PEM_read_bio_X509(reader_of(text).get(), nullptr, nullptr, nullptr));
  if (!certificate) refuse(path, "is not an X.509 certificate in PEM");
  return certificate;
}

std::int64_t seconds_of(const ASN1_TIME* time) {
  std::tm parts{};
  return ASN1_TIME_to_tm(time, &parts) == 1 ? timegm(&parts) : 0;
}

void require_in_time(const Certificate& certificate, const std::string& path) {
  if (X509_cmp_current_time(X509_get0_notBefore(certificate.get())) > 0)
    refuse(path, "the certificate is not valid yet; is the clock of this machine right?");
  if (X509_cmp_current_time(X509_get0_notAfter(certificate.get())) <= 0)
    refuse(path, "the certificate has expired; make_security.sh --renew makes a new one");
}

void require_fitting_key(const Certificate& certificate, const std::string& directory) {
  const std::string path = directory + "/key.pem", text = content_of(path);
  const Key key(PEM_read_bio_PrivateKey(reader_of(text).get(), nullptr, nullptr, nullptr));
  if (!key) refuse(path, "is not a private key in PEM");
  if (X509_check_private_key(certificate.get(), key.get()) != 1)
    refuse(path, "is not the key of cert.pem beside it; copy the folder whole");
}

/// A document signed by the authority for permissions.
void require_signed(const std::string& path, X509* authority) {
  const std::string text = content_of(path);
  BIO* content = nullptr;
  const Pkcs7 document(SMIME_read_PKCS7(reader_of(text).get(), &content));
  const Bio signed_content(content);
  if (!document) refuse(path, "is not a signed document (S/MIME)");
  const Store store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority);
  const Bio nowhere(BIO_new(BIO_s_null()));
  if (PKCS7_verify(document.get(), nullptr, store.get(), signed_content.get(), nowhere.get(), PKCS7_TEXT) != 1)
    refuse(path, "was not signed by permissions_ca.pem beside it, or was changed since; copy the folder whole");
}

std::string list_path(const std::string& directory) {
  return directory + "/identity_crl.pem";
}

void require_readable_list(const std::string& directory) {
  const std::string path = list_path(directory);
  if (!std::filesystem::exists(path)) return;
  const std::string text = content_of(path);
  const RevocationList list(PEM_read_bio_X509_CRL(reader_of(text).get(), nullptr, nullptr, nullptr));
  if (!list) refuse(path, "is not a list of revoked certificates in PEM");
}

std::string fingerprint_of(const std::string& directory) {
  std::string all;
  for (const char* file : {"/identity_ca.pem", "/cert.pem", "/key.pem", "/permissions_ca.pem", "/governance.p7s",
                           "/permissions.p7s", "/identity_crl.pem"}) {
    const std::string path = directory + file;
    const std::string content = std::filesystem::exists(path) ? content_of(path) : std::string();
    all += std::to_string(content.size()) + ":" + content;
  }
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  EVP_Digest(all.data(), all.size(), digest.data(), &length, EVP_sha256(), nullptr);
  constexpr const char* digits = "0123456789abcdef";
  std::string hex;
  for (unsigned i = 0; i < length; ++i) {
    hex += digits[digest[i] >> 4];
    hex += digits[digest[i] & 15];
  }
  return hex;
}

}  // namespace

IdentityFacts examine_identity(const std::string& directory) {
  const std::string path = directory + "/cert.pem";
  read_certificate(directory + "/identity_ca.pem");
  const Certificate certificate = read_certificate(path);
  require_in_time(certificate, path);
  require_fitting_key(certificate, directory);
  const Certificate authority = read_certificate(directory + "/permissions_ca.pem");
  for (const char* document : {"/governance.p7s", "/permissions.p7s"})
    require_signed(directory + document, authority.get());
  require_readable_list(directory);
  return {seconds_of(X509_get0_notAfter(certificate.get())), fingerprint_of(directory)};
}

}  // namespace ehm::idl
