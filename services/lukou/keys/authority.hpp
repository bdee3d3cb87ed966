#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/core/expected.hpp"

namespace lukou::keys {

/// When an identity counts, relative to now [days].
struct Validity {
  double from = 0.0;
  double until = 365.0;
};

/// Who signs identities and permissions: a private key and its own certificate. Elliptic curve P-256, SHA-256.
class Authority {
 public:
  /// With a new key and a name of its own.
  static Expected<Authority> create(const Validity& validity);
  /// From the folder that save() filled. Errors: a file that is missing or unfit.
  static Expected<Authority> open(const std::filesystem::path& folder);
  Authority(Authority&&) noexcept;
  Authority& operator=(Authority&&) noexcept;
  ~Authority();

  /// Writes key and certificate into an existing folder; the key for its owner alone.
  [[nodiscard]] Expected<Done> save(const std::filesystem::path& folder) const;
  /// Makes a key pair and writes the five files of a role's identity (common/bus/identity.hpp) into an existing folder.
  [[nodiscard]] Expected<Done> issue(const std::filesystem::path& folder, const std::string& role,
                                     const Validity& validity) const;

 private:
  struct Parts;
  explicit Authority(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace lukou::keys
