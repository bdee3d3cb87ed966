// Whatever RSUs ask for: what leaves the controller keeps the rules.

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "common/intersection/conflicts.hpp"
#include "services/signal_controller/signal_controller_node.hpp"

namespace lukou {
namespace {

constexpr Step kSteps = 2500;
constexpr std::uint32_t kRsus = 3;

Actuation any_rules() {
  Actuation rules;
  rules.min_green = *rc::gen::inRange<Step>(1, 40);
  rules.yellow = *rc::gen::inRange<Step>(1, 20);
  rules.all_red = *rc::gen::inRange<Step>(0, 15);
  rules.max_wait = rules.min_green + rules.yellow + rules.all_red + *rc::gen::inRange<Step>(0, 200);
  return rules;
}

/// A plan that ships, run up to ten times as fast: every duration in it is a multiple of a second.
SignalPlan any_plan() {
  SignalPlan plan = *rc::gen::element(paper_plan(), paper_yellow_plan(), protected_left_plan());
  const Step faster = *rc::gen::element<Step>(1, 2, 5, 10);
  plan.cycle /= faster;
  plan.offset = *rc::gen::inRange<Step>(0, plan.cycle);
  for (auto& lane : plan.lanes) {
    for (TimedAspect& timed : lane) timed.duration /= faster;
  }
  return plan;
}

/// How an RSU of the test asks.
struct Asker {
  int one_in = 1;        ///< asks in one of so many steps
  bool sensible = true;  ///< leaves out lanes that cross earlier ones
  Step longest = 1;      ///< lifetime
};

Asker any_asker() {
  return {*rc::gen::element(1, 1, 7, 60, 100'000), *rc::gen::arbitrary<bool>(), *rc::gen::element<Step>(1, 5, 80, 900)};
}

/// Draws of a run; rapidcheck seeds it, so a failure shrinks to a seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed) {}
  std::uint64_t below(std::uint64_t limit) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return (state_ >> 33U) % limit;
  }

 private:
  std::uint64_t state_;
};

RequestBatch any_request(const Asker& asker, Draws& draws, std::uint32_t rsu, Step step) {
  RequestBatch batch{.rsu = rsu, .step = step, .lanes = {}, .lifetime = {}};
  if (draws.below(static_cast<std::uint64_t>(asker.one_in)) != 0) return batch;
  auto bits = static_cast<std::uint16_t>(draws.below(1U << 13U));
  if (asker.sensible) {
    LaneSet kept;
    const auto first = static_cast<int>(draws.below(kLanes));
    for (int i = 0; i < kLanes; ++i) {
      const auto lane = static_cast<Lane>((first + i) % kLanes);
      if (LaneSet::from_bits(bits).contains(lane) && !hard_conflicts(kept).contains(lane)) kept.insert(lane);
    }
    bits = kept.bits();
  }
  batch.lanes.push_back(bits);
  batch.lifetime.push_back(static_cast<Step>(draws.below(static_cast<std::uint64_t>(asker.longest) + 2)) - 1);
  return batch;
}

/// The heads of all steps that a controller decided.
std::vector<Heads> decided(const SignalPlan& plan, Step promise, const Actuation& rules,
                           const std::array<Asker, kRsus>& askers, std::uint64_t seed) {
  SignalControllerNode node(plan, promise, rules);
  Draws draws(seed);
  std::vector<Heads> heads;
  SignalBatch batch;
  for (Step k = 0; k < kSteps; ++k) {
    for (std::uint32_t rsu = 0; k > 0 && rsu < kRsus; ++rsu) {
      node.hear(k, any_request(askers[rsu], draws, rsu, k - 1));
    }
    if (!node.step(k, batch)) continue;
    RC_ASSERT(batch.first == static_cast<Step>(heads.size()));
    for (std::size_t row = 0; row * kLanes < batch.heads.size(); ++row) {
      Heads shown{};
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        shown[lane] = static_cast<Aspect>(batch.heads[row * kLanes + lane]);
      }
      heads.push_back(shown);
    }
  }
  return heads;
}

/// A stretch of one aspect of one lane.
struct Stretch {
  Aspect aspect;
  Step from;
  Step to;  ///< not included; the last one is cut off by the end
};

std::vector<Stretch> stretches(const std::vector<Heads>& heads, std::size_t lane) {
  std::vector<Stretch> found;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    const Step step = static_cast<Step>(i);
    if (found.empty() || found.back().aspect != heads[i][lane]) found.push_back({heads[i][lane], step, step});
    found.back().to = step + 1;
  }
  return found;
}

void check_lane(const std::vector<Heads>& heads, std::size_t lane, const Actuation& rules) {
  const auto found = stretches(heads, lane);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Stretch& now = found[i];
    const Step lasted = now.to - now.from;
    const std::optional<Aspect> next = i + 1 < found.size() ? std::optional(found[i + 1].aspect) : std::nullopt;
    switch (now.aspect) {
      case Aspect::kGreen:
        if (next) RC_ASSERT(lasted >= rules.min_green);
        if (next) RC_ASSERT(*next == Aspect::kYellow);
        for (const Lane other : kAllLanes) {
          if (conflict(static_cast<Lane>(lane), other) != Conflict::kHard) continue;
          for (Step at = std::max<Step>(0, now.from - rules.all_red); at < now.from; ++at) {
            RC_ASSERT(heads[static_cast<std::size_t>(at)][index(other)] == Aspect::kRed);
          }
        }
        break;
      case Aspect::kYellow:
        if (next) RC_ASSERT(lasted == rules.yellow);
        if (next) RC_ASSERT(*next == Aspect::kRed);
        break;
      case Aspect::kRed:
        if (next) RC_ASSERT(*next == Aspect::kGreen);
        RC_ASSERT(lasted <= longest_red(rules));
        break;
    }
  }
}

RC_GTEST_PROP(ActuatedController, KeepsTheRulesWhateverIsAskedOfIt, ()) {
  const Actuation rules = any_rules();
  const SignalPlan plan = any_plan();
  const Step promise = *rc::gen::inRange<Step>(2, 30);
  const std::array<Asker, kRsus> askers = {any_asker(), any_asker(), any_asker()};
  const auto heads = decided(plan, promise, rules, askers, *rc::gen::arbitrary<std::uint64_t>());
  RC_ASSERT(static_cast<Step>(heads.size()) > kSteps - promise);
  for (const Heads& shown : heads) {
    for (const Lane a : kAllLanes) {
      for (const Lane b : kAllLanes) {
        if (conflict(a, b) != Conflict::kHard) continue;
        RC_ASSERT(shown[index(a)] == Aspect::kRed || shown[index(b)] == Aspect::kRed);
      }
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane) check_lane(heads, lane, rules);
}

}  // namespace
}  // namespace lukou
