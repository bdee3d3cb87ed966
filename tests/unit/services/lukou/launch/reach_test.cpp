#include "services/lukou/launch/reach.hpp"

#include <gtest/gtest.h>

namespace lukou::launch {
namespace {

using Words = std::vector<std::string>;

TEST(Prefixes, NameARoleAndTheWordsInFrontOfItsCommand) {
  const auto found = prefixes({"rsu1=ip netns exec b", "traffic-engine=ssh -p 22 host"}, 2);
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found.value().at("rsu1"), (Words{"ip", "netns", "exec", "b"}));
  EXPECT_EQ(found.value().at("traffic-engine"), (Words{"ssh", "-p", "22", "host"}));
}

TEST(Prefixes, RefuseWhatIsNoRoleOfTheRunWithTheListOfRoles) {
  for (const std::string wrong : {"rsu2=ip netns exec b", "engine=nice", "rsu0", "=nice"}) {
    const auto found = prefixes({wrong}, 2);
    ASSERT_FALSE(found.ok()) << wrong;
    EXPECT_NE(found.error().text().find("traffic-engine signal-controller recorder rsu0 rsu1 clock"), std::string::npos)
        << found.error().text();
  }
}

TEST(Prefixes, RefuseNothingAndASecondOne) {
  EXPECT_FALSE(prefixes({"rsu0= "}, 1).ok());
  EXPECT_FALSE(prefixes({"rsu0=nice", "rsu0=nice -n 5"}, 1).ok());
}

TEST(Prefixes, KeepWhoeverWorksInTheResultFolderOnThisHost) {
  EXPECT_FALSE(prefixes({"recorder=ssh host"}, 1).ok());
  EXPECT_FALSE(prefixes({"clock=/usr/bin/ssh host"}, 1).ok());
  EXPECT_TRUE(prefixes({"recorder=ip netns exec b"}, 1).ok());
}

TEST(Behind, HandsWordsAndVariablesToAProgramOfThisHost) {
  const ChildSpec child =
      behind({"ip", "netns", "exec", "b"}, "/bin/lukou",
             {.role = "rsu0", .command = {"rsu", "--index", "0"}, .environment = {"A=1"}, .core = 1});
  EXPECT_EQ(child.command, (Words{"ip", "netns", "exec", "b", "rsu", "--index", "0"}));
  EXPECT_EQ(child.environment, Words{"A=1"});
  EXPECT_FALSE(child.core.has_value()) << "the place chooses its processor";
  EXPECT_FALSE(child.leashed);
}

TEST(Behind, HandsSshOneLineThatItsShellReadsBackAsTheSameWords) {
  const ChildSpec child = behind({"ssh", "host"}, "/opt/my lukou/bin/lukou",
                                 {.role = "rsu0", .command = {"/bin/sh", "-c", "exec it's"}, .environment = {"A=x y"}});
  ASSERT_EQ(child.command.size(), 3U);
  EXPECT_EQ(child.command.back(),
            R"(exec env 'A=x y' '/opt/my lukou/bin/lukou' leash -- '/bin/sh' '-c' 'exec it'\''s')");
  EXPECT_TRUE(child.environment.empty());
  EXPECT_TRUE(child.leashed);
}

TEST(Reach, GivesEachRoleItsOwnIdentityAndNobodyAnothers) {
  const Reach reach{.peers = {"10.0.0.1", "10.0.0.2"}, .keys = "/keys"};
  EXPECT_EQ(reach.environment("rsu0"), (Words{"LUKOU_IDENTITY=/keys/rsu0", "LUKOU_PEERS=10.0.0.1,10.0.0.2"}));
  EXPECT_EQ(Reach{}.environment("rsu0"), (Words{"LUKOU_IDENTITY=", "LUKOU_PEERS="})) << "nothing is inherited";
}

}  // namespace
}  // namespace lukou::launch
