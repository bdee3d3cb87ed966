#include "services/lukou/keys/documents.hpp"

#include <vector>

#include "common/bus/rights.hpp"

namespace lukou::keys {
namespace {

// Whatever domain id a run may be given by hand.
constexpr std::string_view kEveryDomain = "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

std::string topics(const std::string& element, const std::vector<std::string>& names) {
  if (names.empty()) return "";
  std::string list;
  for (const std::string& name : names) list += "<topic>" + name + "</topic>";
  return "<" + element + "><topics>" + list + "</topics></" + element + ">";
}

}  // namespace

std::string governance_document() {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><domain_access_rules><domain_rule>
)" + std::string(kEveryDomain) +
         R"(
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>NONE</rtps_protection_kind>
<topic_access_rules><topic_rule>
<topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT</metadata_protection_kind>
<data_protection_kind>ENCRYPT</data_protection_kind>
</topic_rule></topic_access_rules>
</domain_rule></domain_access_rules></dds>
)";
}

std::string permissions_document(std::string_view role, const std::string& name, const std::string& from,
                                 const std::string& until) {
  const bus::Rights rights = bus::rights_of(role);
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<dds><permissions><grant name=")" +
         std::string(role) + R"(">
<subject_name>)" +
         name + R"(</subject_name>
<validity><not_before>)" +
         from + "</not_before><not_after>" + until + R"(</not_after></validity>
<allow_rule>)" +
         std::string(kEveryDomain) + topics("publish", rights.publish) + topics("subscribe", rights.subscribe) +
         R"(</allow_rule>
<default>DENY</default>
</grant></permissions></dds>
)";
}

}  // namespace lukou::keys
