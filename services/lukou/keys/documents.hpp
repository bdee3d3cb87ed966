#pragma once

#include <string>
#include <string_view>

namespace lukou::keys {

// The two documents of DDS Security (OMG DDS-SECURITY 1.1, 9.4.1.2 and 9.4.1.3), unsigned.

/// How every secured run is protected: nobody without an identity takes part, discovery, samples and what keeps them
/// reliable are encrypted, and each topic is written and read only by whose permissions say so.
std::string governance_document();

/// What the holder of the subject `name` may write and read, as the role it is. `from`, `until`: UTC,
/// "2026-11-22T09:30:15Z".
std::string permissions_document(std::string_view role, const std::string& name, const std::string& from,
                                 const std::string& until);

}  // namespace lukou::keys
