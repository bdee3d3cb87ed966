#include "common/bus/cyclone_config.hpp"

#include <gtest/gtest.h>

namespace lukou::bus {
namespace {

/// Of an unsecured run on one host.
std::string plain(const std::string& run, const std::string& users_uri = "") {
  return cyclone_config({.run = run, .users_uri = users_uri});
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Cyclone takes the last word on a setting: what stands behind wins.
void expect_tag_last(const std::string& config, const std::string& tag) {
  const std::string element = "<Tag>" + tag + "</Tag>";
  const std::size_t at = config.find(element);
  ASSERT_NE(at, std::string::npos) << config;
  EXPECT_EQ(config.substr(at), element + "</Discovery></Domain>") << "nothing may follow that could replace it";
}

TEST(CycloneConfig, ClosesTheRunToOthersByItsTag) {
  expect_tag_last(plain("paper-1-ab12"), "lukou-paper-1-ab12");
  expect_tag_last(plain("paper-1-ab12", "file:///etc/cyclone.xml"), "lukou-paper-1-ab12");
}

TEST(CycloneConfig, StaysOnTheLoopbackUnlessTheUserSaysOtherwise) {
  const std::string config = plain("r");
  EXPECT_NE(config.find("<NetworkInterface name=\"lo\" multicast=\"false\"/>"), std::string::npos);
  EXPECT_NE(config.find("<AllowMulticast>false</AllowMulticast>"), std::string::npos);
  EXPECT_NE(config.find("<Peer Address=\"127.0.0.1\"/>"), std::string::npos);
}

TEST(CycloneConfig, LetsTheUsersInterfacesStandAlone) {
  const std::string users =
      "<Domain><General><Interfaces><NetworkInterface name=\"eth0\"/></Interfaces></General></Domain>";
  const std::string config = plain("r", users);
  EXPECT_EQ(config.find("name=\"lo\""), std::string::npos);
  EXPECT_EQ(config.find("127.0.0.1"), std::string::npos);
  EXPECT_EQ(config.find("AllowMulticast"), std::string::npos);
  EXPECT_EQ(count(config, users), 1U);
}

TEST(CycloneConfig, AppendsTheUsersWordBehindOursAndBeforeTheTag) {
  const std::string users = "file:///etc/cyclone.xml";
  const std::string config = plain("r", users);
  const std::size_t at = config.find("," + users + ",");
  ASSERT_NE(at, std::string::npos) << "a list: ours, the user's, the tag";
  EXPECT_LT(config.find("<WhcHigh>"), at);
  EXPECT_GT(config.find("<Tag>"), at);
}

TEST(CycloneConfig, KeepsLargeBatchesAndDeadReadersFromBlockingARun) {
  for (const std::string users : {"", "file:///etc/cyclone.xml"}) {
    const std::string config = plain("r", users);
    EXPECT_NE(config.find("<WhcHigh>1GB</WhcHigh>"), std::string::npos);
    EXPECT_NE(config.find("<FragmentSize>64000B</FragmentSize>"), std::string::npos);
    EXPECT_NE(config.find("<WriterLingerDuration>0s</WriterLingerDuration>"), std::string::npos);
    EXPECT_NE(config.find("<LeaseDuration>60s</LeaseDuration>"), std::string::npos);
  }
}

TEST(CycloneConfig, FacesThePeersAloneWhenARunHasSeveralHosts) {
  const std::string config =
      cyclone_config({.run = "r", .peers = {"10.1.2.3", "b.example"}, .own_address = "10.1.2.3"});
  EXPECT_NE(config.find("<NetworkInterface address=\"10.1.2.3\" multicast=\"false\"/>"), std::string::npos);
  EXPECT_NE(config.find("<Peers><Peer Address=\"10.1.2.3\"/><Peer Address=\"b.example\"/></Peers>"), std::string::npos);
  EXPECT_EQ(config.find("127.0.0.1"), std::string::npos);
  EXPECT_EQ(config.find("\"lo\""), std::string::npos);
  EXPECT_NE(config.find("<MaxMessageSize>1452B</MaxMessageSize>"), std::string::npos) << "fits into one packet";
}

TEST(CycloneConfig, SecuresARunBehindTheUsersWordSoThatHeCannotTakeItBack) {
  const Identity identity{.folder = "/keys of <me> & you/rsu0", .role = "rsu0"};
  const std::string config = cyclone_config(
      {.run = "r", .identity = &identity, .plugins = "/plugins", .users_uri = "file:///etc/cyclone.xml"});
  const std::size_t at = config.find("<Security>");
  EXPECT_GT(at, config.find("file:///etc/cyclone.xml"));
  EXPECT_NE(config.find("file:/keys of &lt;me&gt; &amp; you/rsu0/identity.key</PrivateKey>", at), std::string::npos);
  EXPECT_NE(config.find("path=\"/plugins/libdds_security_ac.so\" initFunction=\"init_access_control\"", at),
            std::string::npos);
}

TEST(CycloneConfig, DoesNotTellTheNameOfASecuredRunToTheWire) {
  const Identity identity{.folder = "/k/rsu0", .role = "rsu0"};
  const std::string config = cyclone_config({.run = "paper-1-ab12", .identity = &identity, .plugins = "/p"});
  EXPECT_EQ(config.find("paper-1-ab12"), std::string::npos);
  EXPECT_NE(discovery_tag("paper-1-ab12", true), discovery_tag("paper-1-ab13", true));
}

TEST(CycloneConfig, IsWellFormed) {
  const std::string config = plain("r");
  EXPECT_EQ(count(config, "<Domain id=\"any\">"), 2U);
  EXPECT_EQ(count(config, "</Domain>"), 2U);
  EXPECT_EQ(count(config, "<"), count(config, ">"));
  for (const char* element : {"General", "Discovery", "Interfaces", "Peers", "Internal", "Watermarks"}) {
    EXPECT_EQ(count(config, "<" + std::string(element) + ">"), count(config, "</" + std::string(element) + ">"))
        << element;
  }
}

}  // namespace
}  // namespace lukou::bus
