#include "services/lukou/report/car_story.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "common/intersection/lane.hpp"
#include "common/intersection/signal_plan.hpp"
#include "common/measures/stop_cause.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/table_reader.hpp"
#include "common/results/tables.hpp"
#include "common/run_log/run_log_reader.hpp"
#include "common/scenario/scenario.hpp"
#include "scenario.pb.h"

namespace lukou::report {
namespace {

namespace fs = std::filesystem;

/// Shorter stretches of another kind are no stretch of their own: a driver's wish and its limits alternate quickly.
constexpr Step kShortest = 5;

std::string rounded(double value, int decimals, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.*f %s", decimals, value, unit);
  return text;
}
std::string number(double value, const char* unit) { return rounded(value, 2, unit); }
std::string kmh(double speed_mps) { return rounded(speed_mps * 3.6, 0, "km/h"); }
std::string metres(double value) { return rounded(value, 0, "m"); }

const char* what_binds(BoundBy bound) {
  switch (bound) {
    case BoundBy::kOwnWish:
      return "drives as it likes";
    case BoundBy::kCarAhead:
      return "follows the car ahead";
    case BoundBy::kLight:
      return "brakes for the light or the queue there";
    case BoundBy::kAdvice:
      return "follows advice";
    case BoundBy::kLimit:
      return "follows advice up to a limit";
    case BoundBy::kGuard:
      return "is held by the guard";
    case BoundBy::kBlock:
      return "moves with the queue at the line";
  }
  return "drives";
}

std::string_view cause_of(std::uint8_t fate) {
  static constexpr std::string_view kCauses[] = {"heard",     "random",    "burst",       "range",
                                                 "path loss", "collision", "half duplex", "outage"};
  return fate < std::size(kCauses) ? kCauses[fate] : "?";
}

/// A stretch in which one thing decides the car's motion.
struct Stretch {
  Step from = 0;
  Step to = 0;
  BoundBy bound = BoundBy::kOwnWish;
  double speed_from_mps = 0.0;
  double speed_to_mps = 0.0;
  double distance_from_m = 0.0;
  double distance_to_m = 0.0;
};

/// Words of one RSU, one after the other.
struct Told {
  Step from = 0;
  Step to = 0;
  double least = 0.0;
  double most = 0.0;
  bool speed = false;
  std::map<std::string_view, std::uint32_t> by_fate;

  [[nodiscard]] std::uint32_t words() const {
    std::uint32_t all = 0;
    for (const auto& [fate, count] : by_fate) all += count;
    return all;
  }
  void add(const Told& more) {
    if (words() == 0) {
      *this = more;
      return;
    }
    to = more.to;
    least = std::fmin(least, more.least);
    most = std::fmax(most, more.most);
    for (const auto& [fate, count] : more.by_fate) by_fate[fate] += count;
  }
};

/// Fewer words lost in a row are counted among those that came; a longer silence ends a stretch of words.
constexpr std::uint32_t kLostInARow = 3;
constexpr Step kSilence = kStepsPerSecond;

class Teller {
 public:
  Teller(std::uint32_t vehicle, double line_m) : vehicle_(vehicle), line_m_(line_m) {}

  void take(const run_log::LoggedStep& step) {
    const TrafficBatch& traffic = step.traffic;
    enter(traffic);
    if (!seen_) return;
    drive(traffic);
    send(traffic);
    hear(traffic);
    cross(traffic);
  }
  [[nodiscard]] bool seen() const { return seen_; }
  [[nodiscard]] bool left() const { return left_; }

  void add(StoryLine line) { story_.push_back(std::move(line)); }

  std::vector<StoryLine> end() {
    for (const Stretch& stretch : smoothed(stretches_)) add(line_of(stretch));
    for (auto& [rsu, talk] : told_) close(rsu, talk);
    for (const auto& [rsu, counts] : sent_) {
      std::string text = std::to_string(counts.sent) + " messages to the roadside, rsu" + std::to_string(rsu) +
                         " hears " + std::to_string(counts.heard);
      if (counts.heard > 0) text += ", after " + number(counts.latency_ms / counts.heard, "ms") + " on average";
      add({counts.from, counts.to, "sent", text});
    }
    for (auto& [rsu, missed] : missed_) close(rsu, missed);
    std::ranges::stable_sort(story_, {}, &StoryLine::from);
    return std::move(story_);
  }

 private:
  struct Sent {
    Step from = 0;
    Step to = 0;
    std::uint32_t sent = 0;
    std::uint32_t heard = 0;
    double latency_ms = 0.0;
  };
  struct Missed {
    Step from = 0;
    Step to = -1;  ///< below `from`: none
    std::uint8_t fate = 0;
  };

  /// What an RSU says: words that came, then words that were lost in a row.
  struct Talk {
    Told came;
    Told lost;
  };

  void enter(const TrafficBatch& traffic) {
    for (std::size_t i = 0; i < traffic.entered_vehicle.size(); ++i) {
      if (traffic.entered_vehicle[i] != vehicle_) continue;
      seen_ = true;
      equipped_ = traffic.entered_equipped[i] != 0;
      add({traffic.step, traffic.step, "entered",
           "enters " + std::string(name(static_cast<Lane>(traffic.entered_lane[i]))) + " at " +
               kmh(traffic.entered_speed_mps[i]) + ", would like " + kmh(traffic.entered_desired_speed_mps[i]) +
               (equipped_ ? ", with an on-board unit" : ", without a unit")});
    }
  }

  void drive(const TrafficBatch& traffic) {
    const auto found = std::ranges::find(traffic.vehicle, vehicle_);
    if (found == traffic.vehicle.end()) return;
    const auto i = static_cast<std::size_t>(found - traffic.vehicle.begin());
    const auto bound = static_cast<BoundBy>(traffic.bound_by[i]);
    const double distance_m = line_m_ - traffic.position_m[i];
    if (stretches_.empty() || stretches_.back().bound != bound) {
      stretches_.push_back({.from = traffic.step,
                            .bound = bound,
                            .speed_from_mps = traffic.speed_mps[i],
                            .distance_from_m = distance_m});
    }
    Stretch& now = stretches_.back();
    now.to = traffic.step;
    now.speed_to_mps = traffic.speed_mps[i];
    now.distance_to_m = distance_m;
  }

  /// Messages of the step before, as each RSU told of them.
  void send(const TrafficBatch& traffic) {
    const Step sent = traffic.step - 1;
    for (std::size_t row = 0; row < traffic.uplink_vehicle.size(); ++row) {
      if (traffic.uplink_vehicle[row] != vehicle_) continue;
      const std::uint32_t rsu = traffic.uplink_rsu[row];
      const std::uint8_t fate = traffic.uplink.fate[row];
      Sent& counts = sent_.try_emplace(rsu, Sent{.from = sent}).first->second;
      counts.to = sent;
      ++counts.sent;
      Missed& missed = missed_[rsu];
      if (fate == kFrameHeard) {
        ++counts.heard;
        counts.latency_ms += traffic.uplink.latency_ms[row];
        close(rsu, missed);
      } else {
        if (missed.to >= missed.from && missed.fate != fate) close(rsu, missed);
        if (missed.to < missed.from) missed = {.from = sent, .fate = fate};
        missed.to = sent;
      }
    }
  }

  void close(std::uint32_t rsu, Missed& missed) {
    if (missed.to < missed.from) return;
    const Step count = missed.to - missed.from + 1;
    add({missed.from, missed.to, "missed",
         "rsu" + std::to_string(rsu) + " does not hear it: " + std::to_string(count) +
             (count == 1 ? " message, " : " messages in a row, ") + std::string(cause_of(missed.fate))});
    missed = {};
  }

  void hear(const TrafficBatch& traffic) {
    for (std::size_t row = 0; row < traffic.fate_vehicle.size(); ++row) {
      if (traffic.fate_vehicle[row] != vehicle_) continue;
      const bool speed = !std::isnan(traffic.fate_speed_mps[row]);
      const double value = speed ? traffic.fate_speed_mps[row] : traffic.fate_commanded_mps2[row];
      const std::string_view fate = name(static_cast<AdviceFate>(traffic.fate[row]));
      const Told word{.from = traffic.step,
                      .to = traffic.step,
                      .least = value,
                      .most = value,
                      .speed = speed,
                      .by_fate = {{fate, 1}}};
      if (traffic.fate_again[row] != 0) {
        change(told_[traffic.fate_rsu[row]], fate);
      } else {
        hear(traffic.fate_rsu[row], word, fate.starts_with("lost_"));
      }
    }
  }

  /// A word that was applied before has met with something else in a later step of its life.
  static void change(Talk& talk, std::string_view fate) {
    std::uint32_t& applied = talk.came.by_fate[name(AdviceFate::kApplied)];
    if (applied == 0) return;  // it was told of in a stretch that is over
    --applied;
    ++talk.came.by_fate[fate];
  }

  void hear(std::uint32_t rsu, const Told& word, bool lost) {
    Talk& talk = told_[rsu];
    if (lost) return talk.lost.add(word);
    const bool long_loss = talk.lost.words() >= kLostInARow;
    const bool goes_on = word.speed == talk.came.speed && word.from - talk.came.to <= kSilence;
    if (long_loss || (talk.came.words() > 0 && !goes_on)) {
      close(rsu, talk);
    } else if (talk.lost.words() > 0) {
      talk.came.add(std::exchange(talk.lost, {}));
    }
    talk.came.add(word);
  }

  void close(std::uint32_t rsu, Talk& talk) {
    const std::string who = "rsu" + std::to_string(rsu);
    const Told came = std::exchange(talk.came, {});
    const Told lost = std::exchange(talk.lost, {});
    if (came.words() > 0) {
      const char* unit = came.speed ? "m/s" : "m/s2";
      std::string text = "by " + who + ": ";
      if (!std::isnan(came.least)) text += number(came.least, unit);
      if (came.least < came.most) text += " ... " + number(came.most, unit);
      add({came.from, came.to, "told", text + ", " + counts(came)});
    }
    if (lost.words() > 0) add({lost.from, lost.to, "missed", "does not hear " + who + ": " + counts(lost)});
  }

  /// "12 words: 10 applied, 2 stale"
  static std::string counts(const Told& told) {
    const std::uint32_t words = told.words();
    std::string text = std::to_string(words) + (words == 1 ? " word" : " words");
    const char* between = ": ";
    for (const auto& [fate, count] : told.by_fate) {
      if (count == 0) continue;
      text += between + std::to_string(count) + " " + std::string(fate);
      between = ", ";
    }
    return text;
  }

  void cross(const TrafficBatch& traffic) {
    for (std::size_t i = 0; i < traffic.crossed_vehicle.size(); ++i) {
      if (traffic.crossed_vehicle[i] != vehicle_) continue;
      static constexpr const char* kHeads[] = {"?", "red", "yellow", "green"};
      const std::uint8_t aspect = traffic.crossed_aspect[i];
      add({traffic.step, traffic.step, "crossed",
           "crosses the stop line at " + number(traffic.crossed_time_s[i], "s") + " on " +
               kHeads[aspect < 4 ? aspect : 0] +
               (traffic.crossed_committed[i] != 0 ? "; it could not have stopped when the green ended" : "")});
    }
    for (std::size_t i = 0; i < traffic.left_vehicle.size(); ++i) {
      if (traffic.left_vehicle[i] != vehicle_) continue;
      left_ = true;
      add({traffic.step, traffic.step, "left", "leaves the end of its exit at " + number(traffic.left_time_s[i], "s")});
    }
  }

  /// Short stretches become part of the one before.
  static std::vector<Stretch> smoothed(const std::vector<Stretch>& all) {
    std::vector<Stretch> kept;
    for (const Stretch& stretch : all) {
      const bool goes_on =
          !kept.empty() && (stretch.to - stretch.from + 1 < kShortest || kept.back().bound == stretch.bound);
      if (!goes_on) {
        kept.push_back(stretch);
        continue;
      }
      kept.back().to = stretch.to;
      kept.back().speed_to_mps = stretch.speed_to_mps;
      kept.back().distance_to_m = stretch.distance_to_m;
    }
    return kept;
  }

  static StoryLine line_of(const Stretch& stretch) {
    const auto place = [](double distance_m) {
      return distance_m >= 0.0 ? metres(distance_m) + " before the line" : metres(-distance_m) + " behind it";
    };
    return {stretch.from, stretch.to, "drives",
            std::string(what_binds(stretch.bound)) + ": " + kmh(stretch.speed_from_mps) + " to " +
                kmh(stretch.speed_to_mps) + ", " + place(stretch.distance_from_m) + " to " +
                place(stretch.distance_to_m)};
  }

  std::uint32_t vehicle_;
  double line_m_;
  bool seen_ = false;
  bool equipped_ = false;
  bool left_ = false;
  std::vector<StoryLine> story_;
  std::vector<Stretch> stretches_;
  std::map<std::uint32_t, Sent> sent_;
  std::map<std::uint32_t, Missed> missed_;
  std::map<std::uint32_t, Talk> told_;
};

double value_of(std::string_view cell) {
  double value = 0.0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

/// When the car came onto the road, if its row says so: the log need not be read from the start.
Step entered_in_table(const fs::path& folder, std::uint32_t vehicle) {
  Step entered = 0;
  const std::string wanted = std::to_string(vehicle);
  static_cast<void>(results::scan_table(folder / results::kCarTable, [&](const auto& cells, std::int64_t) {
    if (cells[0] != wanted) return std::string();
    entered = std::llround(value_of(cells[3]) * static_cast<double>(kStepsPerSecond));
    return std::string("found");
  }));
  return entered;
}

void add_stops(const fs::path& folder, std::uint32_t vehicle, Teller& teller) {
  const std::string wanted = std::to_string(vehicle);
  static_cast<void>(results::scan_table(folder / results::kStopsTable, [&](const auto& cells, std::int64_t) {
    if (cells[2] != wanted) return std::string();
    std::string text = "stops " + metres(value_of(cells[7])) + " before the line and stands " + std::string(cells[8]) +
                       " s: " + std::string(cells[9]) + " (guidance: " + std::string(cells[10]);
    if (!cells[11].empty()) text += ", missed: " + std::string(cells[11]);
    teller.add({static_cast<Step>(value_of(cells[5])), static_cast<Step>(value_of(cells[0])), "stopped", text + ")"});
    return std::string();
  }));
}

}  // namespace

Expected<std::vector<StoryLine>> car_story(const fs::path& folder, std::uint32_t vehicle) {
  auto opened = run_log::RunLogReader::open(folder);
  if (!opened) return opened.error();
  run_log::RunLogReader& log = opened.value();
  const auto scenario = scenario::load_text(log.facts().scenario, (folder / run_log::kRunLog).string(), "/");
  if (!scenario) return scenario.error();
  Teller teller(vehicle, scenario.value().message().traffic().approach_length_m());
  log.seek(entered_in_table(folder, vehicle));
  while (!teller.left()) {
    const auto step = log.next();
    if (!step) return step.error();
    if (step.value() == nullptr) break;
    teller.take(*step.value());
  }
  if (!teller.seen()) {
    return Error{"--vehicle " + std::to_string(vehicle), "did not come onto the road in this run"};
  }
  add_stops(folder, vehicle, teller);
  return teller.end();
}

}  // namespace lukou::report
