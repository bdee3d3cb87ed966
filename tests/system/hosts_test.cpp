// A run on several hosts, which are network namespaces here: same bytes, loss, a pulled cable, ssh. Needs root.

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

const std::string kScript = std::string(LUKOU_SOURCES) + "/launch_scripts/hosts.sh";

Finished finished(const std::vector<std::string>& command, double limit_s = 120.0) {
  Program program({command.begin() + 1, command.end()}, {}, command.front());
  const int code = program.wait(limit_s);
  return {code, program.out(), program.err()};
}

Finished shell(const std::string& command, double limit_s = 120.0) {
  return finished({"/bin/sh", "-c", command}, limit_s);
}

/// Waits until `question` says yes; at most 30 s.
template <class Question>
bool wait_until(Question question) {
  for (int i = 0; i < 600; ++i) {
    if (question()) return true;
    usleep(50'000);
  }
  return false;
}

class Hosts : public testing::Test {
 protected:
  void SetUp() override {
    if (geteuid() != 0) GTEST_SKIP() << "NOT RUN: network namespaces need root";
    if (shell("command -v ip && command -v nft").code != 0) {
      GTEST_SKIP() << "NOT RUN: needs ip and nft (packages iproute2, nftables)";
    }
  }

  [[nodiscard]] std::string in_folder(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] std::string alone(const std::string& duration_s) const {
    EXPECT_EQ(lukou({"run", "paper", "--duration", duration_s, "--quiet", "--mode", "in-process", "--out",
                     in_folder("alone")})
                  .code,
              0);
    return in_folder("alone");
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(Hosts, TwoGiveTheBytesOfOne) {
  const Finished run =
      finished({kScript, "--namespaces", "2", "paper", "--duration", "1800", "--quiet", "--out", in_folder("two")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(differing_files(in_folder("two"), alone("1800")), std::vector<std::string>{});
}

TEST_F(Hosts, GiveTheSameBytesWhenPacketsAreLost) {
  const Finished run = finished({kScript, "--namespaces", "2", "--loss", "2", "paper", "--duration", "600", "--quiet",
                                 "--out", in_folder("lossy")},
                                400.0);
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(differing_files(in_folder("lossy"), alone("600")), std::vector<std::string>{});
  std::printf("2 %% lost: %s",
              shell("grep -o '\"steps_per_s\": [0-9.]*' " + in_folder("lossy") + "/timing.json").out.c_str());
}

TEST_F(Hosts, GiveTheSameBytesWhenSecured) {
  ASSERT_EQ(lukou({"keys", "init", in_folder("keys")}).code, 0);
  const Finished run = finished({kScript, "--namespaces", "3", "paper", "--duration", "120", "--quiet", "--secure",
                                 in_folder("keys"), "--out", in_folder("secured")});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(differing_files(in_folder("secured"), alone("120")), std::vector<std::string>{});
}

TEST_F(Hosts, LoseAParticipantWithAPulledCable) {
  const std::string id = fresh_run_id();
  Program run({"--namespaces", "2", "paper", "--duration", "7200", "--pace", "20", "--quiet", "--run-id", id, "--out",
               in_folder("pulled")},
              {}, kScript);
  const std::string second = "lukou-" + std::to_string(run.pid()) + "-2";
  ASSERT_TRUE(wait_until([&] { return content(in_folder("pulled") + "/road.csv").size() > 20'000; })) << run.err();
  ASSERT_EQ(shell("ip -n " + second + " link set eth0 down").code, 0);
  EXPECT_EQ(run.wait(30.0), 3);
  const std::string said = run.err();
  EXPECT_TRUE(said.find("rsu0 is gone") != std::string::npos ||
              said.find("signal-controller is gone") != std::string::npos)
      << said;
  EXPECT_NE(said.find("cannot be reached"), std::string::npos) << said;
  EXPECT_EQ(lukou({"inspect", in_folder("pulled")}).code, 0);
  EXPECT_LT(seconds_until_gone(id, 5.0), 5.0) << "nobody is left on the other host";
  EXPECT_EQ(shell("ip netns list | grep -c lukou-" + std::to_string(run.pid())).out, "0\n");
}

/// A second host that ssh reaches at 10.199.9.2, and the network on which this one is 10.199.9.1.
class Ssh : public Hosts {
 protected:
  void SetUp() override {
    Hosts::SetUp();
    if (IsSkipped()) return;
    if (shell("command -v sshd || test -x /usr/sbin/sshd").code != 0) {
      GTEST_SKIP() << "NOT RUN: needs an ssh server (package openssh-server)";
    }
    const std::string here = net_ + "-a";
    const std::string there = net_ + "-b";
    ASSERT_EQ(shell("set -e; ip netns add " + here + "; ip netns add " + there + "; ip link add eth0 netns " + here +
                    " type veth peer name eth0 netns " + there + "; for n in a b; do ip -n " + net_ +
                    "-$n link set lo up; ip -n " + net_ + "-$n link set eth0 up; done; ip -n " + here +
                    " addr add 10.199.9.1/24 dev eth0; ip -n " + there +
                    " addr add 10.199.9.2/24 dev eth0; mkdir -p /run/sshd; ssh-keygen -q -t ed25519 -N '' -f " +
                    in_folder("key") + "; cp " + in_folder("key.pub") + " " + in_folder("authorized"))
                  .code,
              0);
    std::ofstream(in_folder("sshd_config"))
        << "ListenAddress 10.199.9.2\nHostKey " << in_folder("key") << "\nAuthorizedKeysFile "
        << in_folder("authorized") << "\nPermitRootLogin yes\nStrictModes no\nUsePAM no\nPidFile none\n";
    std::ofstream(in_folder("ssh_config"))
        << "Host road\n  HostName 10.199.9.2\n  User root\n  IdentityFile " << in_folder("key")
        << "\n  StrictHostKeyChecking no\n  UserKnownHostsFile /dev/null\n  LogLevel ERROR\n";
    std::ofstream(in_folder("hosts")) << "# who is where\nrsu0 = road\n";
    server_ = std::make_unique<Program>(
        std::vector<std::string>{"netns", "exec", there, "/usr/sbin/sshd", "-D", "-e", "-f", in_folder("sshd_config")},
        std::vector<std::string>{}, "/sbin/ip");
    ASSERT_TRUE(wait_until([&] { return server_->err().find("listening") != std::string::npos; })) << server_->err();
  }
  void TearDown() override {
    server_.reset();
    shell("ip netns del " + net_ + "-a; ip netns del " + net_ + "-b");
  }

  [[nodiscard]] std::unique_ptr<Program> start(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"netns", "exec",   net_ + "-a", kScript, "--hosts", in_folder("hosts"),
                                          "paper", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return std::make_unique<Program>(arguments, std::vector<std::string>{"LUKOU_SSH=ssh -F " + in_folder("ssh_config")},
                                     "/sbin/ip");
  }

 private:
  std::string net_ = "lukou-ssh-" + std::to_string(getpid());
  std::unique_ptr<Program> server_;
};

TEST_F(Ssh, StartsAProcessElsewhereWithTheSameBytes) {
  const auto run = start({"--duration", "300", "--out", in_folder("ssh")});
  ASSERT_EQ(run->wait(), 0) << run->err();
  EXPECT_NE(run->err().find("hosts: 10.199.9.1,10.199.9.2"), std::string::npos) << run->err();
  EXPECT_EQ(differing_files(in_folder("ssh"), alone("300")), std::vector<std::string>{});
}

TEST_F(Ssh, SeesHowAProcessDiesThere) {
  const std::string id = fresh_run_id();
  const auto run = start({"--duration", "7200", "--pace", "20", "--run-id", id, "--out", in_folder("ssh")});
  ASSERT_TRUE(wait_until([&] { return content(in_folder("ssh") + "/road.csv").size() > 20'000; })) << run->err();
  ASSERT_TRUE(processes_of(id).contains("lukou-rsu"));
  kill(processes_of(id).at("lukou-rsu"), SIGKILL);
  EXPECT_EQ(run->wait(), 3);
  EXPECT_NE(run->err().find("rsu0 was killed by signal 9 (Killed)"), std::string::npos) << run->err();
}

TEST_F(Ssh, LeavesNobodyThereWhenTheLauncherIsKilledNotEvenWhoStands) {
  const std::string id = fresh_run_id();
  const auto run = start({"--duration", "7200", "--pace", "20", "--run-id", id, "--out", in_folder("ssh")});
  ASSERT_TRUE(wait_until([&] { return content(in_folder("ssh") + "/road.csv").size() > 20'000; })) << run->err();
  kill(processes_of(id).at("lukou-rsu"), SIGSTOP);  // cannot notice anything by itself
  run->signal(SIGKILL);
  EXPECT_LT(seconds_until_gone(id, 10.0), 10.0);
}

TEST_F(Ssh, RefusesAnotherBuildAndAHostThatIsNotThere) {
  std::ofstream(in_folder("hosts")) << "rsu0 = nowhere.invalid\n";
  const auto nowhere = start({"--out", in_folder("r")});
  EXPECT_EQ(nowhere->wait(), 2);
  EXPECT_NE(nowhere->err().find("nowhere.invalid: no address"), std::string::npos) << nowhere->err();
  std::ofstream(in_folder("hosts")) << "rsu0 road\n";
  const auto malformed = start({"--out", in_folder("r")});
  EXPECT_EQ(malformed->wait(), 2);
  EXPECT_NE(malformed->err().find("hosts:1: must be `role = host`"), std::string::npos) << malformed->err();
}

}  // namespace
}  // namespace lukou::test
