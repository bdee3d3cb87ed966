#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/intersection/conflicts.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using nlohmann::json;

constexpr const char* kPython = "/usr/bin/python3";

Finished finished(Program&& program, double limit_s = 120.0) {
  Finished end;
  end.code = program.wait(limit_s);
  end.out = program.out();
  end.err = program.err();
  return end;
}

/// Lukou as `cmake --install` leaves it, and a folder of a user, both away from the sources.
class OwnRsu : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    home_ = std::make_unique<TemporaryFolder>();
    const Finished installed =
        finished(Program({"--install", LUKOU_BUILD, "--prefix", prefix()}, {}, "/usr/bin/cmake"));
    ASSERT_EQ(installed.code, 0) << installed.out << installed.err;
  }
  static void TearDownTestSuite() { home_.reset(); }

  static std::string prefix() { return (*home_ / "prefix").string(); }
  /// In the user's folder, with the installed programs first in the path and no scenarios but theirs.
  static Finished shell(const std::string& command, double limit_s = 120.0) {
    return finished(Program({"-c", "cd '" + (*home_ / "").string() + "' && " + command},
                            {"PATH=" + prefix() + "/bin:/usr/bin:/bin", "LUKOU_SCENARIOS="}, "/bin/sh"),
                    limit_s);
  }
  static std::filesystem::path in_home(const std::string& name) { return *home_ / name; }
  /// Writes a Python RSU whose on_step() does nothing before step 100 and then `body`.
  static void write_python(const std::string& name, const std::string& body) {
    std::ofstream file(*home_ / name);
    file << "import os, sys, time\nimport numpy as np\nimport lukou\n\n"
            "class Rsu(lukou.RsuAlgorithm):\n"
            "    def __init__(self, setup):\n        super().__init__()\n"
            "    def on_step(self, heard, answer):\n        if heard.step >= 100:\n            "
         << body << "\n\nsys.exit(lukou.run_rsu(Rsu))\n";
  }
  static Finished run_python(const std::string& name, const std::string& body, const std::string& more = "") {
    write_python(name + ".py", body);
    return shell("lukou run paper --quiet --json --out " + name + " --rsu '" + kPython + " " + name + ".py' " +
                 (more.find("--duration") == std::string::npos ? "--duration 60 " : "") + more);
  }
  static void expect_sound(const std::string& folder, long long least_step) {
    const Finished inspection = shell("lukou inspect " + folder);
    EXPECT_EQ(inspection.code, 0) << inspection.out;
    const auto at = inspection.out.find("complete to step ");
    ASSERT_NE(at, std::string::npos) << inspection.out;
    EXPECT_GE(std::atoll(inspection.out.c_str() + at + 17), least_step);
  }

 private:
  static std::unique_ptr<TemporaryFolder> home_;
};

std::unique_ptr<TemporaryFolder> OwnRsu::home_;

TEST_F(OwnRsu, BuildsTestsAndRunsOutsideTheSourcesAndItsPythonTwinGivesTheSameBytes) {
  const Finished made = shell("lukou new rsu mine && lukou new rsu twin --lang python");
  ASSERT_EQ(made.code, 0) << made.err;
  const Finished built = shell("cd mine && cmake -B build && cmake --build build && ctest --test-dir build", 300.0);
  ASSERT_EQ(built.code, 0) << built.out << built.err;
  const Finished tested = shell("cd twin && PYTHONPATH=" + prefix() + "/" LUKOU_LIBRARY_FOLDER "/lukou/python " +
                                kPython + " twin_test.py");
  EXPECT_EQ(tested.code, 0) << tested.err;

  const Finished mine = shell("lukou run paper --duration 300 --quiet --rsu ./mine/build/mine --out a");
  ASSERT_EQ(mine.code, 0) << mine.err;
  const Finished twin =
      shell(std::string("lukou run paper --duration 300 --quiet --rsu '") + kPython + " twin/twin.py' --out b");
  ASSERT_EQ(twin.code, 0) << twin.err;
  EXPECT_EQ(shell("for file in car stop road stop_time; do cmp a/$file.csv b/$file.csv; done && cmp a/summary.json "
                  "b/summary.json")
                .code,
            0);
  const json summary = json::parse(shell("cat a/summary.json").out);
  EXPECT_GT(summary.at("advice_applied").get<int>(), 0);

  // The formula that the README tells to change: later at the line.
  EXPECT_EQ(shell("sed -i 's/AFTER_GREEN_S = 2.0/AFTER_GREEN_S = 6.0/' twin/twin.py").code, 0);
  EXPECT_EQ(
      shell(std::string("lukou run paper --duration 300 --quiet --rsu '") + kPython + " twin/twin.py' --out c").code,
      0);
  EXPECT_NE(shell("cmp a/car.csv c/car.csv").code, 0);
}

TEST_F(OwnRsu, ThatThrowsEndsTheRunWithItsTraceback) {
  const Finished run = run_python("throws", "raise ValueError('out of ideas')");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("Traceback"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("ValueError: out of ideas"), std::string::npos) << run.err;
  EXPECT_NE(run.err.find("rsu0"), std::string::npos) << run.err;
  expect_sound("throws", 99);
}

TEST_F(OwnRsu, ThatExitsEndsTheRun) {
  const Finished run = run_python("exits", "os._exit(0)");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("rsu0"), std::string::npos) << run.err;
  expect_sound("exits", 99);
}

TEST_F(OwnRsu, ThatHangsIsReportedAsStalled) {
  const Finished run = run_python("hangs", "time.sleep(1000)", "--stall-limit 2");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("rsu0 has not finished"), std::string::npos) << run.err;
  expect_sound("hangs", 99);
}

TEST_F(OwnRsu, ThatSaysImpossibleThingsIsRefusedWithTheReason) {
  // Each step from 100 to 600 one advice that is no number, one beyond every message, one for nobody.
  const Finished run = run_python("nonsense", "[answer.advise(7, a) for a in (float('nan'), 1e9, -0.5)]");
  ASSERT_EQ(run.code, 0) << run.err;
  const json refused = json::parse(run.out).at("summary").at("advice_refused");
  EXPECT_EQ(refused.at("malformed"), 2 * 500);
  EXPECT_EQ(refused.at("unknown_vehicle"), 500);
}

TEST_F(OwnRsu, ThatSaysImpossibleThingsOfTheOtherKindsIsRefusedToo) {
  const Finished run = run_python(
      "nonsense_kinds",
      "[answer.advise_speed(7, v) for v in (float('nan'), -1.0, 200.0, 10.0)]\n"
      "            [answer.advise_profile(7, p) for p in ([], [(0.1, 0.0)] * 33, [(0.1, 1.0), (0.1, float('inf'))],"
      " [(0.1, 0.0)])]\n"
      "            [answer.lane_speed('WC', v) for v in (float('nan'), -1.0, 200.0)]");
  ASSERT_EQ(run.code, 0) << run.err;
  const json refused = json::parse(run.out).at("summary").at("advice_refused");
  EXPECT_EQ(refused.at("malformed"), 9 * 500);
  EXPECT_EQ(refused.at("unknown_vehicle"), 2 * 500);
}

TEST_F(OwnRsu, GivesTheSameBytesInBothLanguagesForEveryKindOfAdvice) {
  const std::string cpp = R"(#include <lukou/rsu.hpp>
class Kinds : public lukou::RsuAlgorithm {
  void on_step(const lukou::RsuView& heard, lukou::RsuAnswer& answer) override {
    if (heard.step % 10 != 0) return;
    for (std::size_t i = 0; i < heard.lanes.size(); ++i) {
      for (const lukou::HeardCar& car : heard.lanes[i].cars) {
        if (i % 3 == 0) answer.advise_profile(car.id, {{{5, 0.3}, {7, -0.4}}, lukou::Binding::kFollowing});
        if (i % 3 == 1) answer.advise_speed(car.id, {0.8 * heard.map.speed_limit_mps, 12, lukou::Binding::kFollowing});
      }
      if (i % 3 == 2) answer.lane_speed(static_cast<lukou::Lane>(i), 12.0, 15);
    }
  }
};
int main(int argc, char** argv) {
  return lukou::run_rsu(argc, argv, [](const lukou::RsuSetup&) { return std::make_unique<Kinds>(); });
}
)";
  const std::string build =
      "cmake_minimum_required(VERSION 3.20)\nproject(kinds CXX)\nfind_package(Lukou REQUIRED)\n"
      "add_executable(kinds kinds.cpp)\ntarget_link_libraries(kinds Lukou::rsu)\n";
  ASSERT_EQ(shell("mkdir kinds && cat > kinds/kinds.cpp << 'END'\n" + cpp +
                  "END\ncat > kinds/CMakeLists.txt << 'END'\n" + build + "END\n")
                .code,
            0);
  const Finished built = shell("cmake -S kinds -B kinds/build -DLukou_DIR=" + prefix() +
                                   "/" LUKOU_LIBRARY_FOLDER "/cmake/Lukou && cmake --build kinds/build",
                               300.0);
  ASSERT_EQ(built.code, 0) << built.out << built.err;
  write_python("kinds.py",
               "pass\n        if heard.step % 10 == 0:\n            for i, lane in enumerate(heard.lanes):\n"
               "                for car in lane.cars:\n"
               "                    if i % 3 == 0: answer.advise_profile(car.id, [(0.5, 0.3), (0.7, -0.4)], "
               "lukou.Binding.FOLLOWING)\n"
               "                    if i % 3 == 1: answer.advise_speed(car.id, 0.8 * heard.map.speed_limit_mps, 1.2, "
               "lukou.Binding.FOLLOWING)\n"
               "                if i % 3 == 2: answer.lane_speed(lane.name, 12.0, 1.5)");
  const std::string run =
      "lukou run paper --duration 200 --quiet --set record.guidance=true ";
  const Finished in_cpp = shell(run + "--rsu ./kinds/build/kinds --out kinds_cpp");
  ASSERT_EQ(in_cpp.code, 0) << in_cpp.err;
  const Finished twin = shell(run + "--rsu '" + kPython + " kinds.py' --out kinds_python");
  ASSERT_EQ(twin.code, 0) << twin.err;
  EXPECT_EQ(shell("for file in car stop road stop_time stops guidance; do cmp kinds_cpp/$file.csv "
                  "kinds_python/$file.csv || exit 1; done && cmp kinds_cpp/summary.json kinds_python/summary.json")
                .code,
            0);
  const json kinds = json::parse(shell("cat kinds_cpp/summary.json").out).at("advice_by_kind");
  EXPECT_EQ(kinds.at("acceleration"), 0);
  for (const char* kind : {"profile", "speed", "lane_speed"}) EXPECT_GT(kinds.at(kind).get<int>(), 100) << kind;
}

TEST_F(OwnRsu, ThatSaysAMillionThingsAtOnceIsHeardOut) {
  const Finished run = run_python(
      "flood", "heard.step == 100 and answer.advise_all(np.arange(1000000, dtype=np.uint64), np.zeros(1000000))");
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(json::parse(run.out).at("summary").at("advice_refused").at("unknown_vehicle"), 1'000'000);
}

TEST_F(OwnRsu, WrittenInCFromTheIdlAloneGivesTheTrafficOfItsPythonTwin) {
  const Finished in_c =
      shell("lukou run paper --duration 200 --quiet --out c_alone --rsu " LUKOU_BUILD "/tests/rsu_in_c");
  ASSERT_EQ(in_c.code, 0) << in_c.err;
  const Finished twin =
      run_python("c_twin",
                 "pass\n        for car in heard.cars.id:\n            answer.advise(int(car), 0.5, 0.2, "
                 "lukou.Binding.FOLLOWING)",
                 "--duration 200");
  ASSERT_EQ(twin.code, 0) << twin.err;
  EXPECT_EQ(
      shell("for file in car stop road stop_time; do cmp c_alone/$file.csv c_twin/$file.csv || exit 1; done").code, 0);
  EXPECT_GT(json::parse(shell("cat c_alone/summary.json").out).at("advice_applied").get<int>(), 0);
}

/// An RSU that asks every third step for random lanes, and writes down what the heads show, '1' red to '3' green.
constexpr const char* kAsksAtRandom =
    "pass\n"
    "        if not hasattr(self, 'log'):\n"
    "            self.log, self.draw = open(sys.argv[0] + '.heads', 'w'), 1\n"
    "        self.log.write(''.join(str(lane.aspect.value) for lane in heard.lanes) + '\\n')\n"
    "        self.draw = (self.draw * 1103515245 + 12345) % 2**31\n"
    "        lanes = []\n"
    "        for i, lane in enumerate(heard.lanes):\n"
    "            if self.draw >> (8 + i) & 1 and (heard.step % 5 == 0 or not lukou.has_hard_conflict(lanes + "
    "[lane.name])):\n"
    "                lanes.append(lane.name)\n"
    "        if heard.step % 3 == 0:\n"
    "            answer.request_green(lanes, 2.0)";

/// Lengths of the stretches in which a lane's head shows one aspect; the first and the last are cut.
std::vector<std::pair<char, int>> stretches(const std::vector<std::string>& heads, std::size_t lane) {
  std::vector<std::pair<char, int>> found;
  for (const std::string& shown : heads) {
    if (found.empty() || found.back().first != shown.at(lane)) found.emplace_back(shown.at(lane), 0);
    ++found.back().second;
  }
  return found;
}

TEST_F(OwnRsu, ThatAsksForRandomGreensGetsThemWithinTheRules) {
  const std::string actuated =
      "--duration 300 --set signals.actuation.min_green_s=5 --set signals.actuation.yellow_s=2";
  const Finished run = run_python("asks", kAsksAtRandom, actuated);
  ASSERT_EQ(run.code, 0) << run.err;
  const json signals = json::parse(run.out).at("summary").at("signals");
  EXPECT_GE(signals.at("requests").get<int>(), 995);
  EXPECT_GT(signals.at("requests_accepted").get<int>(), 100);
  EXPECT_GT(signals.at("requests_deferred").at("min_green").get<int>(), 0);
  EXPECT_GT(signals.at("requests_refused").at("conflict").get<int>(), 0);
  expect_sound("asks", 3000);
  EXPECT_EQ(shell("head -1 asks/requests.csv").out, "step,time_s,rsu,lanes,outcome,rule\n");

  std::istringstream log(shell("cat asks.py.heads").out);
  std::vector<std::string> heads;
  for (std::string line; std::getline(log, line);) heads.push_back(line);
  ASSERT_EQ(heads.size(), 3001U);
  std::size_t greens = 0;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto found = stretches(heads, lane);
    for (std::size_t i = 1; i + 1 < found.size(); ++i) {
      const auto [aspect, steps] = found[i];
      if (aspect == '3') {
        EXPECT_GE(steps, 50) << lane;
        EXPECT_EQ(found[i + 1].first, '2') << lane;
        ++greens;
      } else if (aspect == '2') {
        EXPECT_EQ(steps, 20) << lane;
        EXPECT_EQ(found[i + 1].first, '1') << lane;
      }
    }
  }
  EXPECT_GT(greens, 50U) << "there was something to check";
  for (std::size_t step = 0; step < heads.size(); ++step) {
    for (std::size_t a = 0; a < kLanes; ++a) {
      if (heads[step][a] == '1') continue;
      for (const Lane b : hard_conflicts(static_cast<Lane>(a))) {
        ASSERT_EQ(heads[step][index(b)], '1') << step;
        // 1 s of all-red before each green.
        if (step < 10 || heads[step - 1][a] != '1') continue;
        for (std::size_t before = 1; before <= 10; ++before) ASSERT_EQ(heads[step - before][index(b)], '1') << step;
      }
    }
  }

  // Another pace, the same bytes.
  EXPECT_EQ(run_python("asks_again", kAsksAtRandom, actuated + " --pace 200").code, 0);
  EXPECT_EQ(shell("for file in car stop requests; do cmp asks/$file.csv asks_again/$file.csv || exit 1; done && "
                  "cmp asks/summary.json asks_again/summary.json")
                .code,
            0);
}

TEST_F(OwnRsu, ThatAsksForGreensUnderAFixedPlanIsRefusedAndTold) {
  const Finished run = run_python("unheard", "heard.actuation is None and answer.request_green(['WC'], 1.0)");
  ASSERT_EQ(run.code, 0) << run.err;
  const json signals = json::parse(run.out).at("summary").at("signals");
  // One in each step from 100 to 599; the engine hears that of 600 no more.
  EXPECT_EQ(signals.at("requests_refused").at("fixed_plan"), 500);
  EXPECT_EQ(signals.at("requests_accepted"), 0);
}

TEST_F(OwnRsu, WrittenInCTakesPartUnderAControllerThatHearsRequests) {
  const Finished in_c =
      shell("lukou run paper --duration 60 --quiet --set signals.actuation={} --out c_actuated --rsu " LUKOU_BUILD
            "/tests/rsu_in_c");
  EXPECT_EQ(in_c.code, 0) << in_c.err;
  expect_sound("c_actuated", 600);
}

TEST_F(OwnRsu, KeepsNoViewBeyondItsStep) {
  const Finished run = run_python("keeps", "Rsu.kept = getattr(Rsu, 'kept', heard); Rsu.kept.time_s");
  EXPECT_EQ(run.code, 3);
  EXPECT_NE(run.err.find("a view is valid during on_step only"), std::string::npos) << run.err;
}

TEST_F(OwnRsu, RunsInsideThePythonProcessWithTheSameBytes) {
  std::ofstream(in_home("study.py")) << R"(import sys
import lukou

class Rsu(lukou.RsuAlgorithm):
    def __init__(self, setup):
        super().__init__()
    def on_step(self, heard, answer):
        for car in heard.cars.id:
            answer.advise_speed(int(car), 8.0 + heard.step % 5, 0.5, lukou.Binding.FOLLOWING)

class Broken(Rsu):
    def on_step(self, heard, answer):
        if heard.step == 50:
            raise KeyError("out of ideas")

if len(sys.argv) == 1:
    sys.exit(lukou.run_rsu(Rsu))
run = lukou.run("paper", Rsu, set=["record.guidance=true"], seed=3, duration=100, out="study")
print(run.ended, run.exit_code, run.summary["advice_sent"] > 1000)
for wrong in [lambda: lukou.run("paper", set=["run.seed=x"]),
              lambda: lukou.run("paper", {1: Broken}, duration=20, out="study_broken")]:
    try:
        wrong()
    except (ValueError, KeyError) as error:
        print(type(error).__name__, error)
)";
  const Finished inside =
      shell("PYTHONPATH=" + prefix() + "/" LUKOU_LIBRARY_FOLDER "/lukou/python env -u LUKOU_SCENARIOS " + kPython +
            " study.py inside");
  ASSERT_EQ(inside.code, 0) << inside.err;
  EXPECT_NE(inside.out.find("done 0 True"), std::string::npos) << inside.out;
  EXPECT_NE(inside.out.find("ValueError --set run.seed=x"), std::string::npos) << inside.out;
  EXPECT_NE(inside.out.find("KeyError 'out of ideas'"), std::string::npos) << inside.out;
  expect_sound("study_broken", 49);
  EXPECT_NE(shell("cat study_broken/manifest.json").out.find("lost:rsu1"), std::string::npos);
  const Finished outside = shell(
      std::string("lukou run paper --quiet --duration 100 --seed 3 --set record.guidance=true --out apart --rsu '") +
      kPython + " study.py'");
  ASSERT_EQ(outside.code, 0) << outside.err;
  EXPECT_EQ(differing_files(in_home("study"), in_home("apart")), std::vector<std::string>{});
}

TEST_F(OwnRsu, NeedsAPlainNameAndAFreePlace) {
  const Finished odd = shell("lukou new rsu My-Rsu");
  EXPECT_EQ(odd.code, 2);
  EXPECT_NE(odd.err.find("small letters"), std::string::npos) << odd.err;
  ASSERT_EQ(shell("lukou new rsu taken").code, 0);
  const Finished again = shell("lukou new rsu taken");
  EXPECT_EQ(again.code, 2);
  EXPECT_NE(again.err.find("is there already"), std::string::npos) << again.err;
}

}  // namespace
}  // namespace lukou::test
