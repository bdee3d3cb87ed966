#include "services/traffic_engine/model/on_board_unit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou::traffic {
namespace {

/// The largest command of a word without its sign; no number for a speed, which has none yet.
double largest_mps2(double command_mps2, const std::vector<LaterCommand>& later) {
  double largest = std::abs(command_mps2);
  for (const LaterCommand& command : later) largest = std::max(largest, std::abs(command.acceleration_mps2));
  return largest;
}

}  // namespace

OutcomeEvent outcome_of(const Advice& advice, AdviceOutcome outcome, std::uint32_t vehicle) {
  return {vehicle,     advice.rsu,      advice.sequence, outcome, false, advice.issued, advice.acceleration_mps2,
          advice.kind, advice.speed_mps};
}

OutcomeEvent OnBoardUnit::event(const Word& word, AdviceOutcome outcome, std::uint32_t vehicle) {
  return {vehicle,           word.order.rsu,    word.order.sequence, outcome,       false,
          word.order.issued, word.command_mps2, word.kind,           word.speed_mps};
}

void OnBoardUnit::take(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  if (advice.kind == AdviceKind::kLaneSpeed) return take_lane_speed(advice, step, vehicle, outcomes);
  const WordOrder order = order_of(advice);
  const auto refuse = [&](AdviceOutcome reason) {
    if (!advice.release) outcomes.push_back(outcome_of(advice, reason, vehicle));
  };
  hear(advice.rsu, step - 1);
  if (!advice.release && step > advice.issued + advice.lifetime) return refuse(AdviceOutcome::kLate);
  if (order < newest_) {
    return refuse(advice.issued < newest_.issued ? AdviceOutcome::kStale : AdviceOutcome::kSuperseded);
  }
  const bool unused = in_force() && acting_.use == Use::kUnused;
  if (unused) outcomes.push_back(event(acting_, AdviceOutcome::kSuperseded, vehicle));
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
  Word word{.order = order,
            .command_mps2 = advice.acceleration_mps2,
            .acted_mps2 = advice.acceleration_mps2,
            .heard = step - 1,
            .binding = advice.binding,
            .kind = advice.kind,
            .speed_mps = advice.speed_mps,
            .later = advice.later};
  switch (driver_.kind) {
    case AdvisedDriver::Kind::kAutomated:
      acting_ = std::move(word);
      state_ = Guidance::kInForce;
      ended_ = kLongAgo;
      break;
    case AdvisedDriver::Kind::kHuman:
      waiting_.push_back(std::move(word));
      if (state_ != Guidance::kInForce && state_ != Guidance::kNotComplied) state_ = Guidance::kReacting;
      break;
    case AdvisedDriver::Kind::kIgnoring:
      refuse(AdviceOutcome::kNotComplied);
      state_ = Guidance::kNotComplied;
      break;
  }
}

void OnBoardUnit::take_lane_speed(const Advice& advice, Step step, std::uint32_t vehicle,
                                  std::vector<OutcomeEvent>& outcomes) {
  const WordOrder order = order_of(advice);
  const auto refuse = [&](AdviceOutcome reason) { outcomes.push_back(outcome_of(advice, reason, vehicle)); };
  hear(advice.rsu, step - 1);
  if (step > advice.issued + advice.lifetime) return refuse(AdviceOutcome::kLate);
  if (order < lane_word_.order) {
    return refuse(advice.issued < lane_word_.order.issued ? AdviceOutcome::kStale : AdviceOutcome::kSuperseded);
  }
  if (driver_.kind == AdvisedDriver::Kind::kIgnoring) return refuse(AdviceOutcome::kNotComplied);
  end_lane_word(AdviceOutcome::kSuperseded, vehicle, outcomes);
  lane_word_ = {.order = order,
                .speed_mps = advice.speed_mps,
                .until = advice.issued + advice.lifetime,
                .heard = step - 1,
                .lives = true};
}

OutcomeEvent OnBoardUnit::lane_event(AdviceOutcome outcome, std::uint32_t vehicle) const {
  const WordOrder& order = lane_word_.order;
  return {vehicle,
          order.rsu,
          order.sequence,
          outcome,
          false,
          order.issued,
          kNoSpeed,
          AdviceKind::kLaneSpeed,
          lane_word_.speed_mps};
}

void OnBoardUnit::end_lane_word(AdviceOutcome reason, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  if (lane_word_.lives && !lane_word_.used) outcomes.push_back(lane_event(reason, vehicle));
  lane_word_.lives = false;
}

void OnBoardUnit::look_at_lane(Step step, const UnitRules& rules, std::uint32_t vehicle,
                               std::vector<OutcomeEvent>& outcomes) {
  const std::uint32_t rsu = lane_word_.order.rsu;
  if (rsu < rules.everybody.size()) lane_word_.heard = std::max(lane_word_.heard, rules.everybody[rsu]);
  if (step > lane_word_.until || step - 1 - lane_word_.heard >= rules.rsu_lost_after) {
    end_lane_word(AdviceOutcome::kExpired, vehicle, outcomes);
  }
}

void OnBoardUnit::kept_to_lane_speed(std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  LUKOU_EXPECT(lane_word_.lives);
  if (!lane_word_.used) outcomes.push_back(lane_event(AdviceOutcome::kApplied, vehicle));
  lane_word_.used = true;
}

void OnBoardUnit::work_out(Step step, double speed_mps, const UnitRules& rules) {
  if (acting_.kind == AdviceKind::kSpeed) {
    acting_.command_mps2 = std::clamp((acting_.speed_mps - speed_mps) / rules.speed_gain_time_s,
                                      -rules.speed_deceleration_mps2, rules.speed_acceleration_mps2);
  }
  for (const LaterCommand& later : acting_.later) {
    if (later.after <= step - 1 - acting_.order.issued) acting_.command_mps2 = later.acceleration_mps2;
  }
  const bool human = driver_.kind == AdvisedDriver::Kind::kHuman;
  acting_.acted_mps2 = human ? driver_.gain * acting_.command_mps2 : acting_.command_mps2;
}

void OnBoardUnit::hear(std::uint32_t rsu, Step heard) {
  if (rsu == newest_.rsu) heard_ = std::max(heard_, heard);
  if (rsu == lane_word_.order.rsu) lane_word_.heard = std::max(lane_word_.heard, heard);
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
    outcomes.push_back(event(*skipped, AdviceOutcome::kSuperseded, vehicle));
  }
  ended_ = kLongAgo;
  acting_ = *chosen;
  acting_.acted_mps2 = driver_.gain * acting_.command_mps2;
  const bool exact =
      acting_.kind == AdviceKind::kAcceleration ? acting_.acted_mps2 == acting_.command_mps2 : driver_.gain == 1.0;
  acting_.bent = step - 1 > acting_.heard || !exact;
  state_ = Guidance::kInForce;
  if (largest_mps2(acting_.command_mps2, acting_.later) < rules.threshold_mps2) {
    outcomes.push_back(event(acting_, AdviceOutcome::kNotComplied, vehicle));
    state_ = Guidance::kNotComplied;
  }
  waiting_.erase(waiting_.begin(), ready);
}

void OnBoardUnit::drop_waiting(AdviceOutcome reason, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  for (const Word& word : waiting_) outcomes.push_back(event(word, reason, vehicle));
  waiting_.clear();
}

void OnBoardUnit::forget(std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  drop_waiting(AdviceOutcome::kPastStopLine, vehicle, outcomes);
  end_lane_word(AdviceOutcome::kPastStopLine, vehicle, outcomes);
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
    outcomes.push_back(event(acting_, outcome, vehicle));
    outcomes.back().again = !first;
  }
  if (first || changed) acting_.use = changed ? Use::kChanged : Use::kApplied;
}

}  // namespace lukou::traffic
