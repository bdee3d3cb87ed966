#include "services/lukou/replay/recording.hpp"

#include <gtest/gtest.h>

#include "services/lukou/launch/run_request.hpp"
#include "tests/unit/common/bus/members.hpp"
#include "tests/unit/common/results/test_folder.hpp"

namespace lukou::replay {
namespace {

class RecordingOfARun : public results::InTestFolder {
 protected:
  std::filesystem::path run(const std::string& level) {
    auto scenario = scenario::load("paper", {"run.duration_s=130", "radio.preset=PC5_MODE4", "record.log=" + level});
    EXPECT_TRUE(scenario) << scenario.error().text();
    launch::RunRequest request{.scenario = std::move(scenario).value(), .name = "test", .in_process = true};
    request.out = folder() / level;
    EXPECT_EQ(launch::run_in_process(request, {}).exit_code, 0);
    return request.out;
  }
  static View at(Recording& recording, Step step) {
    EXPECT_EQ(recording.go_towards(step, 100'000).value(), step);
    View view;
    recording.fill(view);
    EXPECT_TRUE(view.well_formed());
    EXPECT_EQ(view.step, step);
    return view;
  }
};

bool same(View a, View b) {
  // Not-a-number entries stand for "not known": compared by their bits they are equal.
  const auto bits = [](View& view) {
    for (auto* column : {&view.commanded_mps2, &view.radio_latency_ms, &view.figures.mean_delay_s,
                         &view.figures.mean_stop_time_s, &view.figures.stops_per_vehicle}) {
      for (double& value : *column) value = value == value ? value : -1e9;
    }
    return members(view);
  };
  return bits(a) == bits(b);
}

TEST_F(RecordingOfARun, ShowsAPlaceTheSameHoweverItWasReached) {
  auto opened = Recording::open(run("FULL"));
  ASSERT_TRUE(opened) << opened.error().text();
  Recording& recording = opened.value();
  EXPECT_EQ(recording.last(), 1300);
  const View forth = at(recording, 1250);
  EXPECT_GT(forth.vehicle.size(), 20U);
  const View early = at(recording, 3);
  const View middle = at(recording, 700);
  EXPECT_TRUE(same(at(recording, 1250), forth));
  EXPECT_TRUE(same(at(recording, 3), early)) << "before the first picture that is kept";
  EXPECT_TRUE(same(at(recording, 700), middle));
}

TEST_F(RecordingOfARun, GoesSoManyStepsAtATime) {
  auto recording = Recording::open(run("FULL"));
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording.value().go_towards(1000, 30).value(), 29) << "from before step 0";
  EXPECT_EQ(recording.value().go_towards(1000, 30).value(), 59);
  EXPECT_EQ(recording.value().go_towards(40, 30).value(), 30) << "back to step 0, whose picture is kept";
}

TEST_F(RecordingOfARun, NeedsTheWholeLog) {
  const auto folder = run("SECOND");
  const auto recording = Recording::open(folder);
  ASSERT_FALSE(recording);
  EXPECT_EQ(recording.error().text(),
            (folder / "run.mcap").string() + ": was recorded with record.log=SECOND, a replay needs FULL");
}

}  // namespace
}  // namespace lukou::replay
