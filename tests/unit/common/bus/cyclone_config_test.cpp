#include "common/bus/cyclone_config.hpp"

#include <gtest/gtest.h>

namespace lukou::bus {
namespace {

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
  expect_tag_last(cyclone_config("paper-1-ab12", nullptr), "lukou-paper-1-ab12");
  expect_tag_last(cyclone_config("paper-1-ab12", ""), "lukou-paper-1-ab12");
  expect_tag_last(cyclone_config("paper-1-ab12", "file:///etc/cyclone.xml"), "lukou-paper-1-ab12");
}

TEST(CycloneConfig, StaysOnTheLoopbackUnlessTheUserSaysOtherwise) {
  for (const char* unset : {static_cast<const char*>(nullptr), ""}) {
    const std::string config = cyclone_config("r", unset);
    EXPECT_NE(config.find("<NetworkInterface name=\"lo\" multicast=\"false\"/>"), std::string::npos);
    EXPECT_NE(config.find("<AllowMulticast>false</AllowMulticast>"), std::string::npos);
    EXPECT_NE(config.find("<Peer Address=\"127.0.0.1\"/>"), std::string::npos);
  }
}

TEST(CycloneConfig, LetsTheUsersInterfacesStandAlone) {
  const std::string users =
      "<Domain><General><Interfaces><NetworkInterface name=\"eth0\"/></Interfaces></General></Domain>";
  const std::string config = cyclone_config("r", users.c_str());
  EXPECT_EQ(config.find("name=\"lo\""), std::string::npos);
  EXPECT_EQ(config.find("127.0.0.1"), std::string::npos);
  EXPECT_EQ(config.find("AllowMulticast"), std::string::npos);
  EXPECT_EQ(count(config, users), 1U);
}

TEST(CycloneConfig, AppendsTheUsersWordBehindOursAndBeforeTheTag) {
  const std::string users = "file:///etc/cyclone.xml";
  const std::string config = cyclone_config("r", users.c_str());
  const std::size_t at = config.find("," + users + ",");
  ASSERT_NE(at, std::string::npos) << "a list: ours, the user's, the tag";
  EXPECT_LT(config.find("<WhcHigh>"), at);
  EXPECT_GT(config.find("<Tag>"), at);
}

TEST(CycloneConfig, KeepsLargeBatchesAndDeadReadersFromBlockingARun) {
  for (const char* users : {static_cast<const char*>(nullptr), "file:///etc/cyclone.xml"}) {
    const std::string config = cyclone_config("r", users);
    EXPECT_NE(config.find("<WhcHigh>1GB</WhcHigh>"), std::string::npos);
    EXPECT_NE(config.find("<FragmentSize>64000B</FragmentSize>"), std::string::npos);
    EXPECT_NE(config.find("<WriterLingerDuration>0s</WriterLingerDuration>"), std::string::npos);
    EXPECT_NE(config.find("<LeaseDuration>60s</LeaseDuration>"), std::string::npos);
  }
}

TEST(CycloneConfig, IsWellFormed) {
  const std::string config = cyclone_config("r", nullptr);
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
