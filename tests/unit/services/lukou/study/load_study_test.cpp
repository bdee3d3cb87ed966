#include <gtest/gtest.h>

#include "services/lukou/study/plan.hpp"
#include "services/lukou/study/study.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::studies {
namespace {

/// Loads a study whose text is in hand.
class LoadStudy : public results::InTestFolder {
 protected:
  Expected<Study> loaded(const std::string& text, const Additions& additions = {}) {
    write("mine.textproto", text);
    return load(file_.string(), additions);
  }
  /// The error with the folder's name cut out.
  std::string error(const std::string& text, const Additions& additions = {}) {
    const auto study = loaded(text, additions);
    if (study) return "no error";
    std::string said = study.error().text();
    const std::string cut = folder().string() + "/";
    for (std::size_t at = said.find(cut); at != std::string::npos; at = said.find(cut)) said.erase(at, cut.size());
    return said;
  }

  std::filesystem::path file_ = folder() / "mine.textproto";
};

TEST_F(LoadStudy, GivesADefaultToWhatIsNotSaid) {
  const auto study = loaded(R"(scenario: "paper")");
  ASSERT_TRUE(study) << study.error().text();
  EXPECT_EQ(study.value().name, "mine");
  ASSERT_EQ(study.value().arms.size(), 1U);
  EXPECT_EQ(study.value().seeds, 10U);
  EXPECT_FALSE(study.value().precision);
  EXPECT_DOUBLE_EQ(study.value().confidence, 0.95);
  EXPECT_EQ(study.value().measures.front(), "mean_stop_time_s");
  EXPECT_EQ(plan_of(study.value()).points.size(), 1U);
}

TEST_F(LoadStudy, TakesTheUnitOfTheField) {
  const auto study = loaded(R"(
scenario: "paper"
grids { factors { name: "latency" paths: "radio.downlink.latency.constant_ms" values: [0, 200] } }
grids { factors { name: "lifetime" paths: "rsus[0].arrive_on_green.lifetime_s" values: [0.5] } }
)");
  ASSERT_TRUE(study) << study.error().text();
  EXPECT_EQ(study.value().grids[0].factors[0].unit, "ms");
  EXPECT_EQ(study.value().grids[1].factors[0].unit, "s");
}

TEST_F(LoadStudy, MakesValuesOfRanges) {
  const auto study = loaded(R"(
scenario: "paper"
grids {
  factors { name: "a" paths: "vehicles.equipped_ratio" range { from: 0 to: 1 step: 0.1 } }
  factors { name: "b" paths: "run.duration_s" range { from: 100 to: 10000 count: 3 logarithmic: true } }
  factors { name: "c" paths: "traffic.west.flow_veh_per_h" range { from: 0 to: 100 count: 3 } }
}
)");
  ASSERT_TRUE(study) << study.error().text();
  const auto texts = [&](std::size_t factor) {
    std::vector<std::string> found;
    for (const Level& level : study.value().grids[0].factors[factor].levels) found.push_back(level.text);
    return found;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(texts(0), (Texts{"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1"}));
  EXPECT_EQ(texts(1), (Texts{"100", "1000", "10000"}));
  EXPECT_EQ(texts(2), (Texts{"0", "50", "100"}));
  EXPECT_EQ(study.value().grids[0].factors[0].levels[3].sets[0].set, "vehicles.equipped_ratio=0.3");
}

TEST_F(LoadStudy, IsTheSameStudyAgainFromItsOwnText) {
  const auto study = loaded(R"(
scenario: "paper"
algorithms: ["arrive_on_green", "glosa"]
grids { factors { name: "ratio" paths: "vehicles.equipped_ratio" values: [0.3, 0.7] } }
seeds { first: 5 count: 3 }
)");
  ASSERT_TRUE(study) << study.error().text();
  write(kStudyFile, study.value().text);
  write(kBaseFile, study.value().base_text);
  const auto again = load((folder() / kStudyFile).string());
  ASSERT_TRUE(again) << again.error().text();
  EXPECT_EQ(again.value().text, study.value().text);
  EXPECT_EQ(again.value().name, "mine");
  EXPECT_EQ(hash(again.value()), hash(study.value()));
}

TEST_F(LoadStudy, TakesSettingsAndSeedsOfTheCommandLine) {
  const auto study =
      loaded(R"(scenario: "paper" set: "run.duration_s=100")", {.sets = {"run.duration_s=50"}, .seeds = 2});
  ASSERT_TRUE(study) << study.error().text();
  EXPECT_EQ(study.value().seeds, 2U);
  EXPECT_EQ(study.value().sets.back().set, "run.duration_s=50");
}

TEST_F(LoadStudy, SaysWhereAnUnknownFieldStands) {
  EXPECT_EQ(error("scenario: \"paper\"\nseds { count: 3 }\n"),
            "mine.textproto:2:1: Study has no field `seds`; did you mean `seeds`?");
}

TEST_F(LoadStudy, SaysWhatIsMissing) {
  EXPECT_EQ(error("title: \"x\"\n"), "mine.textproto: scenario is missing; it takes a text");
}

TEST_F(LoadStudy, SaysWhereAValueIsOutOfRange) {
  EXPECT_EQ(error("scenario: \"paper\"\nconfidence: 1.5\n"),
            "mine.textproto:2:1: confidence is 1.5, must be within [0.5, 0.999]");
}

TEST_F(LoadStudy, SaysWhichSettingAScenarioDoesNotTake) {
  EXPECT_EQ(error("scenario: \"paper\"\nset: \"run.duration=5\"\n"),
            "mine.textproto:2:1: run.duration=5: run has no field `duration`; did you mean `duration_s`?");
}

TEST_F(LoadStudy, SaysWhichValueOfAFactorAScenarioDoesNotTake) {
  EXPECT_EQ(error("scenario: \"paper\"\ngrids {\n  factors { name: \"a\" paths: \"vehicles.equipped_ratio\"\n"
                  "    values: [0.5, 2]\n  }\n}\n"),
            "mine.textproto:4:5: vehicles.equipped_ratio=2: vehicles.equipped_ratio is 2, must be within [0, 1]");
}

TEST_F(LoadStudy, SaysWhichCombinationOfValuesAScenarioDoesNotTake) {
  // Bursts of 2 steps cannot lose 90 %: the shortest that can are 10 steps long.
  const std::string said = error(R"(scenario: "paper"
grids {
  factors { name: "loss" paths: "radio.downlink.loss.burst.rate" values: [0.5, 0.9] }
  factors { name: "length" paths: "radio.downlink.loss.burst.mean_length" values: [2, 20] }
}
)");
  EXPECT_EQ(said.substr(0, 60), "mine.textproto:4:75: radio.downlink.loss.burst.mean_length=2");
  EXPECT_NE(said.find("must be at least 1 / (1 - rate), 10"), std::string::npos) << said;
  EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

TEST_F(LoadStudy, SaysWhatIsWrongWithAnArmsAlgorithm) {
  const std::string said = error("scenario: \"paper\"\nalgorithms: [\"arrive_on_gren\"]\n");
  EXPECT_NE(said.find("arrive_on_green"), std::string::npos) << said;
}

TEST_F(LoadStudy, RefusesABaselineThatIsNoArm) {
  EXPECT_EQ(error("scenario: \"paper\"\narms { name: \"on\" }\narms { name: \"off\" }\nbaseline: \"of\"\n"),
            "mine.textproto:4:1: baseline is `of`, no arm of this study; did you mean `on`?");
}

TEST_F(LoadStudy, RefusesAFactorWithTwoKindsOfValues) {
  EXPECT_EQ(
      error(
          "scenario: \"paper\"\ngrids { factors { name: \"a\" paths: \"run.duration_s\" values: 5 words: \"x\" } }\n"),
      "mine.textproto:2:9: grids[0].factors[0] has values of two kinds; give one of values, range, words and "
      "levels");
}

TEST_F(LoadStudy, RefusesAnIgnoredFactorThatThereIsNot) {
  EXPECT_EQ(error("scenario: \"paper\"\narms { name: \"a\" ignores: \"latency\" }\n"),
            "mine.textproto:2:18: arms[0].ignores[0] is `latency`, no factor of this study");
}

TEST_F(LoadStudy, RefusesAMeasureThatNoSummaryHas) {
  EXPECT_EQ(error("scenario: \"paper\"\nmeasures: [\"mean_delay\"]\n"),
            "mine.textproto:2:1: measures[0] is `mean_delay`, no number of summary.json; did you mean `mean_delay_s`?");
}

TEST_F(LoadStudy, RefusesASeedAmongTheSettings) {
  EXPECT_NE(error("scenario: \"paper\"\nset: \"run.seed=3\"\n").find("the study's seeds do that"), std::string::npos);
}

TEST_F(LoadStudy, RefusesARangeThatDoesNotEnd) {
  EXPECT_NE(error("scenario: \"paper\"\ngrids { factors { name: \"a\" paths: \"run.duration_s\" range { from: 1 to: 2 "
                  "step: -1 } } }\n")
                .find("must have 1 to 1001 values"),
            std::string::npos);
}

TEST_F(LoadStudy, TellsAStudyFromAScenario) {
  write("mine.textproto", "scenario: \"paper\"\nseeds { count: 2 }\n");
  EXPECT_TRUE(is_study(file_.string()));
  write("mine.textproto", "run { seed: 2 }\n");
  EXPECT_FALSE(is_study(file_.string()));
  EXPECT_FALSE(is_study("paper"));
}

}  // namespace
}  // namespace lukou::studies
