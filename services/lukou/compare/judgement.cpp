#include "services/lukou/compare/judgement.hpp"

#include <algorithm>

#include "services/lukou/compare/by_car.hpp"
#include "services/lukou/study/number_text.hpp"

namespace lukou::compare {
namespace {

using studies::Measure;
using studies::Pairs;
using studies::RunRecord;

/// Two runs with the same seed.
struct SeedPair {
  std::size_t a = 0;
  std::size_t b = 0;
};

std::vector<SeedPair> seed_pairs(const Group& a, const Group& b) {
  std::vector<SeedPair> pairs;
  for (std::size_t i = 0; i < a.runs.size(); ++i) {
    const auto other = std::ranges::find(b.runs, a.runs[i].key.seed, [](const RunRecord& run) { return run.key.seed; });
    if (other != b.runs.end()) pairs.push_back({i, static_cast<std::size_t>(other - b.runs.begin())});
  }
  return pairs;
}

std::vector<double> values_of(const Group& group, std::size_t measure) {
  std::vector<double> values;
  for (const RunRecord& run : group.runs)
    if (run.values[measure]) values.push_back(*run.values[measure]);
  return values;
}

bool has_anomaly(const Group& group) {
  return std::ranges::any_of(group.runs, [](const RunRecord& run) { return run.state == RunRecord::State::kAnomaly; });
}

/// Compares two groups, and says what is to be known of that.
class Judge {
 public:
  Judge(const Group& a, const Group& b, double confidence, std::vector<std::string>& warnings)
      : a_(a), b_(b), pairs_(seed_pairs(a, b)), confidence_(confidence), warnings_(warnings) {
    check_arrivals();
  }

  /// None: one side does not have the measure.
  Expected<std::optional<Judgement>> judge(const std::string& path, std::size_t number) {
    const Measure measure = studies::measure_of(path);
    if (pairs_.size() == 1 && is_of_cars(path) && same_arrivals_) {
      auto by_car = judge_by_car(measure);
      if (!by_car || by_car.value()) return by_car;
    }
    if (!pairs_.empty()) return judge_by_seed(measure, number);
    return judge_apart(measure, number);
  }

 private:
  void warn(const std::string& text) {
    const std::string whole = a_.label.empty() ? text : a_.label + ": " + text;
    if (std::ranges::find(warnings_, whole) == warnings_.end()) warnings_.push_back(whole);
  }

  /// Equal seeds give equal draws, not equal arrivals if the flows or the time differ.
  void check_arrivals() {
    if (pairs_.empty()) {
      warn("no seed is in both: nothing is paired, the intervals are those of Welch's test");
      return;
    }
    std::size_t others = 0;
    for (const SeedPair& pair : pairs_)
      if (a_.runs[pair.a].arrived != b_.runs[pair.b].arrived) ++others;
    if (others > 0) {
      same_arrivals_ = false;
      warn("in " + std::to_string(others) + " of " + std::to_string(pairs_.size()) +
           " pairs the sides had different numbers of arrivals (flow or duration differ)");
    }
    const RunRecord& first_a = a_.runs[pairs_.front().a];
    const RunRecord& first_b = b_.runs[pairs_.front().b];
    if (first_a.warmup_s != first_b.warmup_s) {
      warn("the warm-ups differ: " + studies::fixed(first_a.warmup_s, 1) + " s in A, " +
           studies::fixed(first_b.warmup_s, 1) + " s in B");
    }
    const std::size_t unpaired = a_.runs.size() + b_.runs.size() - 2 * pairs_.size();
    if (unpaired > 0) warn(std::to_string(unpaired) + " runs have no partner with their seed and are left out");
  }

  Expected<std::optional<Judgement>> judge_by_car(const Measure& measure) {
    const std::size_t a = pairs_.front().a;
    const std::size_t b = pairs_.front().b;
    // A study keeps no cars unless it is told to.
    for (const auto& folder : {a_.folders[a], b_.folders[b]})
      if (!std::filesystem::exists(folder / "car.csv")) return std::optional<Judgement>();
    auto batches = batches_of(a_.folders[a], b_.folders[b], measure.path);
    if (!batches) return batches.error();
    Pairs& pairs = batches.value().pairs;
    if (pairs.arm.size() < kBatchesLeast) {
      warn("the run after its warm-up is too short for intervals: " + std::to_string(pairs.arm.size()) +
           " batches of " + studies::fixed(batches.value().length_s, 0) + " s, " + std::to_string(kBatchesLeast) +
           " would do");
      return std::optional<Judgement>();
    }
    pairs.anomalies = has_anomaly(a_) || has_anomaly(b_);
    warn("one pair of runs: intervals are of " + std::to_string(pairs.arm.size()) + " batches of " +
         studies::fixed(batches.value().length_s, 0) + " s of its " + std::to_string(batches.value().cars) +
         " cars that left in both; they say nothing of other seeds, `lukou sweep` does");
    if (!batches.value().independent()) {
      warn(measure.label + ": neighbouring batches go together (correlation " +
           studies::fixed(batches.value().lag_one, 2) + "), so its interval is too narrow");
    }
    return std::optional(Judgement{measure, Basis::kBatches, studies::compared(pairs, measure, confidence_)});
  }

  Expected<std::optional<Judgement>> judge_by_seed(const Measure& measure, std::size_t number) {
    const Pairs pairs = studies::pairs_of(a_.runs, b_.runs, number);
    if (pairs.arm.empty()) return std::optional<Judgement>();
    const Basis basis = pairs.arm.size() > 1 ? Basis::kSeeds : Basis::kNone;
    return std::optional(Judgement{measure, basis, studies::compared(pairs, measure, confidence_)});
  }

  Expected<std::optional<Judgement>> judge_apart(const Measure& measure, std::size_t number) {
    const std::vector<double> of_a = values_of(a_, number);
    const std::vector<double> of_b = values_of(b_, number);
    if (of_a.empty() || of_b.empty()) return std::optional<Judgement>();
    Judgement judgement{.measure = measure, .basis = Basis::kNone, .found = {}};
    studies::Comparison& found = judgement.found;
    found.of_arm = statistics::estimate(of_a, confidence_);
    found.of_baseline = statistics::estimate(of_b, confidence_);
    found.comparable = !has_anomaly(a_) && !has_anomaly(b_);
    if (of_a.size() < 2 || of_b.size() < 2) {
      found.paired.difference = {.n = 1, .mean = found.of_arm.mean - found.of_baseline.mean};
      return std::optional(judgement);
    }
    const auto welch = statistics::compare_unpaired(of_a, of_b, confidence_);
    judgement.basis = Basis::kApart;
    found.paired.difference = welch.difference;
    found.paired.p = found.p_holm = welch.p;
    found.significant = found.comparable && welch.p < 1.0 - confidence_;
    return std::optional(judgement);
  }

  const Group& a_;
  const Group& b_;
  std::vector<SeedPair> pairs_;
  double confidence_;
  std::vector<std::string>& warnings_;
  bool same_arrivals_ = true;
};

/// What must be known of a side as a whole.
void warn_of_side(const Side& side, std::vector<std::string>& warnings) {
  if (side.failed > 0) warnings.push_back(side.name + ": " + std::to_string(side.failed) + " runs have no result");
  double arrived = 0.0;
  double left = 0.0;
  for (const Group& group : side.groups) {
    if (has_anomaly(group)) {
      warnings.push_back(side.name + (group.label.empty() ? "" : ", " + group.label) +
                         ": an anomaly ended a run, so it is over another time than its partner");
    }
    for (const RunRecord& run : group.runs) {
      arrived += run.arrived;
      left += run.left;
    }
  }
  constexpr double kFew = 0.05;
  if (arrived > 0.0 && 1.0 - left / arrived > kFew) {
    warnings.push_back(side.name + ": " + studies::fixed(100.0 * (1.0 - left / arrived), 0) +
                       " % of the cars that arrived had not left at the end; mean_delay_all_s counts them");
  }
}

}  // namespace

std::string_view name(Basis basis) {
  switch (basis) {
    case Basis::kSeeds:
      return "pairs of seeds";
    case Basis::kBatches:
      return "batches of cars";
    case Basis::kApart:
      return "different seeds";
    case Basis::kNone:
      return "single runs";
  }
  return "";
}

bool Comparison::differs() const {
  return std::ranges::any_of(groups, [](const GroupJudgement& group) {
    return std::ranges::any_of(group.measures, [](const Judgement& judgement) { return judgement.found.significant; });
  });
}

Expected<Comparison> compare(const Side& a, const Side& b, const std::vector<std::string>& measures,
                             double confidence) {
  Comparison comparison;
  warn_of_side(a, comparison.warnings);
  warn_of_side(b, comparison.warnings);
  const bool one_each = a.groups.size() == 1 && b.groups.size() == 1;
  for (const Group& group : a.groups) {
    const auto other =
        one_each ? b.groups.begin() : std::ranges::find(b.groups, group.label, [](const Group& g) { return g.label; });
    if (other == b.groups.end()) continue;
    Judge judge(group, *other, confidence, comparison.warnings);
    GroupJudgement judged{.label = group.label, .measures = {}};
    for (std::size_t number = 0; number < measures.size(); ++number) {
      auto judgement = judge.judge(measures[number], number);
      if (!judgement) return judgement.error();
      if (judgement.value()) judged.measures.push_back(*std::move(judgement).value());
    }
    comparison.groups.push_back(std::move(judged));
  }
  if (comparison.groups.empty()) {
    return Error{a.name + " and " + b.name, "have no cell in common: A has `" + a.groups.front().label + "`, B has `" +
                                                b.groups.front().label + "`"};
  }
  return comparison;
}

}  // namespace lukou::compare
