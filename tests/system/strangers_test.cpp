#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using nlohmann::json;

const std::string kStranger = LUKOU_BUILD "/tests/stranger";
const std::string kSpoilingRsu = LUKOU_BUILD "/tests/spoiling_rsu";

/// The paper's scenario for 100 s at 20 times real time: five seconds in which strangers may do what they can.
std::vector<std::string> usual(const std::filesystem::path& out, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"run", "paper", "--duration", "100", "--quiet", "--out", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// What nobody has disturbed.
const std::filesystem::path& undisturbed() {
  static const TemporaryFolder folder;
  static const std::filesystem::path result = [] {
    EXPECT_EQ(lukou(usual(folder / "r", {"--mode", "in-process"})).code, 0);
    return folder / "r";
  }();
  return result;
}

std::string domain_of(const std::string& run) {
  for (int i = 0; i < 200; ++i) {
    const std::string listed = lukou({"ctl", "list"}).out;
    const auto at = listed.find(run + " domain ");
    if (at != std::string::npos) return std::to_string(std::atoi(listed.c_str() + at + run.size() + 8));
  }
  return "none";
}

std::vector<std::string> address(const std::string& run) {
  return {"LUKOU_RUN=" + run, "LUKOU_DOMAIN=" + domain_of(run)};
}

json timing(const std::filesystem::path& folder) { return json::parse(content(folder / "timing.json")); }

struct Attack {
  std::vector<std::string> what;
  bool noticed = true;  ///< counted: some things never get as far as a reader's application
  std::string topic;    ///< that the log names

  [[nodiscard]] std::string name() const {
    std::string text;
    for (const std::string& word : what) text += (text.empty() ? "" : "_") + word;
    return text;
  }
};

class AttackOn : public testing::TestWithParam<Attack> {};

TEST_P(AttackOn, ARunChangesNoByteAndIsCountedAndNamed) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(usual(folder / "r", {"--pace", "20", "--run-id", run}));
  ASSERT_TRUE(wait_for_step(run, 50));
  Program stranger(GetParam().what, address(run), kStranger);
  EXPECT_EQ(launcher.wait(60.0), 0) << launcher.err();
  EXPECT_EQ(stranger.wait(15.0), 0) << stranger.err();
  EXPECT_EQ(differing_files(folder / "r", undisturbed()), std::vector<std::string>{});
  const auto foreign = timing(folder / "r").at("foreign_samples").get<long long>();
  if (!GetParam().noticed) return;
  EXPECT_GT(foreign, 0);
  EXPECT_NE(launcher.err().find("came from strangers on the bus"), std::string::npos) << launcher.err();
  const std::string log = content(folder / "r" / "operator.log");
  EXPECT_NE(log.find("topic lukou/" + GetParam().topic), std::string::npos) << log;
}

std::vector<Attack> attacks() {
  std::vector<Attack> all;
  for (const std::string topic : {"air", "roadside", "signal", "traffic"}) {
    all.push_back({{"flood", topic}, true, topic});
    for (const std::string who : {"own", "key", "twin"}) {
      all.push_back({{"forge", topic, who}, true, topic});
      all.push_back({{"malform", topic, who}, true, topic});
    }
    all.push_back({{"oversize", topic, "key"}, false, ""});
    all.push_back({{"dispose", topic}, false, ""});
  }
  for (const std::string who : {"own", "key", "twin"}) {
    all.push_back({{"forge", "control", who}, true, "control"});
    all.push_back({{"malform", "control", who}, true, "control"});
    all.push_back({{"clock", who}, true, "control"});
  }
  all.push_back({{"flood", "control"}, true, "control"});
  all.push_back({{"dispose", "control"}, false, ""});
  // Whoever speaks for himself on `up` may be an operator; nothing that he says is a member's word.
  all.push_back({{"malform", "up", "own"}, false, ""});
  all.push_back({{"flood", "up"}, false, ""});
  all.push_back({{"forge", "up", "key"}, true, "up"});
  all.push_back({{"forge", "up", "twin"}, true, "up"});
  all.push_back({{"malform", "up", "key"}, true, "up"});
  all.push_back({{"dispose", "up"}, false, ""});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Each, AttackOn, testing::ValuesIn(attacks()),
                         [](const auto& attack) { return attack.param.name(); });

TEST(Strangers, OfAllKindsAtOnceChangeNoByte) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(usual(folder / "r", {"--pace", "20", "--run-id", run}));
  ASSERT_TRUE(wait_for_step(run, 50));
  const auto where = address(run);
  std::vector<std::unique_ptr<Program>> strangers;
  for (const std::vector<std::string>& what : {std::vector<std::string>{"flood", "air"},
                                               {"flood", "up"},
                                               {"forge", "traffic", "key"},
                                               {"forge", "roadside", "twin"},
                                               {"malform", "signal", "key"},
                                               {"malform", "control", "twin"},
                                               {"clock", "key"},
                                               {"dispose", "up"},
                                               {"dispose", "control"},
                                               {"oversize", "roadside", "key"}}) {
    strangers.push_back(std::make_unique<Program>(what, where, kStranger));
  }
  EXPECT_EQ(launcher.wait(60.0), 0) << launcher.err();
  for (const auto& stranger : strangers) EXPECT_EQ(stranger->wait(15.0), 0) << stranger->err();
  EXPECT_EQ(differing_files(folder / "r", undisturbed()), std::vector<std::string>{});
  EXPECT_GT(timing(folder / "r").at("foreign_samples").get<long long>(), 1000);
  const std::string log = content(folder / "r" / "operator.log");
  for (const std::string topic : {"air", "traffic", "roadside", "signal", "control"}) {
    EXPECT_NE(log.find("topic lukou/" + topic), std::string::npos) << log;
  }
}

TEST(Strangers, ThatAreThereBeforeTheRunBeginsChangeNothingEither) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(usual(folder / "r", {"--rsu", "wait", "--run-id", run}));
  const auto where = address(run);
  Program engine({"forge", "air", "own"}, where, kStranger);
  Program clock({"clock", "own"}, where, kStranger);
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  Program rsu({}, where, std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu");
  EXPECT_EQ(launcher.wait(60.0), 0) << launcher.err();
  EXPECT_EQ(rsu.wait(10.0), 0) << rsu.err();
  EXPECT_EQ(differing_files(folder / "r", undisturbed()), std::vector<std::string>{});
  EXPECT_GT(timing(folder / "r").at("foreign_samples").get<long long>(), 0);
}

TEST(Strangers, WhoReadReliablyAndStandStillDoNotSlowTheRunForEver) {
  // A reader that acknowledges nothing fills the history of every writer; none may wait for it.
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "saturated", "--duration", "600", "--quiet", "--set", "vehicles.equipped_ratio=0.5",
                    "--run-id", run, "--out", folder / "r"});
  Program reader({"reads"}, address(run), kStranger);
  for (int i = 0; i < 500 && reader.out().empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  reader.signal(SIGSTOP);
  EXPECT_EQ(launcher.wait(120.0), 0) << launcher.err();
  reader.signal(SIGKILL);
  EXPECT_GT(timing(folder / "r").at("steps").get<int>(), 5999);
}

TEST(Strangers, WithAnotherProtocolOrScenarioAreRefusedWithBothValues) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher(usual(folder / "r", {"--rsu", "wait", "--run-id", run}));
  const auto where = address(run);
  const Finished listed = lukou({"ctl", run, "status"});
  EXPECT_NE(listed.out.find("forming"), std::string::npos) << listed.out;
  // A second engine, beside the true one.
  Program engine({}, where, std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-traffic-engine");
  EXPECT_EQ(engine.wait(15.0), 2);
  EXPECT_NE(engine.err().find("role `traffic-engine` is unknown or taken; vacant: rsu0"), std::string::npos)
      << engine.err();
  // A run of another name in the same domain is never heard: no clock answers.
  Program elsewhere({}, {"LUKOU_RUN=another", where[1]},
                    std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu");
  EXPECT_EQ(elsewhere.wait(15.0), 2);
  EXPECT_NE(elsewhere.err().find("no clock answers"), std::string::npos) << elsewhere.err();
  Program rsu({}, where, std::filesystem::path(LUKOU_PROGRAM).parent_path() / "lukou-rsu");
  EXPECT_EQ(launcher.wait(60.0), 0) << launcher.err();
  EXPECT_EQ(differing_files(folder / "r", undisturbed()), std::vector<std::string>{});
}

struct Way {
  const char* name;
  const char* says;
};

class MemberThatSends : public testing::TestWithParam<Way> {};

TEST_P(MemberThatSends, WhatNobodyCanUseIsLostAndNamedWithItsTopic) {
  const TemporaryFolder folder;
  const std::string way = GetParam().name;
  const bool request = way == "request";
  std::vector<std::string> arguments = {"run", request ? "actuated" : "paper", "--quiet", "--duration", "60"};
  // Whose program it is that is heard until then makes no difference: neither of the two advises anybody.
  arguments.insert(arguments.end(), {"--rsu", kSpoilingRsu + " " + way, "--set", "rsus[0].algorithm=none"});
  arguments.insert(arguments.end(), {"--out", (folder / "r").string()});
  const Finished aborted = lukou(arguments);
  EXPECT_EQ(aborted.code, 3);
  const std::string topic = request ? "lukou/request" : "lukou/roadside";
  EXPECT_NE(aborted.err.find("aborted: rsu0 topic " + topic), std::string::npos) << aborted.err;
  EXPECT_NE(aborted.err.find(GetParam().says), std::string::npos) << aborted.err;
  EXPECT_EQ(lukou({"inspect", folder / "r"}).code, 0);
  if (request) return;  // such a run cannot go on without its RSU

  // Where the scenario says so the run goes on without it, and the record replays that.
  arguments.back() = (folder / "on").string();
  arguments.insert(arguments.end(), {"--set", "run.on_rsu_loss=CONTINUE"});
  const Finished on = lukou(arguments);
  EXPECT_EQ(on.code, 0) << on.err;
  EXPECT_NE(content(folder / "on" / "directives.textproto").find("epoch: 0"), std::string::npos);
  const std::string log = content(folder / "on" / "operator.log");
  EXPECT_NE(log.find("rsu0: topic " + topic), std::string::npos) << log;
  const Finished replay = lukou({"run", folder / "on/scenario.textproto", "--mode", "in-process", "--quiet",
                                 "--replay-directives", folder / "on/directives.textproto", "--out", folder / "again"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(differing_files(folder / "on", folder / "again"), std::vector<std::string>{});
}

INSTANTIATE_TEST_SUITE_P(Each, MemberThatSends,
                         testing::Values(Way{"columns", "of step 50 frames.kind has 1 values, frames.sender has 2"},
                                         Way{"nan", "frames.antenna_x_m[1] is nan, must be a finite number"},
                                         Way{"kinds", "frames.kind[0] is 200, must be 1 to 5"},
                                         Way{"payload", "frames.payload_end must be rising, within the payload"},
                                         Way{"flood", "frames must be at most 65536 in a step"},
                                         Way{"gap", "expected the batch of step 50, got 53"},
                                         Way{"again", "expected the batch of step 50, got 49"},
                                         Way{"other_rsu", "says it is of rsu7"},
                                         Way{"request", "of step 50 lifetime has 1 values, lanes has 2"}),
                         [](const auto& way) { return std::string(way.param.name); });

}  // namespace
}  // namespace lukou::test
