#include "common/measures/uplink_watch.hpp"

#include <algorithm>

namespace lukou {
namespace {

bool ideal(const TrafficBatch& batch) { return batch.reception.size() == 0; }

}  // namespace

void UplinkWatch::add(const TrafficBatch& batch) {
  const Step sent = batch.step - 1;
  const bool heard_by_any = std::ranges::any_of(batch.heard_epoch, [](auto epoch) { return epoch != 0; });
  if (ideal(batch) && heard_by_any) all_heard_ = sent;
  for (std::size_t row = 0; row < batch.uplink_vehicle.size(); ++row) {
    const std::uint32_t vehicle = batch.uplink_vehicle[row];
    Record& car = cars_[vehicle];
    const std::uint8_t fate = batch.uplink.fate[row];
    if (car.told != sent || car.uplink.newest != kFrameHeard) car.uplink.newest = fate;
    car.told = sent;
    if (fate == kFrameHeard) due_[batch.uplink.due[row]].push_back({vehicle, sent});
  }
  // An RSU hears a message in its step; the engine tells of that step in its next one.
  while (!due_.empty() && due_.begin()->first <= sent) {
    for (const UnderWay& message : due_.begin()->second) take(message.vehicle, message.sent);
    due_.erase(due_.begin());
  }
  for (const std::uint32_t vehicle : batch.left_vehicle) cars_.erase(vehicle);
}

void UplinkWatch::take(std::uint32_t vehicle, Step sent) {
  const auto car = cars_.find(vehicle);
  if (car == cars_.end()) return;  // it has left
  car->second.uplink.heard_step = std::max(car->second.uplink.heard_step, sent);
}

CarUplink UplinkWatch::now(const TrafficBatch& newest, std::size_t car) const {
  const std::uint32_t vehicle = newest.vehicle[car];
  const auto found = cars_.find(vehicle);
  const CarUplink told = found == cars_.end() ? CarUplink{} : found->second.uplink;
  if (!ideal(newest)) return told;
  const bool just_entered = std::ranges::find(newest.entered_vehicle, vehicle) != newest.entered_vehicle.end();
  if (newest.equipped[car] == 0 || just_entered || all_heard_ < 0) return told;
  return {.newest = kFrameHeard, .heard_step = std::max(told.heard_step, all_heard_)};
}

}  // namespace lukou
