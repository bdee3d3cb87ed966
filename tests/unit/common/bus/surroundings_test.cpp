#include "common/bus/surroundings.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace lukou::bus {
namespace {

TEST(OwnAddress, TowardsThisHostIsTheSame) {
  const auto own = own_address_towards("127.0.0.1");
  ASSERT_TRUE(own.ok()) << own.error().text();
  EXPECT_EQ(own.value(), "127.0.0.1");
}

TEST(OwnAddress, TakesNames) {
  const auto own = own_address_towards("localhost");
  ASSERT_TRUE(own.ok()) << own.error().text();
  EXPECT_EQ(own.value(), "127.0.0.1");
}

TEST(OwnAddress, NamesAPeerThatNobodyKnows) {
  const auto own = own_address_towards("no such host");
  ASSERT_FALSE(own.ok());
  EXPECT_NE(own.error().text().find("`no such host`"), std::string::npos);
}

TEST(SecurityPlugins, LieBesideTheLibrary) {
  const auto folder = security_plugins();
  ASSERT_TRUE(folder.ok()) << folder.error().text();
  for (const std::string file : {"auth", "ac", "crypto"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.value() + "/libdds_security_" + file + ".so")) << file;
  }
}

}  // namespace
}  // namespace lukou::bus
