#include "common/scenario/directive_log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace lukou::scenario {
namespace {

/// Writes a file of its own for each test and removes it afterwards.
class DirectiveLogFile : public testing::Test {
 protected:
  DirectiveLogFile()
      : file_(std::filesystem::temp_directory_path() /
              ("lukou_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + "_" +
               std::to_string(::getpid()) + ".textproto")) {}
  ~DirectiveLogFile() override { std::filesystem::remove(file_); }

  Expected<DirectiveLog> loaded(const std::string& text) {
    std::ofstream(file_, std::ios::binary) << text;
    return load_directives(file_);
  }
  [[nodiscard]] std::string name() const { return file_.string(); }

 private:
  std::filesystem::path file_;
};

TEST_F(DirectiveLogFile, ReadsBackWhatWasWritten) {
  DirectiveLog log;
  log.sets = {{1, "traffic.west.flow_veh_per_h=900"},
              {301, "signals.preset=PROTECTED_LEFT"},
              {301, "vehicles.equipped_ratio=0.25"},
              {9000, "signals.plan={ cycle_s: 60 lane_plans { lanes: \"WL\" } }"}};
  log.hearings = {{0, 188, 0}, {0, 312, 2}, {1, 400, 0}};
  log.stop = 9500;
  log.computed = {{.rsu = 0, .step = 7, .delay_ms = 3}, {.rsu = 1, .step = 7, .delay_ms = 130}};
  const auto read = loaded(text(log));
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(read.value().sets.size(), log.sets.size());
  for (std::size_t i = 0; i < log.sets.size(); ++i) {
    EXPECT_EQ(read.value().sets[i].step, log.sets[i].step);
    EXPECT_EQ(read.value().sets[i].set, log.sets[i].set);
  }
  ASSERT_EQ(read.value().hearings.size(), log.hearings.size());
  for (std::size_t i = 0; i < log.hearings.size(); ++i) {
    EXPECT_EQ(read.value().hearings[i].rsu, log.hearings[i].rsu);
    EXPECT_EQ(read.value().hearings[i].from, log.hearings[i].from);
    EXPECT_EQ(read.value().hearings[i].epoch, log.hearings[i].epoch);
  }
  EXPECT_EQ(read.value().stop, 9500);
  ASSERT_EQ(read.value().computed.size(), 2U);
  EXPECT_EQ(read.value().computed[1].rsu, 1U);
  EXPECT_EQ(read.value().computed[1].step, 7);
  EXPECT_EQ(read.value().computed[1].delay_ms, 130U);
  EXPECT_EQ(text(read.value()), text(log)) << "the text is the same, byte for byte";
}

TEST_F(DirectiveLogFile, ReadsAnUndisturbedRun) {
  EXPECT_EQ(text(DirectiveLog{}), "");
  const auto read = loaded("");
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read.value().sets.empty());
  EXPECT_TRUE(read.value().hearings.empty());
  EXPECT_EQ(read.value().stop, std::nullopt);
}

TEST_F(DirectiveLogFile, TellsAStopAtStepZeroFromNone) {
  DirectiveLog log;
  log.stop = 0;
  const auto read = loaded(text(log));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read.value().stop, 0);
}

TEST_F(DirectiveLogFile, PointsAtAnUnknownField) {
  const auto read = loaded("changes {\n  step: 3\n  setting: \"a=1\"\n}\n");
  ASSERT_FALSE(read.ok());
  EXPECT_TRUE(read.error().text().starts_with(name() + ":3:")) << read.error().text();
  EXPECT_NE(read.error().text().find("setting"), std::string::npos) << read.error().text();
}

TEST_F(DirectiveLogFile, PointsAtAValueOfTheWrongKind) {
  const auto read = loaded("changes { step: 3.5 set: \"a=1\" }");
  ASSERT_FALSE(read.ok());
  EXPECT_TRUE(read.error().text().starts_with(name() + ":1:17: ")) << read.error().text();
}

TEST_F(DirectiveLogFile, RefusesChangesOutOfTheOrderOfTheirSteps) {
  const auto read = loaded("changes { step: 5 set: \"a=1\" } changes { step: 4 set: \"b=1\" }");
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().text(), name() + ": changes must stand in the order of their steps; step 4 follows 5");
}

TEST(DirectiveLog, NamesAFileThatIsNotThere) {
  const auto read = load_directives("/nowhere/directives.textproto");
  ASSERT_FALSE(read.ok());
  EXPECT_TRUE(read.error().text().starts_with("/nowhere/directives.textproto: ")) << read.error().text();
}

}  // namespace
}  // namespace lukou::scenario
