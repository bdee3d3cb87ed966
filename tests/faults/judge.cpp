#include "tests/faults/judge.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <set>

#include "common/results/inspection.hpp"
#include "common/results/result_folder.hpp"
#include "common/scenario/directive_log.hpp"
#include "tests/system/program.hpp"

namespace lukou::faults {
namespace {

namespace fs = std::filesystem;

/// A process whose liveliness has not been heard for 2 s is lost; on a busy machine somewhat earlier or later.
constexpr double kSurelyNoticed_s = 4.0;
constexpr double kSurelyNot_s = 1.5;

enum class Effect : std::uint8_t { kNone, kPerhaps, kSure };

/// Whether a fault means that the victim is lost to the run.
Effect effect_of(const Fault& fault, const Done& done) {
  if (!done.hit || fault.victim == "console") return Effect::kNone;
  if (fault.action == Action::kSlow) return Effect::kNone;
  const bool for_a_while = fault.action == Action::kStopFor;
  if (for_a_while && (fault.victim == "lukou" || fault.stop_s < kSurelyNot_s)) return Effect::kNone;
  if (for_a_while && fault.stop_s < kSurelyNoticed_s) return Effect::kPerhaps;
  return Effect::kSure;
}

/// How a run may end.
struct Ending {
  int code = 0;
  std::string culprit;  ///< role; empty: none

  auto operator<=>(const Ending&) const = default;
};

Ending ending_by_signal(Action action) {
  switch (action) {
    case Action::kInterrupt:
      return {130, ""};
    case Action::kTerminate:
    case Action::kHangUp:
      return {143, ""};
    default:
      return {128 + SIGKILL, ""};
  }
}

/// Whether the run survives the loss of the victim.
bool survives(const Plan& plan, const Fault& fault, const Done& done) {
  return rsu_index(fault.victim) >= 0 && plan.policy != "ABORT" && !done.forming;
}

/// Every ending that the faults may have, as far as it is known when they met the run.
std::set<Ending> endings(const Plan& plan, const Observed& observed) {
  std::set<Ending> possible = {{0, ""}};
  bool sure = false;
  for (std::size_t i = 0; i < plan.faults.size(); ++i) {
    const Fault& fault = plan.faults[i];
    const Done& done = observed.done[i];
    Effect effect = effect_of(fault, done);
    if (effect == Effect::kNone) continue;
    // A run that ends already may still reach its end.
    const double per_s = plan.pace == "max" ? 5000.0 : 10.0 * std::stod(plan.pace);
    const bool late = done.over || static_cast<double>(done.seen) > static_cast<double>(plan.steps) - 0.5 * per_s;
    if (sure || late || (done.forming && done.seen < 0)) effect = Effect::kPerhaps;
    if (survives(plan, fault, done)) {
      if (plan.policy == "WAIT" && observed.interrupted) possible.insert({130, ""});
      continue;
    }
    // What an observer has not seen yet may be forming still: then every loss is the end.
    if (effect == Effect::kSure) {
      possible.erase({0, ""});
      sure = true;
    }
    possible.insert(fault.victim == "lukou" ? ending_by_signal(fault.action) : Ending{3, fault.victim});
  }
  if (observed.interrupted) possible.insert({130, ""});
  return possible;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::set<std::string> tables_of(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv") names.insert(entry.path().filename());
  return names;
}

class Judge {
 public:
  Judge(const Plan& plan, const Observed& observed, fs::path folder, fs::path scratch)
      : plan_(plan), observed_(observed), folder_(std::move(folder)), scratch_(std::move(scratch)) {}

  Verdict run() {
    verdict_.planned = plan_.steps;
    if (observed_.code == -1) complain(Wrong::kHang, "did not end within a minute");
    for (const std::string& left : observed_.left) complain(Wrong::kOrphan, left);
    exit_code();
    by_hand();
    if (!fs::exists(folder_ / "scenario.textproto")) {
      // Ended before it had made its folder: only right if it was `lukou` itself that was hit at once.
      verdict_.ended = "nothing";
      if (!hit("lukou")) complain(Wrong::kUnsound, "there is no result folder");
      return verdict_;
    }
    if (inspect()) replay();
    return verdict_;
  }

 private:
  void complain(Wrong wrong, const std::string& text) { verdict_.complaints.push_back({wrong, text}); }

  [[nodiscard]] bool hit(const std::string& victim) const {
    for (std::size_t i = 0; i < plan_.faults.size(); ++i)
      if (observed_.done[i].hit && plan_.faults[i].victim == victim) return true;
    return false;
  }

  /// Whether `lukou` was killed: then nobody can say anything any more.
  [[nodiscard]] bool launcher_killed() const { return observed_.code == 128 + SIGKILL; }

  void exit_code() {
    if (observed_.code == -1) return;
    std::string allowed;
    for (const Ending& ending : endings(plan_, observed_)) {
      const bool named =
          ending.culprit.empty() || observed_.err.find("aborted: " + ending.culprit + " ") != std::string::npos;
      if (ending.code == observed_.code && named) {
        culprit_ = ending.culprit;
        return;
      }
      allowed += (allowed.empty() ? "" : " or ") + std::to_string(ending.code) +
                 (ending.culprit.empty() ? "" : " (" + ending.culprit + ")");
    }
    complain(Wrong::kExitCode, "code " + std::to_string(observed_.code) + ", should be " + allowed +
                                   "; it said: " + observed_.err.substr(0, 300));
  }

  void by_hand() {
    for (std::size_t i = 0; i < plan_.faults.size(); ++i) {
      const Done& done = observed_.done[i];
      if (done.restarted == -2 || plan_.faults[i].victim == "console") continue;
      // It took part to the end, was refused or found no clock, or the run ended around it.
      if (done.restarted == 0 || done.restarted == 2 || done.restarted == 3) continue;
      complain(Wrong::kByHand, plan_.faults[i].victim + " started again ended with " + std::to_string(done.restarted) +
                                   ": " + done.said.substr(0, 300));
    }
  }

  /// False if there is nothing to replay.
  bool inspect() {
    const test::Finished inspected = test::lukou({"inspect", folder_.string()});
    const auto read = results::inspect(folder_);
    if (!read) {
      complain(Wrong::kUnsound, read.error().text());
      return false;
    }
    const results::Inspection& inspection = read.value();
    verdict_.complete_to = inspection.complete_to_step;
    verdict_.ended = inspection.manifest ? inspection.manifest->ended_by : "no manifest";
    // Killed while the run formed, `lukou` leaves a folder without a record: nobody was there yet to write one.
    if (!inspection.manifest && launcher_killed() && verdict_.complete_to == 0) return false;
    if (inspected.code != 0) complain(Wrong::kUnsound, inspected.out);
    if (!inspection.manifest) return false;
    check_ending(*inspection.manifest);
    for (const Done& done : observed_.done) {
      if (done.recorded > verdict_.complete_to) {
        complain(Wrong::kLostRows, "step " + std::to_string(done.recorded) + " was recorded, complete to " +
                                       std::to_string(verdict_.complete_to));
      }
    }
    return true;
  }

  void check_ending(const results::Manifest& manifest) {
    const std::string& ended = manifest.ended_by;
    std::set<std::string> right;
    if (observed_.code == 0) right = {"done"};
    if (observed_.code == 130 || observed_.code == 143) right = {"interrupted"};
    if (observed_.code == 3) right = {"lost:" + culprit_, "stalled:" + culprit_};
    if (launcher_killed()) right = {"lost:lukou", "done"};
    if (!right.empty() && !right.contains(ended)) {
      complain(Wrong::kUnsound, "the manifest says ended by " + ended + ", should be " + *right.begin());
    }
    if (observed_.code == 0 && verdict_.complete_to != plan_.steps) {
      complain(Wrong::kLostRows, "done, but complete to " + std::to_string(verdict_.complete_to) + " only");
    }
  }

  /// The run again in one process from its scenario and its directives, ended where this one ended.
  void replay() {
    const fs::path written = folder_ / "directives.textproto";
    scenario::DirectiveLog log;
    const bool closed = fs::exists(written);  // by its recorder: otherwise `lukou` mended the folder
    if (closed) {
      const auto read = scenario::load_directives(written);
      if (!read) return complain(Wrong::kReplay, read.error().text());
      log = read.value();
    }
    check_hearings(log);
    const bool early = verdict_.complete_to < plan_.steps;
    if (early) log.stop = verdict_.complete_to;
    const fs::path directives = scratch_ / "directives.textproto";
    std::ofstream(directives) << scenario::text(log);
    const fs::path again = scratch_ / "again";
    const test::Finished replay =
        test::lukou({"run", (folder_ / "scenario.textproto").string(), "--mode", "in-process", "--quiet",
                     "--replay-directives", directives.string(), "--out", again.string()});
    if (replay.code != 0)
      return complain(Wrong::kReplay, "the replay ends with " + std::to_string(replay.code) + ": " + replay.err);
    const Wrong kind = log.hearings.empty() ? Wrong::kTables : Wrong::kReplay;
    // A run that never began has the four tables alone, which `lukou` made.
    const bool begun = closed || verdict_.complete_to > 0;
    if (begun && tables_of(folder_) != tables_of(again)) complain(kind, "other tables than the replay");
    for (const std::string& table : tables_of(folder_)) {
      if (closed ? test::content(folder_ / table) == test::content(again / table) : is_prefix(table, again)) continue;
      complain(kind, table + " differs from the replay's");
    }
    if (closed && test::content(folder_ / "summary.json") != test::content(again / "summary.json")) {
      complain(kind, "summary.json differs from the replay's");
    }
  }

  [[nodiscard]] bool is_prefix(const std::string& table, const fs::path& again) const {
    const auto ours = lines_of(folder_ / table);
    const auto theirs = lines_of(again / table);
    return ours.size() <= theirs.size() && std::equal(ours.begin(), ours.end(), theirs.begin());
  }

  /// The engine stops hearing an RSU only if that was lost, and hears it again under a new epoch.
  void check_hearings(const scenario::DirectiveLog& log) {
    std::set<std::uint32_t> silent;
    for (const scenario::Hearing& hearing : log.hearings) {
      if (hearing.epoch == 0) {
        silent.insert(hearing.rsu);
        if (!hit(rsu_role(hearing.rsu))) {
          complain(Wrong::kTables, "rsu" + std::to_string(hearing.rsu) + " fell silent, but nobody hurt it");
        }
      } else {
        verdict_.returned += static_cast<std::uint32_t>(silent.erase(hearing.rsu));
        check_guidance(hearing);
      }
    }
    if (!log.sets.empty()) complain(Wrong::kTables, "has changes that nobody asked for");
  }

  /// After its return the RSU's advice is used again, if there is time for it.
  void check_guidance(const scenario::Hearing& returned) {
    constexpr Step kSoon = 50;
    if (returned.from + kSoon > verdict_.complete_to || !fs::exists(folder_ / "guidance.csv")) return;
    // step,time_s,issued_step,issued_s,rsu,sequence,vehicle,lane,commanded_mps2,fate,...
    for (const std::string& line : lines_of(folder_ / "guidance.csv")) {
      std::vector<std::string> cells;
      std::stringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      if (cells.size() < 10 || cells[4] != std::to_string(returned.rsu)) continue;
      if (std::atoll(cells[2].c_str()) >= returned.from - 1 &&
          (cells[9] == "applied" || cells[9].starts_with("changed")))
        return;
    }
    complain(Wrong::kReplay, "rsu" + std::to_string(returned.rsu) + " came back at step " +
                                 std::to_string(returned.from) + ", but guidance did not");
  }

  const Plan& plan_;
  const Observed& observed_;
  fs::path folder_;
  fs::path scratch_;
  std::string culprit_;
  Verdict verdict_;
};

}  // namespace

std::string name(Wrong wrong) {
  switch (wrong) {
    case Wrong::kHang:
      return "hangs";
    case Wrong::kExitCode:
      return "wrong exit codes";
    case Wrong::kOrphan:
      return "orphans and leftovers";
    case Wrong::kUnsound:
      return "unsound folders";
    case Wrong::kLostRows:
      return "lost rows";
    case Wrong::kTables:
      return "other tables than undisturbed";
    case Wrong::kReplay:
      return "replays that differ";
    case Wrong::kByHand:
      return "restarts that went wrong";
  }
  return "";
}

Verdict judge(const Plan& plan, const Observed& observed, const fs::path& folder, const fs::path& scratch) {
  return Judge(plan, observed, folder, scratch).run();
}

}  // namespace lukou::faults
