#include "services/lukou/keys/key_folder.hpp"

#include <gtest/gtest.h>

#include "services/lukou/keys/documents.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::keys {
namespace {

namespace fs = std::filesystem;

int mode(const fs::path& path) { return static_cast<int>(fs::status(path).permissions()) & 0777; }

class KeyFolder : public results::InTestFolder {
 protected:
  [[nodiscard]] fs::path keys() const { return folder() / "keys"; }
};

TEST_F(KeyFolder, HoldsAFitIdentityForEveryRoleAndAnAuthority) {
  ASSERT_TRUE(make_keys(keys(), 2, {}).ok());
  const auto found = show(keys());
  ASSERT_TRUE(found.ok()) << found.error().text();
  std::vector<std::string> names;
  for (const auto& [role, identity] : found.value()) {
    names.push_back(role);
    ASSERT_TRUE(identity.ok()) << identity.error().text();
    EXPECT_EQ(identity.value().role, role);
    EXPECT_EQ(identity.value().authority, found.value().front().identity.value().authority);
    EXPECT_NEAR(identity.value().days_left, 365.0, 0.1);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"clock", "traffic-engine", "signal-controller", "recorder", "observer",
                                             "rsu0", "rsu1"}));
  EXPECT_TRUE(check(keys(), 2).ok());
}

TEST_F(KeyFolder, LetsNobodyButItsOwnerAtThePrivateKeys) {
  ASSERT_TRUE(make_keys(keys(), 1, {}).ok());
  int folders = 1;
  int private_keys = 0;
  EXPECT_EQ(mode(keys()), 0700);
  for (const auto& entry : fs::recursive_directory_iterator(keys())) {
    if (entry.is_directory()) {
      EXPECT_EQ(mode(entry.path()), 0700) << entry.path();
      ++folders;
    } else if (content("keys" / entry.path().lexically_relative(keys())).find("PRIVATE KEY") != std::string::npos) {
      EXPECT_EQ(mode(entry.path()), 0600) << entry.path();
      EXPECT_EQ(entry.path().extension(), ".key");
      ++private_keys;
    }
  }
  EXPECT_EQ(folders, 8);       // itself, the authority, five roles and an RSU
  EXPECT_EQ(private_keys, 7);  // one each
}

TEST_F(KeyFolder, IsNeverMadeOverAnythingThatIsThere) {
  fs::create_directory(keys());
  EXPECT_TRUE(may_make(keys()).ok()) << "empty";
  write("keys/mine", "mine");
  EXPECT_FALSE(may_make(keys()).ok());
  EXPECT_FALSE(make_keys(keys(), 1, {}).ok());
  EXPECT_FALSE(may_make(keys() / "mine").ok()) << "a file";
  EXPECT_EQ(content("keys/mine"), "mine");
}

TEST_F(KeyFolder, TellsWhatIsExpiredAndWhatWillBeSoon) {
  ASSERT_TRUE(make_keys(keys(), 1, {.until = 3.5}).ok());
  const auto soon = check(keys(), 1);
  ASSERT_TRUE(soon.ok());
  ASSERT_EQ(soon.value().size(), 6U);
  EXPECT_NE(soon.value().back().find("rsu0 expires in 3 days"), std::string::npos) << soon.value().back();
  ASSERT_TRUE(issue(keys(), "rsu0", {.from = -2.0, .until = -1.0}).ok());
  const auto expired = check(keys(), 1);
  ASSERT_FALSE(expired.ok());
  EXPECT_NE(expired.error().text().find("rsu0/identity.pem: expired on "), std::string::npos) << expired.error().text();
  ASSERT_TRUE(issue(keys(), "rsu0", {}).ok()) << "a new one in its place";
  EXPECT_TRUE(check(keys(), 1).ok());
}

TEST_F(KeyFolder, RefusesAnIdentityThatIsNotValidYet) {
  ASSERT_TRUE(make_keys(keys(), 1, {}).ok());
  ASSERT_TRUE(issue(keys(), "rsu0", {.from = 1.0, .until = 2.0}).ok());
  const auto early = bus::open_identity(keys() / "rsu0");
  ASSERT_FALSE(early.ok());
  EXPECT_NE(early.error().text().find("is not valid before"), std::string::npos);
}

TEST_F(KeyFolder, IssuesFurtherRsusAndNothingThatIsNoRole) {
  ASSERT_TRUE(make_keys(keys(), 1, {}).ok());
  EXPECT_FALSE(check(keys(), 2).ok());
  ASSERT_TRUE(issue(keys(), "rsu1", {}).ok());
  EXPECT_TRUE(check(keys(), 2).ok());
  for (const std::string wrong : {"rsu", "rsu01", "rsu-1", "authority", "../clock", "engine", ""}) {
    EXPECT_FALSE(may_issue(keys(), wrong).ok()) << wrong;
    EXPECT_FALSE(issue(keys(), wrong, {}).ok()) << wrong;
  }
  EXPECT_FALSE(may_issue(folder(), "rsu1").ok()) << "no authority there";
}

TEST_F(KeyFolder, IsUnfitWithAForeignOrMixedUpFile) {
  ASSERT_TRUE(make_keys(keys(), 2, {}).ok());
  ASSERT_TRUE(make_keys(folder() / "foreign", 1, {}).ok());
  const auto put = [&](const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  };
  const auto fit = [&](const std::string& role) { return bus::open_identity(keys() / role).ok(); };
  ASSERT_TRUE(fit("rsu0"));
  put(keys() / "rsu1/identity.key", keys() / "rsu0/identity.key");
  EXPECT_FALSE(fit("rsu0")) << "another one's key";
  put(folder() / "foreign/rsu0/identity.pem", keys() / "rsu1/identity.pem");
  EXPECT_FALSE(fit("rsu1")) << "a certificate of another authority";
  fs::remove(keys() / "clock/permissions.p7s");
  EXPECT_FALSE(fit("clock")) << "a file is missing";
  fs::remove_all(keys() / "recorder");
  fs::copy(folder() / "foreign/recorder", keys() / "recorder");
  EXPECT_TRUE(fit("recorder")) << "fit in itself";
  ASSERT_TRUE(issue(keys(), "rsu0", {}).ok());
  ASSERT_TRUE(issue(keys(), "clock", {}).ok());
  const auto mixed = check(keys(), 1);
  ASSERT_FALSE(mixed.ok());
  EXPECT_NE(mixed.error().text().find("recorder"), std::string::npos) << mixed.error().text();
}

TEST(Documents, LetEachTopicBeWrittenByItsOwnersAlone) {
  const auto publishes = [](const std::string& role, const std::string& topic) {
    const std::string text = permissions_document(role, "CN=" + role, "a", "b");
    const std::size_t begin = text.find("<publish>");
    const std::size_t end = text.find("</publish>");
    return text.substr(begin, end - begin).find("<topic>" + topic + "</topic>") != std::string::npos;
  };
  const std::vector<std::string> all = roles(1);
  const auto only = [&](const std::string& topic, const std::string& owner) {
    for (const std::string& role : all) EXPECT_EQ(publishes(role, topic), role == owner) << role << " " << topic;
  };
  only("lukou/traffic", "traffic-engine");
  only("lukou/air", "traffic-engine");
  only("lukou/signal", "signal-controller");
  only("lukou/roadside", "rsu0");
  only("lukou/request", "rsu0");
  only("lukou/control", "clock");
  only("lukou/run_state", "clock");
  only("lukou/view", "recorder");
  for (const std::string& role : all) EXPECT_EQ(publishes(role, "lukou/up"), role != "clock") << role;
}

TEST(Documents, LetTheGroundTruthBeReadByTheRecorderAlone) {
  for (const std::string& role : roles(1)) {
    const std::string text = permissions_document(role, "CN=" + role, "a", "b");
    const std::size_t begin = text.find("<subscribe>");
    const bool reads = text.find("<topic>lukou/traffic</topic>", begin) != std::string::npos;
    EXPECT_EQ(reads, role == "recorder") << role;
  }
}

TEST(Documents, AllowNothingByDefaultAndNobodyUnknown) {
  EXPECT_NE(permissions_document("rsu0", "CN=rsu0", "a", "b").find("<default>DENY</default>"), std::string::npos);
  EXPECT_NE(governance_document().find("<allow_unauthenticated_participants>false<"), std::string::npos);
  EXPECT_EQ(governance_document().find("NONE</data_protection_kind>"), std::string::npos);
}

}  // namespace
}  // namespace lukou::keys
