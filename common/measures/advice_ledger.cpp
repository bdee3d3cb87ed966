#include "common/measures/advice_ledger.hpp"

#include <cmath>

#include "common/core/contract.hpp"
#include "common/measures/stop_cause.hpp"

namespace lukou {
namespace {

bool is_use(AdviceFate fate) { return fate <= AdviceFate::kChangedRed || fate == AdviceFate::kChangedDriver; }

}  // namespace

void AdviceLedger::add(const TrafficBatch& batch) {
  LUKOU_EXPECT(batch.step == step_ + 1);
  step_ = batch.step;
  settled_.clear();
  for (std::size_t row = 0; row < batch.fate.size(); ++row) add_fate(batch, row);
  for (std::size_t car = 0; car < batch.vehicle.size(); ++car) {
    const auto used = used_.find(batch.vehicle[car]);
    if (used == used_.end()) continue;
    if (!std::isnan(batch.commanded_mps2[car])) used->second.last_used = step_;
    if (batch.guidance[car] != static_cast<std::uint8_t>(GuidanceState::kInForce)) settle(used, step_);
  }
  for (std::size_t i = 0; i < batch.entered_vehicle.size(); ++i) {
    lanes_[batch.entered_vehicle[i]] = static_cast<Lane>(batch.entered_lane[i]);
  }
  for (const std::uint32_t left : batch.left_vehicle) {
    if (const auto used = used_.find(left); used != used_.end()) settle(used, step_);
    lanes_.erase(left);
  }
}

void AdviceLedger::add_fate(const TrafficBatch& batch, std::size_t row) {
  const auto fate = static_cast<AdviceFate>(batch.fate[row]);
  if (fate == AdviceFate::kDuplicate) return;  // no advice of its own
  const auto kind = static_cast<AdviceKind>(batch.fate_kind[row]);
  const std::uint32_t vehicle = batch.fate_vehicle[row];
  if (batch.fate_again[row] != 0) {
    const auto used = used_.find(vehicle);
    LUKOU_EXPECT(used != used_.end() && used->second.sequence == batch.fate_sequence[row]);
    used->second.fate = name(fate);
    return;
  }
  SettledAdvice advice{.settled = step_,
                       .issued = {},
                       .rsu = batch.fate_rsu[row],
                       .sequence = batch.fate_sequence[row],
                       .vehicle = {},
                       .lane = {},
                       .commanded_mps2 = batch.fate_commanded_mps2[row],
                       .fate = name(fate),
                       .first_used = {},
                       .last_used = {},
                       .kind = name(kind)};
  if (batch.fate_issued[row] >= 0) advice.issued = batch.fate_issued[row];
  if (const auto lane = lanes_.find(vehicle); lane != lanes_.end()) {
    advice.vehicle = vehicle;
    advice.lane = lane->second;
  }
  if (!std::isnan(batch.fate_speed_mps[row])) advice.speed_mps = batch.fate_speed_mps[row];
  if (kind == AdviceKind::kLaneSpeed && is_use(fate)) advice.first_used = step_;
  if (kind == AdviceKind::kLaneSpeed || !is_use(fate)) {
    settled_.push_back(advice);
    return;
  }
  if (const auto before = used_.find(vehicle); before != used_.end()) settle(before, step_);
  advice.first_used = advice.last_used = step_;
  used_.emplace(vehicle, advice);
}

void AdviceLedger::settle(std::map<std::uint32_t, SettledAdvice>::iterator used, Step step) {
  used->second.settled = step;
  settled_.push_back(used->second);
  used_.erase(used);
}

std::vector<SettledAdvice> AdviceLedger::close() const {
  std::vector<SettledAdvice> rest;
  for (const auto& [vehicle, advice] : used_) {
    rest.push_back(advice);
    rest.back().settled = step_;
  }
  return rest;
}

}  // namespace lukou
