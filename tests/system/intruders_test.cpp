// What strangers get done in a secured run: nothing. Each test has its control: the same stranger where he may.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <memory>

#include "common/process/run_list.hpp"
#include "services/lukou/keys/key_folder.hpp"
#include "tests/system/program.hpp"
#include "tests/system/secured_run.hpp"

namespace lukou::test {
namespace {

constexpr const char* kFakeClock = "/usr/lib/x86_64-linux-gnu/faketime/libfaketime.so.1";
const std::vector<std::string> kEverything = {"read:traffic",   "read:air",     "read:view",     "read:control",
                                              "read:run_state", "write:signal", "write:traffic", "write:air",
                                              "write:up",       "write:view"};

/// A run that lasts some 15 s of wall time, secured or not, and the strangers in it.
class IntrudedRun {
 public:
  IntrudedRun(const std::filesystem::path& folder, const std::string& keys)
      : secured_(!keys.empty()), id_(fresh_run_id()) {
    std::vector<std::string> arguments = {"run",
                                          "paper",
                                          "--duration",
                                          "150",
                                          "--pace",
                                          "10",
                                          "--quiet",
                                          "--out",
                                          folder,
                                          "--run-id",
                                          id_,
                                          "--set",
                                          "traffic.west.flow_veh_per_h=1999"};
    if (secured_) arguments.insert(arguments.end(), {"--secure", keys});
    run_ = std::make_unique<Program>(arguments);
    for (int i = 0; i < 500 && domain_ < 0; ++i) {
      for (const auto& listed : process::list_runs())
        if (listed.run == id_) domain_ = listed.domain;
      usleep(20'000);
    }
    // Until everybody is there: a stranger that comes earlier would not be a part of it, either.
    for (int i = 0; i < 100; ++i) {
      std::vector<std::string> status = {"ctl", id_, "status"};
      if (secured_) status.insert(status.end(), {"--identity", keys + "/observer"});
      if (lukou(status).out.find(": running") != std::string::npos) break;
      usleep(50'000);
    }
  }

  /// A stranger with this configuration for five seconds.
  std::unique_ptr<Program> intruder(const std::string& config, std::vector<std::string> what = kEverything,
                                    std::vector<std::string> environment = {}) const {
    std::vector<std::string> arguments = {std::to_string(domain_), "5"};
    arguments.insert(arguments.end(), what.begin(), what.end());
    environment.push_back("CYCLONEDDS_URI=" + config);
    environment.push_back("LUKOU_REAL_ACCESS_CONTROL=" + real_access_control());
    return std::make_unique<Program>(arguments, environment, LUKOU_INTRUDER);
  }

  [[nodiscard]] std::string config(const std::string& identity = "", const std::string& access_control = "") const {
    return strangers_config(id_, secured_, identity, access_control);
  }
  Program& run() { return *run_; }

 private:
  bool secured_;
  std::string id_;
  std::unique_ptr<Program> run_;
  int domain_ = -1;
};

void expect_nothing_done(Program& intruder, const std::string& who) {
  EXPECT_EQ(intruder.wait(), 0) << who << intruder.err();
  const std::string said = intruder.out();
  EXPECT_FALSE(said.empty()) << who << intruder.err();
  for (const std::string& word : kEverything) {
    std::string what = word;
    std::ranges::replace(what, ':', ' ');
    const Foothold found = foothold(said, what);
    EXPECT_EQ(found.matched, 0) << who << ": " << what << "\n" << said;
    if (what.starts_with("read")) {
      EXPECT_EQ(found.count, 0) << who << ": " << what << "\n" << said;
    }
  }
}

TEST(Intruders, ReadTheTruthAndStopAnOpenRun) {
  const TemporaryFolder folder;
  IntrudedRun open(folder / "open", "");
  auto reader = open.intruder(open.config(), {"read:traffic", "read:view"});
  EXPECT_EQ(reader->wait(), 0) << reader->err();
  EXPECT_EQ(foothold(reader->out(), "read traffic").matched, 1) << reader->out();
  EXPECT_GT(foothold(reader->out(), "read traffic").count, 30) << reader->out();
  EXPECT_GT(foothold(reader->out(), "read view").count, 10) << reader->out();
  auto stopper = open.intruder(open.config(), {"write:up", "read:control"});
  EXPECT_EQ(open.run().wait(), 0);
  EXPECT_NE(content(folder / "open/manifest.json").find("\"stopped\""), std::string::npos)
      << content(folder / "open/manifest.json");
}

TEST(Intruders, GetNothingDoneInASecuredRun) {
  const TemporaryFolder folder;
  const std::string keys = folder / "keys";
  const std::string foreign = folder / "foreign";
  ASSERT_TRUE(keys::make_keys(keys, 3, {}).ok());
  ASSERT_TRUE(keys::make_keys(foreign, 1, {}).ok());
  // Good until a minute ago.
  ASSERT_TRUE(keys::issue(keys, "rsu2", {.until = -1.0 / 1440.0}).ok());
  // An RSU that writes its own rights: his certificate is good, who signed the rights is not.
  std::filesystem::copy(keys + "/rsu1", folder / "forger");
  for (const std::string file : {"permissions.p7s", "governance.p7s"}) {
    std::filesystem::copy_file(foreign + "/traffic-engine/" + file, (folder / "forger").string() + "/" + file,
                               std::filesystem::copy_options::overwrite_existing);
  }
  const bool fake_clock = std::filesystem::exists(kFakeClock);
  const std::vector<std::string> earlier = {std::string("LD_PRELOAD=") + kFakeClock, "FAKETIME=-30m",
                                            "DONT_FAKE_MONOTONIC=1", "FAKETIME_DONT_FAKE_MONOTONIC=1"};

  IntrudedRun secured(folder / "secured", keys);
  // In waves of three: six strangers at once would keep two cores busy with handshakes.
  auto nobody = secured.intruder(secured.config());
  auto stranger = secured.intruder(secured.config(foreign + "/traffic-engine"));
  auto forger = secured.intruder(secured.config(folder / "forger"));
  expect_nothing_done(*nobody, "who has no identity");
  expect_nothing_done(*stranger, "whose identity is of another authority");
  expect_nothing_done(*forger, "who forged his rights");
  EXPECT_EQ(forger->out(), "participant refused\n") << "his own library knows";

  auto rsu = secured.intruder(secured.config(keys + "/rsu1"), {"read:traffic", "write:signal", "read:air"});
  auto lax = secured.intruder(secured.config(keys + "/rsu1", LUKOU_LAX_ACCESS_CONTROL),
                              {"read:traffic", "write:signal", "write:traffic", "read:air"});
  auto observer = secured.intruder(secured.config(keys + "/observer"), {"read:view", "read:traffic"});
  auto expired = secured.intruder(secured.config(keys + "/rsu2"));
  std::unique_ptr<Program> late;
  if (fake_clock) late = secured.intruder(secured.config(keys + "/rsu2"), kEverything, earlier);

  EXPECT_EQ(rsu->wait(), 0);
  EXPECT_FALSE(foothold(rsu->out(), "read traffic").created) << rsu->out();
  EXPECT_FALSE(foothold(rsu->out(), "write signal").created) << rsu->out();
  EXPECT_EQ(foothold(rsu->out(), "read air").matched, 1) << "what an RSU may\n" << rsu->out();

  EXPECT_EQ(lax->wait(), 0);
  EXPECT_TRUE(foothold(lax->out(), "write signal").created) << "his own library lets him\n" << lax->out() << lax->err();
  EXPECT_TRUE(foothold(lax->out(), "read traffic").created) << lax->out();
  EXPECT_EQ(foothold(lax->out(), "write signal").matched, 0) << lax->out();
  EXPECT_EQ(foothold(lax->out(), "write traffic").matched, 0) << lax->out();
  EXPECT_EQ(foothold(lax->out(), "read traffic").matched, 0) << lax->out();
  EXPECT_EQ(foothold(lax->out(), "read traffic").count, 0) << lax->out();
  EXPECT_EQ(foothold(lax->out(), "read air").matched, 1) << "he is in, as the RSU that he is\n" << lax->out();

  EXPECT_EQ(observer->wait(), 0);
  EXPECT_GT(foothold(observer->out(), "read view").count, 10) << "the control\n" << observer->out();
  EXPECT_EQ(foothold(observer->out(), "read traffic").count, 0) << observer->out();

  expect_nothing_done(*expired, "whose identity has expired");
  EXPECT_EQ(expired->out(), "participant refused\n") << "his own library knows";
  if (late) {
    expect_nothing_done(*late, "whose identity has expired, and whose clock is slow");
    EXPECT_NE(late->out(), "participant refused\n") << "his own library does not know";
  } else {
    std::printf("NOT RUN: an expired identity behind a slow clock; it needs %s (package faketime)\n", kFakeClock);
  }

  EXPECT_EQ(secured.run().wait(), 0) << secured.run().err();
  ASSERT_EQ(lukou({"run", "paper", "--duration", "150", "--quiet", "--mode", "in-process", "--set",
                   "traffic.west.flow_veh_per_h=1999", "--out", folder / "alone"})
                .code,
            0);
  EXPECT_EQ(differing_files(folder / "secured", folder / "alone"), std::vector<std::string>{});
}

}  // namespace
}  // namespace lukou::test
