// What a viewer may be told in English sentences, each provoked in the code that says it. The page has them in Chinese,
// too: sentences.txt is what its test goes through (web/lib/i18n/said.test.ts), and this test keeps it true.

#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/scenario/scenario.hpp"
#include "console.pb.h"
#include "services/lukou/replay/player.hpp"
#include "tests/unit/common/lockstep/clock_rig.hpp"
#include "tests/unit/services/console/hub_rig.hpp"

namespace lukou::console {
namespace {

/// Sentences in the order in which they were heard, line by line, each once.
class Heard {
 public:
  void add(const std::string& text) {
    std::size_t from = 0;
    while (from <= text.size()) {
      const std::size_t to = std::min(text.find('\n', from), text.size());
      const std::string line = text.substr(from, to - from);
      if (!line.empty() && known_.insert(line).second) lines.push_back(line);
      from = to + 1;
    }
  }
  std::vector<std::string> lines;

 private:
  std::set<std::string> known_;
};

void hear_the_hub(Heard& heard) {
  Rig early;
  const ViewerId first = early.hub.came();
  early.ask(first, "pause");
  for (const ToPage& message : early.all(first, ToPage::kReply)) heard.add(message.reply().text());

  Rig rig;
  rig.begin();
  const ViewerId one = rig.hub.came();
  const ViewerId two = rig.hub.came();
  heard.add(rig.refusal(one, "pause"));
  rig.take_control(two);
  heard.add(rig.refusal(one, "pause"));
  rig.take_control(one, true);
  heard.add(rig.refusal(one, "set a=" + std::string(40'000, 'x')));
  heard.add(rig.refusal(one, std::string("set a=1\0b", 9)));
  heard.add(rig.refusal(one, "vanish"));
  heard.add(rig.refusal(one, "restart x"));
  rig.ask(one, "restart 5");
  FromPage release;
  release.mutable_release_control();
  EXPECT_TRUE(rig.say(one, release));
  for (const ToPage& message : rig.all(two, ToPage::kEvent)) heard.add(message.event().text());
  rig.take_control(one);
  for (std::uint32_t n = 0; n < 64; ++n) rig.ask(one, "step", n);
  heard.add(rig.refusal(one, "step"));
  rig.hub.tell({.phase = RunPhase::kEnded}, 0.0, 1.0);
  heard.add(rig.refusal(one, "pause"));
  static_cast<void>(rig.all(one));
  rig.hub.tell({.phase = RunPhase::kRunning}, 4.2, 2.0);
  for (const ToPage& message : rig.all(one, ToPage::kStatus)) heard.add(message.status().text());

  Rig attached(false);
  attached.begin();
  const ViewerId viewer = attached.hub.came();
  attached.take_control(viewer);
  heard.add(attached.refusal(viewer, "restart 5"));

  Rig recording;
  recording.begin({}, 9000);
  const ViewerId watcher = recording.hub.came();
  recording.take_control(watcher);
  heard.add(recording.refusal(watcher, "set vehicles.equipped_ratio=1"));
  heard.add(recording.refusal(watcher, "vanish"));
}

std::string refusal(const std::string& answer) {
  EXPECT_TRUE(answer.starts_with("refused: ")) << answer;
  return answer.substr(std::min<std::size_t>(answer.size(), 9));
}

/// A clock whose changes are checked as those of a run.
ClockSettings settings(scenario::Resolved& scenario) {
  ClockSettings settings = ClockRig::usual();
  settings.check_change = [&scenario](const std::string& set) { return scenario::change(scenario, set); };
  return settings;
}

scenario::Resolved loaded(const std::string& text) {
  auto scenario = scenario::load_text(text, "test", "/");
  EXPECT_TRUE(scenario.ok()) << scenario.error().text();
  return std::move(scenario).value();
}

void hear_the_clock(Heard& heard) {
  scenario::Resolved scenario = loaded("");
  ClockRig rig(settings(scenario));
  rig.form();
  for (const char* request : {"pause soon", "stop at -1", "step 0", "pace quick", "pace 0", "vanish"}) {
    heard.add(refusal(rig.ask(request)));
  }
  static_cast<void>(rig.ask("stop"));
  heard.add(refusal(rig.ask("pause")));

  ClockSettings closed = ClockRig::usual();
  closed.check_change = nullptr;
  ClockRig unchanging(closed);
  unchanging.form();
  heard.add(refusal(unchanging.ask("set a=1")));

  ClockSettings replaying = settings(scenario);
  replaying.replay = {{500, "traffic.west.flow_veh_per_h=1"}};
  ClockRig replay(replaying);
  replay.form();
  heard.add(refusal(replay.ask("set traffic.west.flow_veh_per_h=2")));
}

/// What replays a recording in the clock's place.
void hear_the_replay(Heard& heard) {
  replay::Player player(9000, 0.0);
  for (const char* request : {"seek soon", "set a=1", "vanish"}) {
    const auto answer = player.request(0.0, request);
    ASSERT_FALSE(answer.ok());
    heard.add(answer.error().text());
  }
}

/// How runs end that do not end well.
void hear_the_ends(Heard& heard) {
  const auto end_of = [&heard](const ClockRig& rig) { heard.add(rig.core.state().text); };
  ClockRig left;
  left.form();
  left.up({.kind = Up::Kind::kLeave, .incarnation = kEngine});
  end_of(left);
  ClockRig gone;
  gone.form();
  gone.core.gone(gone.now_s, kEngine);
  end_of(gone);
  ClockRig late;
  late.join(kEngine, "traffic-engine");
  late.idle(31.0);
  end_of(late);
  ClockRig unseen;
  unseen.everybody_joins();
  unseen.idle(31.0);
  end_of(unseen);
  ClockRig stalled;
  stalled.form();
  stalled.progress(kEngine, 0, "");
  stalled.idle(31.0);
  end_of(stalled);
  ClockRig puzzled;
  puzzled.form();
  for (int second = 0; second < 31; ++second) {
    for (const auto& [incarnation, role] : puzzled.core.roster()) puzzled.progress(incarnation, -1, "somebody");
    puzzled.idle(1.0);
  }
  end_of(puzzled);
}

/// Every way in which a change of a field that may change can be wrong.
void hear_the_scenario(Heard& heard) {
  const auto set = [&heard](const std::string& text, const std::vector<std::string>& changes) {
    scenario::Resolved scenario = loaded(text);
    ClockRig rig(settings(scenario));
    rig.form();
    for (const std::string& change : changes) heard.add(refusal(rig.ask("set " + change)));
  };
  const std::string west = "traffic.west.flow_veh_per_h";
  set("", {west,
           "a..b=1",
           "traffik.west=1",
           "traffic.wets=1",
           "traffic.zzzzzzzzzz=1",
           "traffic.west.flow_series.from_s=1",
           "rsus[3].id=1",
           "traffic[0]=1",
           west + ".more=1",
           "rsus.id=1",
           "vehicles.length_m=4",
           west + "=many",
           west + "=99999",
           "vehicles.equipped_ratio=-1",
           west + "=nan",
           "signals.preset=PAPIER",
           "signals.preset=PRESET_UNSET",
           "radio.uplink.half_duplex=perhaps",
           "vehicles.on_board_unit.fallback_s=x",
           "radio.uplink.collisions=true",
           "radio.load={}",
           "radio.outages[0]={from_s: 20 to_s: 10}",
           "radio.outages[0]={from_s: 0.05 to_s: 10}",
           "radio.outages[0]={from_s: 2 to_s: 10 rsu: 5}",
           "radio.outages[0]={from_s: 2 to_s: 10 area {x_min_m: 5 x_max_m: 1 y_min_m: 0 y_max_m: 1}}",
           "radio.outages[0]={to_s: 10}",
           "radio.uplink.loss.burst={rate: 0.9 mean_length: 2}",
           "radio.uplink.loss.burst={rate: }",
           "radio.uplink.loss.burst={rate: 0.1 rate: 0.2}",
           "radio.uplink.loss.burst={rates: 0.1}",
           "radio.uplink.loss.burst={rate: 0.1",
           "radio.uplink.loss.burst={rate: a}",
           "radio.outages[0]={from_s: 2 to_s: 10 direction: DOWNWARDS}",
           "radio.outages[0]={from_s: 2 to_s: 10 rsu: x}",
           "radio.uplink.loss.burst=0.1",
           "radio.uplink.latency={uniform {min_ms: 5 max_ms: 1}}",
           "radio.uplink.latency={constant_ms: 5 uniform {min_ms: 1 max_ms: 5}}"});
  set("rsus { } rsus { }", {"rsus[4].id=1"});
  set("vehicles { compliance { ignoring_share: 0.4 } }", {"vehicles.compliance.human_share=0.8"});
  set("radio { uplink { latency { constant_ms: 5 } } }", {"radio.uplink.latency.uniform={min_ms: 1 max_ms: 2}"});
  set("traffic { west { flow_veh_per_h: 5 } }", {"traffic.west.flow_series[0]={from_s: 0 flow_veh_per_h: 1}"});

  const std::string all = "lanes: [\"WL\", \"WC\", \"WR\", \"SL\", \"SC\", \"SR\", \"EL\", \"EC\", \"ER\", \"NL\", ";
  const std::string aspects = "aspects {aspect: GREEN duration_s: 20} aspects {aspect: RED duration_s: 20}";
  const auto plan = [](const std::string& inside) { return "signals.plan={cycle_s: 40 " + inside + "}"; };
  set("", {plan("lane_plans {" + all + "\"NC\", \"XX\"] " + aspects + "}"),
           plan("lane_plans {" + all + "\"NC\", \"WL\"] " + aspects + "}"),
           plan("lane_plans {" + all + "\"NC\"] " + aspects + "}"),
           plan("lane_plans {" + all + "\"NC\", \"NR\"] aspects {aspect: GREEN duration_s: 20}}"),
           plan("lane_plans {" + all + "\"NC\", \"NR\"] " + aspects + "}"),
           plan("lane_plans {" + all + "\"NC\", \"NR\"] aspects {duration_s: 40}}"),
           "signals.plan={cycle_s: 40.05 lane_plans {" + all + "\"NC\", \"NR\"] " + aspects + "}}",
           plan("lane_plans {" + all +
                "\"NC\", \"NR\"] aspects {aspect: GREEN duration_s: 0} aspects {aspect: RED "
                "duration_s: 40}}")});
}

TEST(Sentences, AreThoseThatThePageKnows) {
  Heard heard;
  hear_the_hub(heard);
  hear_the_clock(heard);
  hear_the_replay(heard);
  hear_the_ends(heard);
  hear_the_scenario(heard);
  std::vector<std::string> listed;
  std::ifstream file(SENTENCES);
  for (std::string line; std::getline(file, line);) listed.push_back(line);
  std::string all;
  for (const std::string& line : heard.lines) all += line + "\n";
  EXPECT_EQ(heard.lines, listed) << "sentences.txt must hold, line by line:\n" << all;
}

}  // namespace
}  // namespace lukou::console
