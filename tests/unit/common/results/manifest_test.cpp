#include "common/results/manifest.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lukou::results {
namespace {

Manifest example() {
  return {.lukou_version = "0.1.0",
          .scenario_hash = "abc",
          .seed = 18446744073709551615U,
          .steps_planned = 72000,
          .complete_to_step = 71999,
          .ended_by = "lost:rsu",
          .culprit = "RSU 0 \"mine\" ended by signal 11",
          .files = {{"car.csv", "00ff", 12}, {"scenario.textproto", "11ee", std::nullopt}}};
}

TEST(Manifest, IsTextWithItsKeysInAFixedOrder) {
  EXPECT_EQ(text(example()), R"({
  "lukou_version": "0.1.0",
  "scenario_hash": "abc",
  "seed": 18446744073709551615,
  "steps_planned": 72000,
  "complete_to_step": 71999,
  "ended_by": "lost:rsu",
  "culprit": "RSU 0 \"mine\" ended by signal 11",
  "files": [
    {
      "name": "car.csv",
      "sha256": "00ff",
      "rows": 12
    },
    {
      "name": "scenario.textproto",
      "sha256": "11ee"
    }
  ]
}
)");
}

TEST(Manifest, IsReadBackAsItWas) {
  const auto manifest = parse_manifest(text(example()), "manifest.json");
  ASSERT_TRUE(manifest.ok()) << manifest.error().text();
  EXPECT_EQ(manifest.value(), example());
}

TEST(Manifest, ThatIsWrongIsExplained) {
  const std::string good = text(example());
  struct {
    const char* from;
    const char* to;
    const char* error;
  } const bad[] = {
      {"{\n  \"lukou", "[\"lukou", "m.json: is not JSON"},
      {"\"seed\": 18446744073709551615,", "", "m.json: seed is missing"},
      {"\"seed\": 18446744073709551615", "\"seed\": -1", "m.json: seed must be a whole number of at least 0"},
      {"\"seed\": 18446744073709551615", "\"seed\": \"1\"", "m.json: seed must be a whole number of at least 0"},
      {"\"culprit\": \"RSU 0 \\\"mine\\\" ended by signal 11\"", "\"culprit\": 3", "m.json: culprit must be a text"},
      {"lost:rsu", "lost:",
       "m.json: ended_by is `lost:`, must be done, stopped, interrupted, anomaly:<what>, lost:<role>, stalled:<role> "
       "or "
       "disk"},
      {"\"rows\": 12", "\"rows\": 1.5", "m.json: files[0].rows must be a whole number of at least 0"},
      {"\"sha256\": \"11ee\"", "\"sha\": 1", "m.json: files[1].sha256 is missing"},
      {"\"files\"", "\"file\"", "m.json: files must be a list"},
  };
  for (const auto& [from, to, error] : bad) {
    std::string text = good;
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), std::string(from).size(), to);
    const auto manifest = parse_manifest(text, "m.json");
    ASSERT_FALSE(manifest.ok()) << to;
    EXPECT_EQ(manifest.error().text(), error);
  }
  EXPECT_EQ(parse_manifest("[]", "m.json").error().text(), "m.json: must be a JSON object");
}

TEST(Manifest, KnowsHowARunMayEnd) {
  for (const char* end : {"done", "stopped", "interrupted", "disk", "anomaly:overflow", "lost:recorder", "stalled:rsu"})
    EXPECT_TRUE(is_ended_by(end)) << end;
  for (const char* end : {"", "Done", "lost", "lost:", "done:", "anomaly"}) EXPECT_FALSE(is_ended_by(end)) << end;
}

}  // namespace
}  // namespace lukou::results
