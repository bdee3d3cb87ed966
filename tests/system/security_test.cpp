// Secured runs as their users meet them. What strangers get done in them is intruders_test.cpp.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>

#include "services/lukou/keys/key_folder.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

std::string environment_of(pid_t process, const std::string& name) {
  const std::string all = '\0' + content("/proc/" + std::to_string(process) + "/environ");
  const auto at = all.find('\0' + name + "=");
  if (at == std::string::npos) return "";
  const auto begin = at + name.size() + 2;
  return all.substr(begin, all.find('\0', begin) - begin);
}

class SecuredRun : public testing::Test {
 protected:
  SecuredRun() { EXPECT_EQ(lukou({"keys", "init", keys()}).code, 0); }

  [[nodiscard]] std::string keys() const { return folder_ / "keys"; }
  [[nodiscard]] std::string in_folder(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] Finished run(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"run", "paper", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return lukou(arguments);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(SecuredRun, GivesTheBytesOfAnOpenOne) {
  const Finished secured = run({"--duration", "120", "--secure", keys(), "--out", in_folder("secured")});
  ASSERT_EQ(secured.code, 0) << secured.err;
  ASSERT_EQ(run({"--duration", "120", "--mode", "in-process", "--out", in_folder("alone")}).code, 0);
  EXPECT_EQ(differing_files(in_folder("secured"), in_folder("alone")), std::vector<std::string>{});
}

TEST_F(SecuredRun, GivesEachProcessItsOwnIdentityAndAnswersOnlyWhoHasOne) {
  const std::string id = fresh_run_id();
  Program secured({"run", "paper", "--duration", "7200", "--pace", "20", "--quiet", "--secure", keys(), "--run-id", id,
                   "--out", in_folder("r")});
  const std::string observer = keys() + "/observer";
  const auto status = [&](const std::string& identity) { return lukou({"ctl", id, "status", "--identity", identity}); };
  for (int i = 0; i < 100 && status(observer).out.find(": running") == std::string::npos; ++i) usleep(50'000);
  EXPECT_NE(status(observer).out.find(": running"), std::string::npos) << secured.err();

  const auto processes = processes_of(id);
  EXPECT_EQ(processes.size(), 5U);
  for (const auto& [program, pid] : processes) {
    const std::string role = program == "lukou-rsu" ? "rsu0" : program.substr(std::string("lukou-").size());
    EXPECT_EQ(environment_of(pid, "LUKOU_IDENTITY"), keys() + "/" + role);
  }
  const Finished listed = lukou({"ctl", "list"});
  EXPECT_NE(listed.out.find(id + " domain "), std::string::npos) << listed.out;
  EXPECT_NE(listed.out.find(", secured"), std::string::npos) << listed.out;
  const Finished without = lukou({"ctl", id, "stop"});
  EXPECT_EQ(without.code, 2);
  EXPECT_NE(without.err.find("is secured: --identity"), std::string::npos) << without.err;
  const Finished as_rsu = lukou({"ctl", id, "stop", "--identity", keys() + "/rsu0"});
  EXPECT_EQ(as_rsu.code, 2);
  EXPECT_NE(as_rsu.err.find("is the identity of rsu0, this process is observer"), std::string::npos) << as_rsu.err;
  EXPECT_EQ(lukou({"ctl", id, "stop", "--identity", observer}).code, 0);
  EXPECT_EQ(secured.wait(), 0) << secured.err();
}

TEST_F(SecuredRun, TakesAnRsuThatIsStartedByHandWithItsIdentity) {
  const std::string id = fresh_run_id();
  Program secured({"run", "paper", "--duration", "60", "--secure", keys(), "--run-id", id, "--rsu", "wait", "--out",
                   in_folder("r")});
  const auto command = [&] {
    const std::string said = secured.err();
    const auto at = said.find("LUKOU_IDENTITY=");
    return at == std::string::npos ? "" : said.substr(at, said.find('\n', at) - at);
  };
  for (int i = 0; i < 200 && command().empty(); ++i) usleep(20'000);
  ASSERT_EQ(command().find("LUKOU_IDENTITY=" + keys() + "/rsu0 "), 0U) << secured.err();
  Program rsu({"-c", command()}, {}, "/bin/sh");
  EXPECT_EQ(secured.wait(), 0) << secured.err();
  EXPECT_EQ(rsu.wait(), 0) << rsu.err();
  ASSERT_EQ(run({"--duration", "60", "--mode", "in-process", "--out", in_folder("alone")}).code, 0);
  EXPECT_EQ(differing_files(in_folder("r"), in_folder("alone")), std::vector<std::string>{});
}

TEST_F(SecuredRun, DoesNotBeginWithKeysThatAreUnfit) {
  const auto refused = [&](const std::string& folder) {
    const Finished end = run({"--duration", "10", "--secure", folder, "--out", in_folder("r")});
    EXPECT_EQ(end.code, 2) << end.err;
    EXPECT_FALSE(std::filesystem::exists(in_folder("r"))) << "no result folder for a run that cannot be";
    return end.err;
  };
  EXPECT_NE(refused(in_folder("nothing")).find("lukou keys"), std::string::npos);
  ASSERT_TRUE(keys::issue(keys(), "rsu0", {.from = -2.0, .until = -1.0}).ok());
  EXPECT_NE(refused(keys()).find("rsu0/identity.pem: expired on "), std::string::npos);
  std::filesystem::remove_all(keys() + "/rsu0");
  EXPECT_NE(refused(keys()).find("lukou keys issue " + keys() + " rsu0"), std::string::npos);
  EXPECT_EQ(lukou({"keys", "issue", keys(), "rsu0"}).code, 0);
  EXPECT_EQ(run({"--duration", "10", "--secure", keys(), "--out", in_folder("r")}).code, 0);
}

TEST_F(SecuredRun, LosesAnRsuAsAnyOther) {
  const std::string id = fresh_run_id();
  Program secured({"run", "paper", "--duration", "7200", "--pace", "20", "--quiet", "--secure", keys(), "--run-id", id,
                   "--out", in_folder("r")});
  for (int i = 0; i < 200 && !processes_of(id).contains("lukou-rsu"); ++i) usleep(20'000);
  for (int i = 0; i < 100; ++i) {
    if (lukou({"ctl", id, "status", "--identity", keys() + "/observer"}).out.find(": running") != std::string::npos)
      break;
  }
  kill(processes_of(id).at("lukou-rsu"), SIGKILL);
  EXPECT_EQ(secured.wait(), 3);
  EXPECT_NE(secured.err().find("rsu0 was killed by signal 9"), std::string::npos) << secured.err();
  EXPECT_EQ(lukou({"inspect", in_folder("r")}).code, 0);
}

TEST_F(SecuredRun, TakesALostRsuInAgain) {
  const std::string id = fresh_run_id();
  Program secured({"run", "paper", "--duration", "240", "--pace", "30", "--quiet", "--secure", keys(), "--run-id", id,
                   "--set", "run.on_rsu_loss=CONTINUE", "--out", in_folder("r")});
  const auto recorded = [&](std::size_t bytes) {
    for (int i = 0; i < 600 && content(in_folder("r") + "/road.csv").size() < bytes; ++i) usleep(20'000);
  };
  recorded(20'000);
  const auto lost = processes_of(id).at("lukou-rsu");
  const std::string domain = environment_of(lost, "LUKOU_DOMAIN");
  kill(lost, SIGKILL);
  recorded(60'000);
  const std::string program = std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu";
  Program again({}, {"LUKOU_RUN=" + id, "LUKOU_DOMAIN=" + domain, "LUKOU_IDENTITY=" + keys() + "/rsu0"}, program);
  EXPECT_EQ(secured.wait(), 0) << secured.err();
  EXPECT_EQ(again.wait(), 0) << again.err();
  EXPECT_NE(content(in_folder("r") + "/directives.textproto").find("epoch: 2"), std::string::npos) << "it was heard";
  ASSERT_EQ(lukou({"run", in_folder("r") + "/scenario.textproto", "--mode", "in-process", "--quiet",
                   "--replay-directives", in_folder("r") + "/directives.textproto", "--out", in_folder("replay")})
                .code,
            0);
  EXPECT_EQ(differing_files(in_folder("r"), in_folder("replay")), std::vector<std::string>{});
}

TEST_F(SecuredRun, CanBeAskedOfTheDoctor) {
  const Finished doctor = lukou({"doctor", "--secure", keys()});
  EXPECT_EQ(doctor.code, 0) << doctor.out;
  EXPECT_NE(doctor.out.find("DDS Security talks"), std::string::npos) << doctor.out;
}

TEST(Keys, AreShownWithoutAnythingPrivate) {
  const TemporaryFolder folder;
  const std::string keys = folder / "keys";
  const Finished made = lukou({"keys", "init", keys, "--rsus", "1", "--days", "30"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(lukou({"keys", "init", keys}).code, 2) << "never twice";
  const Finished shown = lukou({"keys", "show", keys});
  EXPECT_EQ(shown.code, 0);
  EXPECT_NE(shown.out.find("30.0 days left"), std::string::npos) << shown.out;
  for (const Finished& said : {made, shown}) {
    EXPECT_EQ((said.out + said.err).find("PRIVATE"), std::string::npos);
  }
  ASSERT_TRUE(keys::issue(keys, "rsu0", {.from = -2.0, .until = -1.0}).ok());
  EXPECT_EQ(lukou({"keys", "show", keys}).code, 1);
  const Finished json = lukou({"keys", "show", keys, "--json"});
  EXPECT_NE(json.out.find("\"fit\": false"), std::string::npos) << json.out;
  EXPECT_EQ(lukou({"keys", "issue", keys, "rsu0x"}).code, 2);
}

}  // namespace
}  // namespace lukou::test
