#include <random>

#include "tests/unit/common/lockstep/clock_rig.hpp"

namespace lukou {
namespace {

/// What a member of the run may rely on, checked message by message.
class Watcher {
 public:
  void check(const Control& control, Step end) {
    ASSERT_EQ(control.sequence, expected_++);
    ASSERT_FALSE(over_) << "nothing but answers follows the end";
    if (control.kind == Control::Kind::kEnded || control.kind == Control::Kind::kAbort) over_ = true;
    if (control.kind != Control::Kind::kGrant) return;
    ASSERT_FALSE(last_) << "no grant follows the last one";
    ASSERT_LE(control.through, end);
    ASSERT_TRUE(control.through > through_ || (control.last && control.through == through_));
    ASSERT_EQ(control.directive_step.size(), control.directive_set.size());
    for (const Step step : control.directive_step) {
      ASSERT_GT(step, through_) << "never for a step that was granted before";
      ASSERT_GE(step, directive_) << "in the order of the steps";
      ASSERT_GE(step, 1);
      directive_ = step;
    }
    ASSERT_EQ(control.attach_rsu.size(), control.attach_from.size());
    for (std::size_t i = 0; i < control.attach_rsu.size(); ++i) {
      ASSERT_GT(control.attach_from[i], through_ + 1);
      ASSERT_GT(control.attach_epoch[i], epoch_) << "every life once";
      epoch_ = control.attach_epoch[i];
    }
    through_ = control.through;
    last_ = control.last;
  }
  [[nodiscard]] bool attached() const { return epoch_ > 1; }
  [[nodiscard]] bool changed() const { return directive_ > 0; }
  [[nodiscard]] bool last() const { return last_; }
  [[nodiscard]] bool over() const { return over_; }
  [[nodiscard]] Step through() const { return through_; }

 private:
  std::uint64_t expected_ = 0;
  Step through_ = -1;
  Step directive_ = 0;
  std::uint32_t epoch_ = 1;
  bool last_ = false;
  bool over_ = false;
};

constexpr const char* kRequests[] = {"pause",      "resume",       "step",         "step 7",    "pace 20",
                                     "pace max",   "set good.a=1", "set good.b=2", "set bad.c", "pause at 30",
                                     "stop at 90", "fly",          "resume",       "pace slow", "resume"};

/// How often the schedules came to something worth checking.
struct Seen {
  int ends = 0;
  int returns = 0;
  int changes = 0;
};

/// A run in which members, operator and RSU do what the seed says; answers to requests are left out of the check of the
/// end, since an operator is answered after it, too.
void play(std::uint32_t seed, RsuLossPolicy policy, Seen& seen) {
  std::mt19937 random(seed);
  const auto below = [&](Step n) { return static_cast<Step>(random()) % n; };
  auto settings = ClockRig::usual();
  settings.on_rsu_loss = policy;
  settings.pace = below(2) == 0 ? 0.0 : 50.0;
  settings.credit = 1 + below(100);
  settings.start_paused = below(3) == 0;
  const Step end = settings.end;
  ClockCore core(settings);
  Watcher watcher;
  double now_s = 5.0;
  Step recorded = -1;
  Incarnation rsu = kRsu;
  bool rsu_alive = true;
  bool receipt_due = false;
  const auto send = [&](Up message) { core.receive(now_s, message); };
  const auto join = [&](Incarnation who, const std::string& role) {
    send({.kind = Up::Kind::kJoin, .incarnation = who, .role = role});
  };
  for (int round = 0; round < 4000 && !watcher.over(); ++round) {
    now_s += 0.001 * static_cast<double>(below(100));
    switch (below(9)) {
      case 0:
        join(kEngine, "traffic-engine");
        join(kController, "signal-controller");
        break;
      case 1:
        join(kRecorder, "recorder");
        if (rsu_alive) join(rsu, "rsu0");
        break;
      case 2:
        for (const auto& [who, role] : core.roster()) {
          if (below(3) != 0) send({.kind = Up::Kind::kSees, .incarnation = who, .number = core.roster_version()});
        }
        core.sees(now_s, core.roster_version());
        break;
      case 3:
        if (watcher.through() > recorded) recorded += 1 + below(watcher.through() - recorded);
        send({.kind = Up::Kind::kCredit, .incarnation = kRecorder, .step = recorded});
        break;
      case 4:
        for (const auto& [who, role] : core.roster()) {
          send({.kind = Up::Kind::kProgress, .incarnation = who, .step = recorded, .text = "clock"});
        }
        break;
      case 5:
        if (below(4) == 0) send({.kind = Up::Kind::kRequest, .incarnation = kOperator, .text = kRequests[below(15)]});
        break;
      case 6:
        if (policy != RsuLossPolicy::kAbort && core.state().phase == RunPhase::kRunning && below(10) == 0) {
          core.gone(now_s, rsu);
          rsu_alive = false;
          receipt_due = true;
        }
        break;
      case 7:
        if (receipt_due) send({.kind = Up::Kind::kReceipt, .incarnation = kEngine, .number = 0, .step = recorded});
        receipt_due = false;
        if (!rsu_alive) ++rsu, rsu_alive = true;
        break;
      default:
        core.tick(now_s);
        break;
    }
    if (watcher.last() && recorded == watcher.through()) {
      send({.kind = Up::Kind::kClosed, .incarnation = kRecorder, .step = recorded});
    }
    for (const Control& control : core.take_outbox()) {
      watcher.check(control, end);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
  seen.ends += watcher.over() ? 1 : 0;
  seen.returns += watcher.attached() ? 1 : 0;
  seen.changes += watcher.changed() ? 1 : 0;
  ASSERT_GE(watcher.through(), 0) << "the schedule got the run going";
  ASSERT_EQ(watcher.over(), core.outcome().has_value());
}

TEST(ClockInAnySchedule, KeepsItsPromisesToTheMembers) {
  Seen seen;
  for (const RsuLossPolicy policy : {RsuLossPolicy::kAbort, RsuLossPolicy::kContinue, RsuLossPolicy::kWait}) {
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
      play(seed, policy, seen);
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed << " policy " << static_cast<int>(policy);
    }
  }
  EXPECT_GT(seen.ends, 100);
  EXPECT_GT(seen.returns, 100);
  EXPECT_GT(seen.changes, 300);
}

}  // namespace
}  // namespace lukou
