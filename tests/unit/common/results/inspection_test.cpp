#include "common/results/inspection.hpp"

#include "common/core/hash.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/result_folder.hpp"
#include "common/results/tables.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::results {
namespace {

namespace fs = std::filesystem;

/// A result folder of 5 steps with two cars that left at 0.25 s and 0.45 s.
class Results : public InTestFolder {
 protected:
  static constexpr Step kSteps = 5;

  Results() {
    auto tables = RunTables::create(folder());
    EXPECT_TRUE(tables.ok());
    for (Step step = 1; step <= kSteps; ++step) {
      if (step == 3) tables.value().add_car({.vehicle = 4, .left_s = 0.25});
      if (step == 5) tables.value().add_car({.vehicle = 5, .left_s = 0.45});
      tables.value().add_step(step, {}, {}, {});
    }
    EXPECT_TRUE(tables.value().sync().ok());
    write("scenario.textproto", "run { }\n");
  }

  static Manifest facts(const std::string& ended_by) {
    return {.lukou_version = "0.1.0",
            .scenario_hash = "abc",
            .seed = 1,
            .steps_planned = kSteps,
            .ended_by = ended_by,
            .culprit = ""};
  }
  /// What the recorder writes last.
  void finish() {
    write("directives.textproto", "");
    write("summary.json", "{}\n");
    write("timing.json", "{}\n");
    write("operator.log", "started\n");
    Manifest manifest = facts("done");
    manifest.complete_to_step = kSteps;
    manifest.files = result_files(folder()).value();
    ASSERT_TRUE(write_file(folder() / kManifest, text(manifest)).ok());
  }
  /// Every fault of the folder, one a line; a `*` marks those that can be repaired.
  std::string faults() {
    const auto found = inspect(folder());
    EXPECT_TRUE(found.ok());
    std::string lines;
    for (const Fault& fault : found.value().faults) lines += (fault.repairable ? "* " : "") + fault.text() + "\n";
    return lines;
  }
  /// Cuts the last bytes of a file.
  void shorten(const std::string& name, std::uintmax_t bytes) {
    fs::resize_file(folder() / name, fs::file_size(folder() / name) - bytes);
  }
  /// Length of the last row of road.csv: "5,0.5" and fifteen times ",0".
  static constexpr std::uintmax_t kLastRow = 5 + 15 * 2 + 1;
};

TEST_F(Results, OfAFinishedRunAreSound) {
  finish();
  const auto found = inspect(folder());
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found.value().sound()) << faults();
  EXPECT_EQ(found.value().complete_to_step, kSteps);
  ASSERT_TRUE(found.value().manifest.has_value());
  EXPECT_EQ(found.value().manifest->ended_by, "done");
}

TEST_F(Results, MayHaveOtherFactsOfTheWallClock) {
  finish();
  append("operator.log", "more\n");
  fs::remove(folder() / "timing.json");
  EXPECT_EQ(faults(), "");
}

TEST_F(Results, ThatSomebodyChangedAreNotSound) {
  finish();
  append("summary.json", " ");
  write("extra.txt", "x");
  fs::remove(folder() / "directives.textproto");
  append("stop.csv", "6,0.6,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n");
  EXPECT_EQ(faults(),
            "* stop.csv: goes to step 6, but the tables are complete to step 5 only\n"
            "directives.textproto: is missing\n"
            "directives.textproto: stands in the manifest, but is missing\n"
            "stop.csv: is not what was written: its SHA-256 is not the manifest's\n"
            "summary.json: is not what was written: its SHA-256 is not the manifest's\n"
            "extra.txt: does not stand in the manifest\n");
  EXPECT_FALSE(inspect(folder()).value().repairable());
}

TEST_F(Results, WithoutAManifestWereCutOff) {
  EXPECT_EQ(faults(), "* manifest.json: is missing; the run was cut off\n");
  EXPECT_TRUE(inspect(folder()).value().repairable());
}

TEST_F(Results, SayWhichRowIsTornOrWrong) {
  shorten("road.csv", 3);
  write("stop_time.csv",
        stop_time_columns() + "\n1,0.1,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n3,0.3,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n");
  write("stop.csv.unfinished", "");
  EXPECT_EQ(faults(),
            "* manifest.json: is missing; the run was cut off\n"
            "* road.csv:6: the last row is torn, " +
                std::to_string(kLastRow - 3) +
                " bytes\n"
                "* stop_time.csv:3: is of step `3`, must be of step 2\n"
                "* road.csv: goes to step 4, but the tables are complete to step 1 only\n"
                "* stop.csv: goes to step 5, but the tables are complete to step 1 only\n"
                "* stop.csv.unfinished: was being written when the run was cut off\n");
}

TEST_F(Results, SayWhichRowHasTooFewCells) {
  write("car.csv", car_columns() + "\n1,WL\n");
  EXPECT_EQ(faults(),
            "* manifest.json: is missing; the run was cut off\n"
            "* car.csv:2: has 2 cells, must have 14\n");
}

TEST_F(Results, ThatSayDoneTooEarlyAreNotSound) {
  finish();
  Manifest manifest = parse_manifest(content(kManifest), "").value();
  manifest.steps_planned = 6;
  ASSERT_TRUE(write_file(folder() / kManifest, text(manifest)).ok());
  EXPECT_EQ(faults(), "manifest.json: says done, but 5 of 6 steps are there\n");
}

TEST_F(Results, OfALostRecorderAreRepairedToTheLastStepThatAllTablesHave) {
  shorten("road.csv", kLastRow + 1);  // step 5 is not there, step 4 is torn
  append("car.csv", "6,WL,");
  append("stop.csv", "6,0.6,0");
  write("others.csv", "step,vehicle\n1,4\n3,4\n4,4\n4,");
  write("summary.json.unfinished", "{");
  Manifest lost = facts("lost:recorder");
  lost.culprit = "the recorder was killed by signal 9";

  const auto manifest = repair(folder(), lost);
  ASSERT_TRUE(manifest.ok()) << manifest.error().text();
  EXPECT_EQ(manifest.value().complete_to_step, 3);
  EXPECT_EQ(manifest.value().culprit, "the recorder was killed by signal 9");
  EXPECT_EQ(faults(), "");
  EXPECT_EQ(inspect(folder()).value().manifest, manifest.value());
  // t_3 = 0.3 s: the car that left at 0.25 s stays, the one at 0.45 s goes.
  EXPECT_EQ(content("car.csv"), car_columns() + "\n4,WL,0,0,0,0,0,0,0,0,0.0,0.25,0,0\n");
  EXPECT_EQ(content("others.csv"), "step,vehicle\n1,4\n3,4\n");
  for (const FileEntry& file : manifest.value().files) {
    EXPECT_EQ(file.sha256, sha256_hex(content(file.name))) << file.name;
    if (file.name == kStopTable || file.name == kRoadTable || file.name == kStopTimeTable) {
      EXPECT_EQ(file.rows, 3);
    }
  }
}

/// A row of stops.csv.
std::string stop_row(Step step) {
  return std::to_string(step) + ",0.1,4,WL,0,1,0.1,2.5,0.1,unequipped,not_equipped,\n";
}

/// A row of safety.csv.
std::string safety_row(Step step) {
  return std::to_string(step) + ",0.1,ttc,8,WL,1,4,WL,0,0,1,0.1,2,1,0.1,2.5,30,12\n";
}

TEST_F(Results, MayHoldTablesOfEvents) {
  write("stops.csv", stops_columns() + "\n" + stop_row(2) + stop_row(2) + stop_row(5));
  write("guidance.csv", guidance_columns() + "\n");
  write("requests.csv", requests_columns() + "\n3,0.3,0,WC EC,accepted,\n");
  write("safety.csv", safety_columns() + "\n" + safety_row(2) + safety_row(5));
  finish();
  EXPECT_EQ(faults(), "");
}

TEST_F(Results, SayWhichEventIsOutOfOrderOrBeyondTheEnd) {
  finish();
  write("stops.csv", stops_columns() + "\n" + stop_row(3) + stop_row(2));
  EXPECT_EQ(faults(),
            "* stops.csv:3: is of step `2`, must be of one from 3 to 5\n"
            "stops.csv: does not stand in the manifest\n");
  write("stops.csv", stops_columns() + "\n" + stop_row(6));
  EXPECT_EQ(faults(),
            "* stops.csv:2: is of step `6`, must be of one from 0 to 5\n"
            "stops.csv: does not stand in the manifest\n");
  write("safety.csv", safety_columns() + "\n" + safety_row(4) + safety_row(3));
  EXPECT_NE(faults().find("* safety.csv:3: is of step `3`, must be of one from 4 to 5"), std::string::npos);
  write("stops.csv", "step\n");
  EXPECT_NE(faults().find("stops.csv:1: has other columns than " + stops_columns()), std::string::npos);
}

TEST_F(Results, OfALostRecorderKeepTheEventsUpToTheLastStep) {
  shorten("road.csv", kLastRow);  // complete to step 4
  write("stops.csv", stops_columns() + "\n" + stop_row(2) + stop_row(4) + stop_row(5) + "5,0.5");
  write("guidance.csv", "");  // killed before the first row
  write("requests.csv", requests_columns() + "\n4,0.4,0,WC,accepted,\n5,0.5,0,WC,refused,conflict\n");
  write("safety.csv", safety_columns() + "\n" + safety_row(4) + safety_row(5));
  const auto manifest = repair(folder(), facts("lost:recorder"));
  ASSERT_TRUE(manifest.ok()) << manifest.error().text();
  EXPECT_EQ(content("safety.csv"), safety_columns() + "\n" + safety_row(4));
  EXPECT_EQ(content("stops.csv"), stops_columns() + "\n" + stop_row(2) + stop_row(4));
  EXPECT_EQ(content("guidance.csv"), guidance_columns() + "\n");
  EXPECT_EQ(content("requests.csv"), requests_columns() + "\n4,0.4,0,WC,accepted,\n");
  EXPECT_EQ(faults(), "");
}

TEST_F(Results, ThatAreWholeAreNotTouchedByRepair) {
  const std::string before = content("car.csv") + content("stop.csv") + content("road.csv") + content("stop_time.csv");
  const auto manifest = repair(folder(), facts("interrupted"));
  ASSERT_TRUE(manifest.ok());
  EXPECT_EQ(manifest.value().complete_to_step, kSteps);
  EXPECT_EQ(content("car.csv") + content("stop.csv") + content("road.csv") + content("stop_time.csv"), before);
}

TEST_F(Results, WithoutAnyWholeTableAreRepairedToNoSteps) {
  fs::remove(folder() / "stop.csv");
  write("road.csv", "step,ti");
  const auto manifest = repair(folder(), facts("lost:recorder"));
  ASSERT_TRUE(manifest.ok()) << manifest.error().text();
  EXPECT_EQ(manifest.value().complete_to_step, 0);
  EXPECT_EQ(content("stop_time.csv"), stop_time_columns() + "\n");
  EXPECT_EQ(content("car.csv"), car_columns() + "\n");
  EXPECT_EQ(faults(), "");
}

TEST_F(Results, OfAnotherKindAreNotRepaired) {
  write("stop.csv", "a,b\n1,2\n");
  const auto manifest = repair(folder(), facts("lost:recorder"));
  ASSERT_FALSE(manifest.ok());
  EXPECT_EQ(manifest.error().text(), (folder() / "stop.csv").string() + ":1: has other columns than " + stop_columns() +
                                         "; it cannot be repaired");
  EXPECT_EQ(content("stop.csv"), "a,b\n1,2\n");
}

TEST_F(Results, AreAFolder) {
  EXPECT_EQ(inspect(folder() / "none").error().text(), (folder() / "none").string() + ": is no result folder");
}

}  // namespace
}  // namespace lukou::results
