#pragma once

#include <vector>

#include "common/measures/run_measures.hpp"

namespace lukou::test {

inline constexpr std::uint8_t kWestCenter = 1;

/// Writes batches by hand, car by car.
class Script {
 public:
  explicit Script(double warmup_s = 0.0) : measures_(parameters(warmup_s)) {}

  /// A car arrives, and waits until enter_waiting(). Vehicle 4 n + a comes from approach a.
  void arrive(std::uint32_t vehicle, bool equipped = false) {
    const std::uint32_t approach = vehicle % kApproaches;
    ++arrived_[approach];
    if (equipped) ++arrived_equipped_[approach];
  }
  /// A car arrives and comes onto the road at once.
  void enter(std::uint32_t vehicle, bool equipped = false, double speed_mps = 15.0) {
    arrive(vehicle, equipped);
    enter_waiting(vehicle, equipped, speed_mps);
  }
  void enter_waiting(std::uint32_t vehicle, bool equipped = false, double speed_mps = 15.0) {
    batch_.entered_vehicle.push_back(vehicle);
    batch_.entered_lane.push_back(kWestCenter);
    batch_.entered_equipped.push_back(equipped ? 1 : 0);
    batch_.entered_speed_mps.push_back(speed_mps);
    batch_.entered_desired_speed_mps.push_back(15.0);
  }
  void drive(std::uint32_t vehicle, double position_m, double speed_mps, CarState state = CarState::kIn,
             double acceleration_mps2 = 0.0) {
    batch_.vehicle.push_back(vehicle);
    batch_.lane.push_back(kWestCenter);
    batch_.state.push_back(static_cast<std::uint8_t>(state));
    batch_.position_m.push_back(position_m);
    batch_.speed_mps.push_back(speed_mps);
    batch_.acceleration_mps2.push_back(acceleration_mps2);
    batch_.guidance.push_back(static_cast<std::uint8_t>(GuidanceState::kNotEquipped));
    batch_.bound_by.push_back(static_cast<std::uint8_t>(BoundBy::kLight));
    batch_.missed.push_back(kNothingMissed);
  }
  /// A car with a unit.
  void drive_guided(std::uint32_t vehicle, double position_m, double speed_mps, GuidanceState guidance,
                    BoundBy bound_by = BoundBy::kLight, std::uint8_t missed = kNothingMissed) {
    drive(vehicle, position_m, speed_mps);
    batch_.guidance.back() = static_cast<std::uint8_t>(guidance);
    batch_.bound_by.back() = static_cast<std::uint8_t>(bound_by);
    batch_.missed.back() = missed;
  }
  void cross(std::uint32_t vehicle, double at_s, Aspect aspect = Aspect::kGreen) {
    batch_.crossed_vehicle.push_back(vehicle);
    batch_.crossed_time_s.push_back(at_s);
    batch_.crossed_aspect.push_back(static_cast<std::uint8_t>(aspect));
    batch_.crossed_committed.push_back(0);
  }
  void leave(std::uint32_t vehicle, double at_s) {
    batch_.left_vehicle.push_back(vehicle);
    batch_.left_time_s.push_back(at_s);
  }
  void fate(AdviceFate fate, bool again = false, std::uint32_t vehicle = 0, Step issued = 0) {
    batch_.fate_vehicle.push_back(vehicle);
    batch_.fate_issued.push_back(issued);
    batch_.fate.push_back(static_cast<std::uint8_t>(fate));
    batch_.fate_again.push_back(again ? 1 : 0);
    batch_.fate_kind.push_back(static_cast<std::uint8_t>(AdviceKind::kAcceleration));
  }
  /// What is told of approach 0, where cars wait.
  void counts(std::uint32_t arrived, std::uint32_t arrived_equipped, std::uint32_t waiting) {
    arrived_[0] = arrived;
    arrived_equipped_[0] = arrived_equipped;
    waiting_[0] = waiting;
  }
  /// Hands the step in.
  void next() {
    batch_.step = step_++;
    batch_.arrived = arrived_;
    batch_.arrived_equipped = arrived_equipped_;
    batch_.waiting = waiting_;
    batch_.waiting_equipped.assign(kApproaches, 0);
    measures_.add(batch_);
    for (const FinishedCar& car : measures_.finished()) finished_.push_back(car);
    for (const FinishedStop& stop : measures_.finished_stops()) stops_.push_back(stop);
    batch_.clear();
  }
  [[nodiscard]] const RunMeasures& measures() const { return measures_; }
  [[nodiscard]] const std::vector<FinishedCar>& finished() const { return finished_; }
  [[nodiscard]] const std::vector<FinishedStop>& stops() const { return stops_; }
  [[nodiscard]] Step step() const { return step_; }

 private:
  static MeasureParameters parameters(double warmup_s) {
    MeasureParameters measure;
    measure.warmup_s = warmup_s;
    return measure;
  }
  RunMeasures measures_;
  TrafficBatch batch_;
  std::vector<std::uint32_t> arrived_ = std::vector<std::uint32_t>(kApproaches, 0);
  std::vector<std::uint32_t> arrived_equipped_ = arrived_;
  std::vector<std::uint32_t> waiting_ = arrived_;
  std::vector<FinishedCar> finished_;
  std::vector<FinishedStop> stops_;
  Step step_ = 0;
};

}  // namespace lukou::test
