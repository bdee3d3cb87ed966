#include "services/lukou/keys/authority.hpp"

#include <fcntl.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <ctime>
#include <functional>

#include "common/bus/identity.hpp"
#include "services/lukou/keys/documents.hpp"

namespace lukou::keys {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kAuthorityKeyFile = "authority.key";
constexpr double kSecondsPerDay = 86400.0;

template <class T, void (*free_one)(T*)>
struct Freer {
  void operator()(T* object) const { free_one(object); }
};
void free_bio(BIO* bio) { BIO_free(bio); }
using Key = std::unique_ptr<EVP_PKEY, Freer<EVP_PKEY, EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freer<X509, X509_free>>;
using Extension = std::unique_ptr<X509_EXTENSION, Freer<X509_EXTENSION, X509_EXTENSION_free>>;
using Signature = std::unique_ptr<PKCS7, Freer<PKCS7, PKCS7_free>>;
using Bytes = std::unique_ptr<BIO, Freer<BIO, free_bio>>;

/// OpenSSL's own word on what just failed.
Error failed(const std::string& what) {
  std::array<char, 256> text{};
  ERR_error_string_n(ERR_get_error(), text.data(), text.size());
  return Error{what, text.data()};
}

Expected<Key> new_key() {
  Key key(EVP_EC_gen("P-256"));
  if (!key) return failed("a new key");
  return key;
}

/// A number that no other certificate of ours will have, as hexadecimal digits.
Expected<std::string> random_digits() {
  std::array<unsigned char, 8> random{};
  if (RAND_bytes(random.data(), random.size()) != 1) return failed("random numbers");
  random[0] &= 0x7fU;  // a serial number is positive
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string digits;
  for (const unsigned char byte : random) {
    digits += kDigits[byte >> 4U];
    digits += kDigits[byte & 15U];
  }
  return digits;
}

struct Request {
  std::string common_name;
  bool authority = false;
  Validity validity;
};

bool extend(X509* certificate, int kind, const char* value) {
  const Extension extension(X509V3_EXT_conf_nid(nullptr, nullptr, kind, value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool set_time(ASN1_TIME* moment, double days) {
  return X509_gmtime_adj(moment, std::lround(days * kSecondsPerDay)) != nullptr;
}

/// A certificate for `key`, signed with `signer`; `issuer`: null = it signs itself.
Expected<Certificate> certify(const Request& request, EVP_PKEY* key, const X509* issuer, EVP_PKEY* signer) {
  const auto serial = random_digits();
  if (!serial) return serial.error();
  Certificate certificate(X509_new());
  X509* const one = certificate.get();
  BIGNUM* number = nullptr;
  BN_hex2bn(&number, serial.value().c_str());
  BN_to_ASN1_INTEGER(number, X509_get_serialNumber(one));
  BN_free(number);
  X509_NAME* const subject = X509_get_subject_name(one);
  const auto* name = reinterpret_cast<const unsigned char*>(request.common_name.c_str());
  const bool filled =
      X509_set_version(one, X509_VERSION_3) == 1 && set_time(X509_getm_notBefore(one), request.validity.from) &&
      set_time(X509_getm_notAfter(one), request.validity.until) &&
      X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_UTF8, name, -1, -1, 0) == 1 &&
      X509_set_issuer_name(one, issuer == nullptr ? subject : X509_get_subject_name(issuer)) == 1 &&
      X509_set_pubkey(one, key) == 1 &&
      // Who holds an identity cannot make others.
      extend(one, NID_basic_constraints, request.authority ? "critical,CA:TRUE,pathlen:0" : "critical,CA:FALSE") &&
      extend(one, NID_key_usage,
             request.authority ? "critical,keyCertSign,cRLSign,digitalSignature" : "critical,digitalSignature");
  if (!filled || X509_sign(one, signer, EVP_sha256()) == 0) return failed("a certificate for " + request.common_name);
  return certificate;
}

Expected<Done> write_file(const fs::path& path, mode_t mode, const std::function<bool(BIO*)>& fill) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) return Error{path.string(), std::string("cannot be written: ") + std::strerror(errno)};
  const Bytes file(BIO_new_fd(descriptor, BIO_CLOSE));
  if (!fill(file.get())) return Error{path.string(), "cannot be written"};
  return Done{};
}

Expected<Done> write_key(const fs::path& path, EVP_PKEY* key) {
  return write_file(path, 0600, [&](BIO* file) {
    return PEM_write_bio_PrivateKey(file, key, nullptr, nullptr, 0, nullptr, nullptr) == 1;
  });
}

Expected<Done> write_certificate(const fs::path& path, X509* certificate) {
  return write_file(path, 0644, [&](BIO* file) { return PEM_write_bio_X509(file, certificate) == 1; });
}

std::string iso(const ASN1_TIME* moment) {
  std::tm parts{};
  std::array<char, 32> written{};
  ASN1_TIME_to_tm(moment, &parts);
  std::strftime(written.data(), written.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return written.data();
}

}  // namespace

struct Authority::Parts {
  Key key;
  Certificate certificate;

  /// The document as S/MIME, inside its signature: as a text beside it, it would tell the names of the topics to
  /// whoever reads the handshake.
  [[nodiscard]] Expected<Done> write_signed(const fs::path& path, const std::string& document) const {
    const Bytes text(BIO_new_mem_buf(document.data(), static_cast<int>(document.size())));
    const Signature signature(PKCS7_sign(certificate.get(), key.get(), nullptr, text.get(), PKCS7_TEXT));
    if (!signature) return failed(path.string());
    return write_file(path, 0644,
                      [&](BIO* file) { return SMIME_write_PKCS7(file, signature.get(), nullptr, PKCS7_TEXT) == 1; });
  }
};

Authority::Authority(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Authority::Authority(Authority&&) noexcept = default;
Authority& Authority::operator=(Authority&&) noexcept = default;
Authority::~Authority() = default;

Expected<Authority> Authority::create(const Validity& validity) {
  const auto name = random_digits();
  if (!name) return name.error();
  auto key = new_key();
  if (!key) return key.error();
  EVP_PKEY* const own = key.value().get();
  auto certificate =
      certify({.common_name = "lukou authority " + name.value().substr(8), .authority = true, .validity = validity},
              own, nullptr, own);
  if (!certificate) return certificate.error();
  auto parts = std::make_unique<Parts>();
  parts->key = std::move(key).value();
  parts->certificate = std::move(certificate).value();
  return Authority(std::move(parts));
}

Expected<Authority> Authority::open(const fs::path& folder) {
  auto parts = std::make_unique<Parts>();
  const fs::path key = folder / kAuthorityKeyFile;
  if (const Bytes file(BIO_new_file(key.c_str(), "r")); file) {
    parts->key.reset(PEM_read_bio_PrivateKey(file.get(), nullptr, nullptr, nullptr));
  }
  if (!parts->key) return Error{key.string(), "cannot be read: without the authority's key nothing can be signed"};
  const fs::path certificate = folder / bus::kAuthorityFile;
  if (const Bytes file(BIO_new_file(certificate.c_str(), "r")); file) {
    parts->certificate.reset(PEM_read_bio_X509(file.get(), nullptr, nullptr, nullptr));
  }
  if (!parts->certificate || X509_check_private_key(parts->certificate.get(), parts->key.get()) != 1) {
    return Error{certificate.string(), "is not the certificate of " + key.string()};
  }
  return Authority(std::move(parts));
}

Expected<Done> Authority::save(const fs::path& folder) const {
  if (auto done = write_key(folder / kAuthorityKeyFile, parts_->key.get()); !done) return done;
  return write_certificate(folder / bus::kAuthorityFile, parts_->certificate.get());
}

Expected<Done> Authority::issue(const fs::path& folder, const std::string& role, const Validity& validity) const {
  auto key = new_key();
  if (!key) return key.error();
  const auto certificate = certify({.common_name = role, .validity = validity}, key.value().get(),
                                   parts_->certificate.get(), parts_->key.get());
  if (!certificate) return certificate.error();
  X509* const own = certificate.value().get();
  if (auto done = write_key(folder / bus::kKeyFile, key.value().get()); !done) return done;
  if (auto done = write_certificate(folder / bus::kCertificateFile, own); !done) return done;
  if (auto done = write_certificate(folder / bus::kAuthorityFile, parts_->certificate.get()); !done) return done;
  if (auto done = parts_->write_signed(folder / bus::kGovernanceFile, governance_document()); !done) return done;
  return parts_->write_signed(
      folder / bus::kPermissionsFile,
      permissions_document(role, "CN=" + role, iso(X509_get0_notBefore(own)), iso(X509_get0_notAfter(own))));
}

}  // namespace lukou::keys
