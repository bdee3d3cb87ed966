#include "services/traffic_engine/model/on_board_unit.hpp"

#include <tuple>

#include "common/core/contract.hpp"

namespace lukou::traffic {

void OnBoardUnit::take(const Advice& advice, Step step, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  const auto refuse = [&](AdviceOutcome reason) {
    if (!advice.release) outcomes.push_back({vehicle, advice.rsu, advice.sequence, reason, false});
  };
  const bool newest = std::tuple(advice.issued, advice.rsu, advice.sequence) >= std::tuple(issued_, rsu_, sequence_);
  if (!newest) {
    if (step > advice.issued + advice.lifetime) return refuse(AdviceOutcome::kExpired);
    return refuse(advice.issued < issued_ ? AdviceOutcome::kStale : AdviceOutcome::kSuperseded);
  }
  if (!advice.release && step > advice.issued + advice.lifetime) return refuse(AdviceOutcome::kExpired);
  if (holds_ && use_ == Use::kUnused) outcomes.push_back({vehicle, rsu_, sequence_, AdviceOutcome::kSuperseded, false});
  holds_ = !advice.release;
  command_mps2_ = advice.acceleration_mps2;
  issued_ = advice.issued;
  last_step_ = advice.issued + advice.lifetime;
  rsu_ = advice.rsu;
  sequence_ = advice.sequence;
  binding_ = advice.binding;
  use_ = Use::kUnused;
}

void OnBoardUnit::used(AdviceOutcome outcome, std::uint32_t vehicle, std::vector<OutcomeEvent>& outcomes) {
  LUKOU_EXPECT(holds_);
  const bool first = use_ == Use::kUnused;
  const bool changed = outcome != AdviceOutcome::kApplied;
  if (first || (use_ == Use::kApplied && changed)) outcomes.push_back({vehicle, rsu_, sequence_, outcome, !first});
  if (first || changed) use_ = changed ? Use::kChanged : Use::kApplied;
}

}  // namespace lukou::traffic
