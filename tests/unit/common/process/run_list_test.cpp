#include "common/process/run_list.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>

namespace lukou::process {
namespace {

/// What a launcher binds as long as its run lasts.
class Bound {
 public:
  explicit Bound(const ListedRun& run) : descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const std::string name = socket_name(run);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path + 1, name.data(), name.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    EXPECT_EQ(::bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), size), 0) << name;
  }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;
  ~Bound() { ::close(descriptor_); }

 private:
  int descriptor_;
};

/// Names that no run of this host has.
std::string fresh(const std::string& name) { return "unit-" + std::to_string(getpid()) + "-" + name; }

TEST(RunList, FindsARunByItsNameOrItsBeginning) {
  const Bound one({.run = fresh("one"), .domain = 77});
  const Bound two({.run = fresh("two"), .domain = 78});
  const auto whole = find_run(fresh("one"), {.domain = -1});
  ASSERT_TRUE(whole.ok()) << whole.error().text();
  EXPECT_EQ(whole.value().domain, 77);
  const auto beginning = find_run(fresh("tw"), {.domain = -1});
  ASSERT_TRUE(beginning.ok());
  EXPECT_EQ(beginning.value().run, fresh("two"));
  EXPECT_FALSE(find_run(fresh(""), {.domain = -1}).ok()) << "two begin so";
  EXPECT_FALSE(find_run(fresh("three"), {.domain = -1}).ok());
}

TEST(RunList, TellsWhatASecuredRunNeeds) {
  const Bound run({.run = fresh("s"), .domain = 79, .secured = true});
  const auto refused = find_run(fresh("s"), {.domain = -1});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("--identity"), std::string::npos) << refused.error().text();
  const auto found = find_run(fresh("s"), {.domain = -1, .identity = "/keys/observer"});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found.value().domain, 79);
  EXPECT_EQ(found.value().identity, "/keys/observer");
}

TEST(RunList, DoesNotShowAnIdentityToAnOpenRun) {
  const Bound run({.run = fresh("open"), .domain = 80});
  EXPECT_FALSE(find_run(fresh("open"), {.domain = -1, .identity = "/keys/observer"}).ok());
}

TEST(RunList, TellsWhatARunOnSeveralHostsNeeds) {
  const Bound run({.run = fresh("h"), .domain = 81, .secured = true, .hosts = true});
  const auto refused = find_run(fresh("h"), {.domain = -1, .identity = "/keys/observer"});
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("--peers"), std::string::npos) << refused.error().text();
  EXPECT_TRUE(find_run(fresh("h"), {.domain = -1, .peers = {"10.0.0.1"}, .identity = "/keys/observer"}).ok());
}

TEST(RunList, TakesADomainForARunOfAnotherHost) {
  const auto found = find_run(fresh("far"), {.domain = 12, .peers = {"10.0.0.1"}});
  ASSERT_TRUE(found.ok());
  EXPECT_EQ(found.value().run, fresh("far"));
  EXPECT_EQ(found.value().domain, 12);
}

}  // namespace
}  // namespace lukou::process
