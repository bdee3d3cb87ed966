#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::scenario {
namespace {

class Shipped : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::setenv("LUKOU_SCENARIOS", LUKOU_SHIPPED, 1), 0); }
  void TearDown() override { ::unsetenv("LUKOU_SCENARIOS"); }
};

TEST_F(Shipped, ScenariosAllLoad) {
  const auto names = shipped_names();
  EXPECT_EQ(names, (std::vector<std::string>{"actuated", "paper", "saturated", "unguided"}));
  for (const std::string& name : names) {
    const auto result = load(name);
    EXPECT_TRUE(result.ok()) << result.error().text();
  }
}

TEST_F(Shipped, PaperIsTheDefaults) {
  const auto paper = load("paper");
  const auto defaults = load_text("", "empty", "/nowhere");
  ASSERT_TRUE(paper.ok() && defaults.ok());
  EXPECT_EQ(text(paper.value()), text(defaults.value()));
}

TEST_F(Shipped, UnguidedDiffersFromPaperInTheEquippedRatioAlone) {
  const auto unguided = load("unguided");
  const auto paper = load("paper", {"vehicles.equipped_ratio=0"});
  ASSERT_TRUE(unguided.ok() && paper.ok());
  EXPECT_EQ(text(unguided.value()), text(paper.value()));
}

TEST_F(Shipped, NameThatIsUnknownBringsTheNearest) {
  const auto result = load("papr");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), "papr: is neither a file nor a shipped scenario; did you mean `paper`?");
}

TEST_F(Shipped, FileThatIsNotThereIsNotTakenForAName) {
  const auto result = load("./paper.textproto.missing/paper.textproto");
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().text(), "./paper.textproto.missing/paper.textproto: there is no such file");
}

}  // namespace
}  // namespace lukou::scenario
