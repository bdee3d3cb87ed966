#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/bus/identity.hpp"
#include "common/core/expected.hpp"
#include "services/lukou/keys/authority.hpp"

// What `lukou keys` keeps: DIR/authority, and DIR/<role> with the identity of each role. A role's folder is all that
// its process needs; the authority's key is needed only to make further ones.

namespace lukou::keys {

/// Every role that has an identity: clock, traffic-engine, signal-controller, recorder, observer, and the RSUs.
std::vector<std::string> roles(std::uint32_t rsus);

/// Keys are made in a new or an empty folder alone: none is ever overwritten.
Expected<Done> may_make(const std::filesystem::path& folder);
/// Makes an authority and the identities of all roles. Errors: not may_make(), or cannot be written.
Expected<Done> make_keys(const std::filesystem::path& folder, std::uint32_t rsus, const Validity& validity);

/// Whether there is such a role, and an authority to sign for it.
Expected<Done> may_issue(const std::filesystem::path& folder, const std::string& role);
/// Makes the identity of one role anew, or for the first time. Errors: not may_issue(), or cannot be written.
Expected<Done> issue(const std::filesystem::path& folder, const std::string& role, const Validity& validity);

/// A role's folder as it is found.
struct Found {
  std::string role;
  Expected<bus::Identity> identity;
};
/// All roles of the folder: the run's own in their order, then RSUs by number. Errors: no folder of keys.
Expected<std::vector<Found>> show(const std::filesystem::path& folder);

/// That a run can be secured with these: every role's identity is fit and of the same authority.
/// Returns warnings: what expires soon.
Expected<std::vector<std::string>> check(const std::filesystem::path& folder, std::uint32_t rsus);

}  // namespace lukou::keys
