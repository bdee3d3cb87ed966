#include "services/traffic_engine/model/on_board_unit.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"

namespace lukou::traffic {

void OnBoardUnit::take(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  const WordOrder order = order_of(advice);
  const auto refuse = [&](AdviceOutcome reason) {
    if (advice.release) return;
    outcomes.push_back({vehicle, advice.rsu, advice.sequence, reason, false, advice.issued, advice.acceleration_mps2});
  };
  hear(advice.rsu, step - 1);
  if (!advice.release && step > advice.issued + advice.lifetime) return refuse(AdviceOutcome::kLate);
  if (order < newest_) {
    return refuse(advice.issued < newest_.issued ? AdviceOutcome::kStale : AdviceOutcome::kSuperseded);
  }
  const bool unused = in_force() && acting_.use == Use::kUnused;
  if (unused) {
    outcomes.push_back({vehicle, acting_.order.rsu, acting_.order.sequence, AdviceOutcome::kSuperseded, false,
                        acting_.order.issued, acting_.command_mps2});
  }
  newest_ = order;
  heard_ = step - 1;
  shown_ = !advice.release;
  if (advice.release) {
    drop_waiting(AdviceOutcome::kSuperseded, vehicle, outcomes);
    state_ = Guidance::kReleased;
    ended_ = kLongAgo;
    return;
  }
  shown_until_ = advice.issued + advice.lifetime;
  const Word word{.order = order,
                  .command_mps2 = advice.acceleration_mps2,
                  .acted_mps2 = advice.acceleration_mps2,
                  .heard = step - 1,
                  .binding = advice.binding};
  switch (driver_.kind) {
    case AdvisedDriver::Kind::kAutomated:
      acting_ = word;
      state_ = Guidance::kInForce;
      ended_ = kLongAgo;
      break;
    case AdvisedDriver::Kind::kHuman:
      waiting_.push_back(word);
      if (state_ != Guidance::kInForce && state_ != Guidance::kNotComplied) state_ = Guidance::kReacting;
      break;
    case AdvisedDriver::Kind::kIgnoring:
      refuse(AdviceOutcome::kNotComplied);
      state_ = Guidance::kNotComplied;
      break;
  }
}

void OnBoardUnit::hear(std::uint32_t rsu, Step heard) {
  if (rsu == newest_.rsu) heard_ = std::max(heard_, heard);
}

void OnBoardUnit::look(Step step, const UnitRules& rules, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  if (newest_.rsu < rules.everybody.size()) heard_ = std::max(heard_, rules.everybody[newest_.rsu]);
  const bool life_ended = step > shown_until_;
  if (life_ended || step - 1 - heard_ >= rules.rsu_lost_after) {
    drop_waiting(AdviceOutcome::kExpired, vehicle, outcomes);
    if (in_force()) ended_ = step;
    state_ = life_ended ? Guidance::kExpired : Guidance::kRsuUnheard;
    shown_ = false;
  } else if (!waiting_.empty()) {
    react(step, rules, vehicle, outcomes);
  }
}

void OnBoardUnit::react(Step step, const UnitRules& rules, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  const auto ready = std::ranges::find_if(
      waiting_, [&](const Word& word) { return step - 1 - word.heard < rules.reaction; });  // the first that is not
  if (ready == waiting_.begin()) return;
  const auto chosen = ready - 1;
  for (auto skipped = waiting_.begin(); skipped != chosen; ++skipped) {
    outcomes.push_back({vehicle, skipped->order.rsu, skipped->order.sequence, AdviceOutcome::kSuperseded, false,
                        skipped->order.issued, skipped->command_mps2});
  }
  ended_ = kLongAgo;
  acting_ = *chosen;
  acting_.acted_mps2 = driver_.gain * acting_.command_mps2;
  acting_.bent = step - 1 > acting_.heard || acting_.acted_mps2 != acting_.command_mps2;
  state_ = Guidance::kInForce;
  if (std::abs(acting_.command_mps2) < rules.threshold_mps2) {
    outcomes.push_back({vehicle, acting_.order.rsu, acting_.order.sequence, AdviceOutcome::kNotComplied, false,
                        acting_.order.issued, acting_.command_mps2});
    state_ = Guidance::kNotComplied;
  }
  waiting_.erase(waiting_.begin(), ready);
}

void OnBoardUnit::drop_waiting(AdviceOutcome reason, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  for (const Word& word : waiting_) {
    outcomes.push_back(
        {vehicle, word.order.rsu, word.order.sequence, reason, false, word.order.issued, word.command_mps2});
  }
  waiting_.clear();
}

void OnBoardUnit::forget(std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  drop_waiting(AdviceOutcome::kPastStopLine, vehicle, outcomes);
  state_ = Guidance::kPastStopLine;
  ended_ = kLongAgo;
  shown_ = false;
}

void OnBoardUnit::used(AdviceOutcome outcome, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  LUKOU_EXPECT(in_force());
  if (acting_.bent) outcome = AdviceOutcome::kChangedDriver;
  const bool first = acting_.use == Use::kUnused;
  const bool changed = outcome != AdviceOutcome::kApplied;
  if (first || (acting_.use == Use::kApplied && changed)) {
    outcomes.push_back({vehicle, acting_.order.rsu, acting_.order.sequence, outcome, !first, acting_.order.issued,
                        acting_.command_mps2});
  }
  if (first || changed) acting_.use = changed ? Use::kChanged : Use::kApplied;
}

}  // namespace lukou::traffic
