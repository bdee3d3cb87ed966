#include "services/console/gate.hpp"

#include <gtest/gtest.h>

namespace lukou::console {
namespace {

const std::string kToken = "abcdefghijklmnop";

unsigned status(const Gate& gate, const Visit& visit) { return gate.check(visit).status; }

TEST(Gate, WithoutATokenAnswersToThisHostsNamesAlone) {
  const Gate gate("");
  for (const char* host : {"127.0.0.1:8080", "127.0.0.1", "localhost:9999", "[::1]:8080", "[::1]"}) {
    EXPECT_EQ(status(gate, {.host = host, .target = "/"}), 200U) << host;
  }
  for (const char* host :
       {"evil.example", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil", "10.0.0.1"}) {
    EXPECT_EQ(status(gate, {.host = host, .target = "/"}), 403U) << host;
  }
  EXPECT_EQ(status(gate, {.target = "/"}), 400U) << "no host at all";
}

TEST(Gate, LetsNoPageOfAnotherSiteIn) {
  const Gate gate("");
  const auto socket = [&](std::string_view origin) {
    return status(gate, {.host = "localhost:8080", .origin = origin, .target = "/ws", .socket = true});
  };
  EXPECT_EQ(socket("http://localhost:8080"), 200U);
  EXPECT_EQ(socket("https://localhost:8080"), 200U);
  EXPECT_EQ(socket("http://localhost:8081"), 403U) << "another port is another site";
  EXPECT_EQ(socket("http://evil.example"), 403U);
  EXPECT_EQ(socket("http://localhost:8080.evil.example"), 403U);
  EXPECT_EQ(socket("null"), 403U);
  EXPECT_EQ(socket(""), 403U) << "a browser always says where its page is from";
  EXPECT_EQ(status(gate, {.host = "localhost:8080", .origin = "http://evil.example", .target = "/"}), 403U);
}

TEST(Gate, WithATokenAsksForItInTheQueryOrTheCookie) {
  const Gate gate(kToken);
  const auto visit = [&](const std::string& target, const std::string& cookie) {
    return gate.check({.host = "far.example:8080", .target = target, .cookie = cookie});
  };
  EXPECT_EQ(visit("/", "").status, 401U);
  EXPECT_EQ(visit("/?token=" + kToken, "").status, 200U);
  EXPECT_TRUE(visit("/?token=" + kToken, "").new_cookie);
  EXPECT_EQ(visit("/?a=b&token=" + kToken + "&c=d", "").status, 200U);
  EXPECT_EQ(visit("/?token=" + kToken + "x", "").status, 401U);
  EXPECT_EQ(visit("/?token=" + kToken.substr(1), "").status, 401U);
  EXPECT_EQ(visit("/?token=", "").status, 401U);
  EXPECT_EQ(visit("/?mytoken=" + kToken, "").status, 401U);
  EXPECT_EQ(visit("/", "other=1; lukou_token=" + kToken).status, 200U);
  EXPECT_FALSE(visit("/", "lukou_token=" + kToken).new_cookie);
  EXPECT_EQ(visit("/", "lukou_token=wrong").status, 401U);
  EXPECT_EQ(visit("/?token=wrong", "lukou_token=" + kToken).status, 200U) << "an old address in a known browser";
}

TEST(Gate, ComparesWholeTexts) {
  EXPECT_TRUE(equal_in_constant_time("", ""));
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "xbc"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abcd"));
}

TEST(Gate, KnowsWhatFitsForAToken) {
  EXPECT_TRUE(fit_for_token("abc-DEF_01234567"));
  EXPECT_FALSE(fit_for_token("abc-DEF_0123456")) << "15";
  EXPECT_FALSE(fit_for_token("abcdefghijklmnop;")) << "would end the cookie";
  EXPECT_FALSE(fit_for_token(std::string(201, 'a')));
}

}  // namespace
}  // namespace lukou::console
