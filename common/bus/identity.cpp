#include "common/bus/identity.hpp"

#include <openssl/bio.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include <array>
#include <ctime>
#include <memory>

namespace lukou::bus {
namespace {

namespace fs = std::filesystem;

template <class T, void (*free_one)(T*)>
struct Freer {
  void operator()(T* object) const { free_one(object); }
};
using Certificate = std::unique_ptr<X509, Freer<X509, X509_free>>;
using Key = std::unique_ptr<EVP_PKEY, Freer<EVP_PKEY, EVP_PKEY_free>>;

struct File {
  explicit File(const fs::path& path) : bio(BIO_new_file(path.c_str(), "r")) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { BIO_free(bio); }
  BIO* bio;
};

Expected<Certificate> certificate_in(const fs::path& path) {
  const File file(path);
  if (file.bio == nullptr) return Error{path.string(), "cannot be read"};
  Certificate certificate(PEM_read_bio_X509(file.bio, nullptr, nullptr, nullptr));
  if (!certificate) return Error{path.string(), "holds no certificate (PEM)"};
  return certificate;
}

Expected<Key> key_in(const fs::path& path) {
  const File file(path);
  if (file.bio == nullptr) return Error{path.string(), "cannot be read"};
  Key key(PEM_read_bio_PrivateKey(file.bio, nullptr, nullptr, nullptr));
  if (!key) return Error{path.string(), "holds no private key (PEM)"};
  return key;
}

std::string common_name(const X509* certificate) {
  std::array<char, 65> name{};
  X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, name.data(), name.size());
  return name.data();
}

double days_until(const ASN1_TIME* moment) {
  int days = 0;
  int seconds = 0;
  ASN1_TIME_diff(&days, &seconds, nullptr, moment);
  return days + seconds / 86400.0;
}

std::string text(const ASN1_TIME* moment) {
  std::tm parts{};
  std::array<char, 32> written{};
  ASN1_TIME_to_tm(moment, &parts);
  std::strftime(written.data(), written.size(), "%Y-%m-%d %H:%M:%S UTC", &parts);
  return written.data();
}

}  // namespace

Expected<Identity> open_identity(const fs::path& folder) {
  std::error_code unreadable;
  if (!fs::is_directory(folder, unreadable)) {
    return Error{folder.string(), "is no folder of an identity; `lukou keys init DIR` makes DIR/<role>"};
  }
  for (const std::string_view name : {kAuthorityFile, kCertificateFile, kKeyFile, kPermissionsFile, kGovernanceFile}) {
    if (!fs::is_regular_file(folder / name, unreadable)) {
      return Error{(folder / name).string(), "is missing: an identity has five files, see docs/security.md"};
    }
  }
  const auto authority = certificate_in(folder / kAuthorityFile);
  if (!authority) return authority.error();
  const auto certificate = certificate_in(folder / kCertificateFile);
  if (!certificate) return certificate.error();
  const auto key = key_in(folder / kKeyFile);
  if (!key) return key.error();
  X509* const own = certificate.value().get();
  const std::string where = (folder / kCertificateFile).string();
  if (X509_verify(own, X509_get0_pubkey(authority.value().get())) != 1) {
    return Error{where, "was not signed by the authority of " + (folder / kAuthorityFile).string()};
  }
  if (X509_check_private_key(own, key.value().get()) != 1) {
    return Error{(folder / kKeyFile).string(), "is not the key of " + where};
  }
  const std::string role = common_name(own);
  if (X509_cmp_current_time(X509_get0_notBefore(own)) > 0) {
    return Error{where,
                 "is not valid before " + text(X509_get0_notBefore(own)) + "; is the clock of this computer right?"};
  }
  for (const X509* one : {static_cast<const X509*>(own), static_cast<const X509*>(authority.value().get())}) {
    if (X509_cmp_current_time(X509_get0_notAfter(one)) < 0) {
      return Error{where, "expired on " + text(X509_get0_notAfter(one)) + "; `lukou keys issue DIR " + role +
                              "` makes a new one"};
    }
  }
  return Identity{.folder = fs::absolute(folder),
                  .role = role,
                  .authority = common_name(authority.value().get()),
                  .days_left = days_until(X509_get0_notAfter(own))};
}

}  // namespace lukou::bus
