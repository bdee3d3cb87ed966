#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"

namespace lukou::bus {

// Files of an identity's folder; `lukou keys` makes them.
inline constexpr std::string_view kAuthorityFile = "authority.pem";      ///< certificate of who signed all of it
inline constexpr std::string_view kCertificateFile = "identity.pem";     ///< who the process is
inline constexpr std::string_view kKeyFile = "identity.key";             ///< private
inline constexpr std::string_view kPermissionsFile = "permissions.p7s";  ///< what it may write and read
inline constexpr std::string_view kGovernanceFile = "governance.p7s";    ///< how a secured run is protected

/// Who a process is in a secured run.
struct Identity {
  std::filesystem::path folder;  ///< absolute
  std::string role;              ///< "traffic-engine", "rsu0", "observer", ...
  std::string authority;         ///< name of who signed it: identities of one run have the same
  double days_left = 0.0;        ///< until it expires
};

/// Errors: no folder, a file that is missing or cannot be read, a certificate that this authority did not sign, that
/// does not belong to the key, that has expired or is not valid yet.
Expected<Identity> open_identity(const std::filesystem::path& folder);

}  // namespace lukou::bus
