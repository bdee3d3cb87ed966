// Checks the source tree itself: the rooms, who may know whom, and what only some places may do.

#include <gtest/gtest.h>

#include <set>

#include "tests/architecture/rules.hpp"

namespace lukou::architecture {
namespace {

const std::vector<SourceFile>& tree() {
  static const std::vector<SourceFile> kTree =
      read_tree(PROJECT_SOURCE_DIR, {"common", "services", "idl", "tests", "launch_scripts", "docs"});
  return kTree;
}

/// Every violation, one a line, so that all can be mended at once.
std::string text(const Violations& violations) {
  std::string lines;
  for (const std::string& violation : violations) lines += violation + "\n";
  return lines;
}

template <class Rule>
Violations everywhere(Rule rule) {
  Violations all;
  for (const SourceFile& file : tree()) {
    const Violations found = rule(file);
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

TEST(SourceTree, IsThere) {
  std::set<std::string> paths;
  for (const SourceFile& file : tree()) paths.insert(file.path);
  for (const char* known : {"common/core/step.hpp", "common/CMakeLists.txt", "services/rsu/main.cpp", "idl/bus.idl",
                            "tests/architecture/architecture_test.cpp"}) {
    EXPECT_TRUE(paths.contains(known)) << known;
  }
}

TEST(SourceTree, IncludesOnlyWhatEachRoomMayKnow) { EXPECT_EQ(text(everywhere(include_violations)), ""); }

TEST(SourceTree, HasItsRoomsInTheirOrder) {
  for (const SourceFile& file : tree()) {
    if (file.path != "common/CMakeLists.txt") continue;
    EXPECT_EQ(text(order_violations(file)), "");
  }
}

TEST(SourceTree, UsesClocksThreadsChanceAndTheEnvironmentOnlyWhereItMay) {
  std::vector<std::string> used;
  EXPECT_EQ(text(everywhere([&](const SourceFile& file) { return word_violations(file, used); })), "");
  EXPECT_EQ(text(idle_exceptions(used)), "");
}

TEST(SourceTree, LeavesNothingUndoneAndNoFileTooLong) { EXPECT_EQ(text(everywhere(form_violations)), ""); }

// The rules themselves: each must find what it is for.

Violations includes(const std::string& path, const std::string& line) {
  return include_violations(source_file(path, line + "\n"));
}

struct Case {
  const char* path;
  const char* line;
};

TEST(IncludeRules, FindEachKindOfTrespass) {
  const Case wrong[] = {
      {"services/clock/main.cpp", "#include <dds/dds.h>"},
      {"common/process/member.cpp", "#include \"bus.h\""},
      {"services/recorder/main.cpp", "#include \"common/bus/samples.hpp\""},
      {"services/rsu/rsu_node.cpp", "#include \"services/traffic_engine/engine_node.hpp\""},
      {"common/core/hash.cpp", "#include \"common/intersection/lane.hpp\""},
      {"common/lockstep/edge.hpp", "#include \"common/bus/batches.hpp\""},
      {"common/measures/x.cpp", "#include \"common/bus/participant.hpp\""},
      {"common/results/x.cpp", "#include \"services/recorder/summary.hpp\""},
      {"common/attic/x.cpp", "#include \"common/core/step.hpp\""},
      {"services/rsu/model/x.cpp", "#include \"common/messages/bsm.hpp\""},
      {"services/rsu/model/x.cpp", "#include <fstream>"},
      {"services/rsu/model/x.cpp", "#include <unistd.h>"},
      {"services/traffic_engine/model/x.cpp", "  #  include <chrono>"},
      {"services/traffic_engine/model/x.hpp", "#include \"services/traffic_engine/engine_node.hpp\""},
      {"services/rsu/algorithms/x.cpp", "#include \"services/rsu/model/heard_cars.hpp\""},
      {"services/rsu/sdk/x.hpp", "#include \"common/messages/bsm.hpp\""},
      {"services/rsu/rsu_config.hpp", "#include \"scenario.pb.h\""},
      {"services/rsu/rsu_node.cpp", "#include \"common/process/log.hpp\""},
  };
  for (const Case& example : wrong) EXPECT_EQ(includes(example.path, example.line).size(), 1U) << example.line;
}

TEST(IncludeRules, LetWhatIsAllowedPass) {
  const Case right[] = {
      {"common/bus/participant.cpp", "#include <dds/dds.h>"},
      {"common/measures/x.cpp", "#include \"common/bus/batches.hpp\""},
      {"services/lukou/launch/run_in_process.cpp", "#include \"services/rsu/rsu_node.hpp\""},
      {"services/rsu/model/x.cpp", "#include \"services/rsu/model/signal_view.hpp\""},
      {"services/rsu/model/x.cpp", "#include <algorithm>"},
      {"services/rsu/rsu_config.cpp", "#include \"scenario.pb.h\""},
      {"services/rsu/main.cpp", "#include \"common/process/log.hpp\""},
      {"services/clock/main.cpp", "// #include <dds/dds.h>"},
  };
  for (const Case& example : right) EXPECT_EQ(text(includes(example.path, example.line)), "") << example.line;
}

TEST(IncludeRules, NameTheFileAndTheLine) {
  const auto found = include_violations(source_file("services/clock/a.cpp", "int a;\n\n#include <dds/dds.h>\n"));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0], "services/clock/a.cpp:3: includes dds/dds.h; only common/bus names Cyclone");
}

TEST(OrderRule, FindsARoomBelowOneThatItUses) {
  const std::string wrong = text(order_violations(source_file(
      "common/CMakeLists.txt", "add_subdirectory(intersection)\nadd_subdirectory(core)\nadd_subdirectory(attic)\n")));
  EXPECT_NE(wrong.find("common/CMakeLists.txt:1: intersection may include core"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("common/CMakeLists.txt:3: the room attic is not in the table"), std::string::npos) << wrong;
  EXPECT_NE(wrong.find("the room bus is missing"), std::string::npos) << wrong;
}

TEST(WordRules, FindEachWordOutsideItsPlace) {
  const Case wrong[] = {
      {"services/rsu/rsu_node.cpp", "auto t = std::chrono::steady_clock::now();"},
      {"common/bus/x.cpp", "const auto t = std::time(nullptr);"},
      {"services/clock/main.cpp", "std::this_thread::sleep_for(x);"},
      {"services/clock/main.cpp", "usleep(100);"},
      {"services/rsu/x.cpp", "std::jthread other(f);"},
      {"services/recorder/main.cpp", "std::getenv(\"HOME\")"},
      {"services/traffic_engine/model/x.cpp", "std::random_device device;"},
      {"services/rsu/x.cpp", "std::mt19937 engine;"},
      {"common/radio/x.cpp", "std::normal_distribution<double> d;"},
      {"common/radio/x.cpp", "return std::log(x);"},
      {"services/traffic_engine/model/x.cpp", "return std::pow (x, 2);"},
      {"services/rsu/algorithms/x.cpp", "std::unordered_map<int, int> cars;"},
  };
  std::vector<std::string> used;
  for (const Case& example : wrong) {
    EXPECT_EQ(word_violations(source_file(example.path, example.line), used).size(), 1U) << example.line;
  }
  EXPECT_TRUE(used.empty());
}

TEST(WordRules, LetWhatIsAllowedPass) {
  const Case right[] = {
      {"common/process/environment.cpp", "std::this_thread::sleep_for(x);"},
      {"common/core/x.cpp", "return math::log(x) + std::sqrt(y) + std::floor(z);"},
      {"common/core/x.cpp", "double f();  // not std::log(x)"},
      {"common/core/x.cpp", "const char* s = \"std::log(x) and getenv\";"},
      {"common/core/x.cpp", "/* std::log(x)"},
      {"services/rsu/x.cpp", "double at = arrival_time(0);"},
      {"tests/unit/x.cpp", "std::mt19937 engine;"},
  };
  std::vector<std::string> used;
  for (const Case& example : right) {
    EXPECT_EQ(text(word_violations(source_file(example.path, example.line), used)), "") << example.line;
  }
  EXPECT_EQ(used, (std::vector<std::string>{"common/process/ sleep"}));
}

TEST(WordRules, SayWhichExceptionsAreIdle) {
  const Violations idle = idle_exceptions({"common/process/ sleep"});
  EXPECT_FALSE(idle.empty());
  EXPECT_EQ(text(idle).find("for sleep"), std::string::npos);
}

TEST(FormRules, FindUndoneWorkAndLongFiles) {
  const std::string undone = std::string("// TO") + "DO: later\nint todo_list;\n// FIX" + "ME\n";
  EXPECT_EQ(form_violations(source_file("idl/a.proto", undone)).size(), 2U);
  std::string lines;
  for (int i = 0; i < 400; ++i) lines += "int a;\n";
  EXPECT_TRUE(form_violations(source_file("common/core/a.cpp", lines)).empty());
  EXPECT_EQ(form_violations(source_file("common/core/a.cpp", lines + "int a;\n")).size(), 1U);
  EXPECT_TRUE(form_violations(source_file("tests/unit/a.cpp", lines + "int a;\n")).empty());
}

}  // namespace
}  // namespace lukou::architecture
