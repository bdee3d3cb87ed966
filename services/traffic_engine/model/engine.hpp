#pragma once

#include <array>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "services/traffic_engine/model/demand.hpp"
#include "services/traffic_engine/model/entrance.hpp"
#include "services/traffic_engine/model/lane_traffic.hpp"

namespace lukou::traffic {

struct Entry {
  std::uint32_t vehicle = 0;
  Lane lane{};
  bool equipped = false;
  double speed_mps = 0.0;
  double desired_speed_mps = 0.0;
};

/// Number of the vehicle that is the n-th, from 0, to arrive on an approach.
constexpr std::uint32_t vehicle_number(Approach approach, std::uint32_t n) {
  return n * static_cast<std::uint32_t>(kApproaches) + static_cast<std::uint32_t>(approach);
}

/// The traffic of the whole intersection: twelve lanes and the cars that wait outside.
class Engine {
 public:
  /// Requires parameters in their ranges (idl/scenario.proto).
  explicit Engine(const EngineParameters& parameters);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Moves every car from t_(step-1) to t_step under the heads valid at t_(step-1) and the advice heard, then admits
  /// the cars that arrived by t_step. Step 0 leaves the empty road. Requires the steps 0, 1, 2, ... in order; `heads`
  /// is not read in step 0.
  void step(Step step, const Heads& heads, std::span<const Advice> advice);

  /// A frame of an RSU, other than advice, reached the units at the instant of `heard`, before the next step: every
  /// unit on the road, or one.
  void hear_rsu(std::uint32_t rsu, Step heard);
  void hear_rsu(std::uint64_t temporary_id, std::uint32_t rsu, Step heard);
  /// An advice will not reach its car; `fate` as on the bus. A speed for the lane is nothing that a car misses.
  void miss(const Advice& advice, std::uint8_t fate);

  /// From the next step on. Other draws stay as they are.
  void change_flow(Approach approach, double flow_veh_per_h);
  void change_equipped_ratio(double ratio);
  /// The shares hold for cars that come onto the road from then on, the rest for all.
  void change_units(const UnitParameters& unit, const ComplianceParameters& compliance);

  [[nodiscard]] const LaneTraffic& lane(Lane lane) const { return lanes_[index(lane)]; }
  /// What happened on the lanes in the last step.
  [[nodiscard]] const LaneEvents& events() const { return events_; }
  /// Cars that came onto the road at the end of the last step.
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] std::uint32_t arrived(Approach approach) const { return entrances_[index(approach)].demand.taken(); }
  [[nodiscard]] std::uint32_t waiting(Approach approach) const {
    return static_cast<std::uint32_t>(entrances_[index(approach)].waiting.size());
  }
  /// Of these, cars with an on-board unit: the ratio in force at a car's arrival decides.
  [[nodiscard]] std::uint32_t arrived_equipped(Approach approach) const {
    return entrances_[index(approach)].arrived_equipped;
  }
  [[nodiscard]] std::uint32_t waiting_equipped(Approach approach) const {
    return entrances_[index(approach)].waiting_equipped;
  }
  /// True if some car has waited outside longer than overflow_wait_s.
  [[nodiscard]] bool overflows() const { return overflows_; }
  [[nodiscard]] const EngineParameters& parameters() const { return parameters_; }
  /// The car on the road that has this temporary id and an on-board unit; valid until the next step.
  struct EquippedCar {
    Lane lane{};
    const Car* car = nullptr;
  };
  [[nodiscard]] std::optional<EquippedCar> equipped_car(std::uint64_t temporary_id) const;

 private:
  struct Waiting {
    double since_s = 0.0;
    std::uint32_t vehicle = 0;
    bool equipped = false;
  };
  struct Entrance {
    Demand demand;
    std::deque<Waiting> waiting;  ///< cars outside, first come first
    std::uint32_t arrived_equipped = 0;
    std::uint32_t waiting_equipped = 0;
  };
  struct Station {
    std::uint64_t temporary_id = 0;
    std::uint32_t vehicle = 0;
    Lane lane{};
  };

  void hear(const Advice& advice, Step step);
  [[nodiscard]] Car* car_of(std::uint64_t temporary_id);
  void admit(Approach approach, double now_s);
  /// Puts the first waiting car onto a safe lane; false if there is none.
  bool admit_first(Approach approach);
  void forget_departed();
  [[nodiscard]] const Station* station(std::uint64_t temporary_id) const;

  EngineParameters parameters_;
  FollowLaw law_;
  std::vector<LaneTraffic> lanes_;
  std::vector<Entrance> entrances_;
  std::vector<Station> stations_;   ///< equipped cars on the road, by temporary id
  std::vector<Step> heard_by_all_;  ///< by RSU, see UnitRules::everybody
  LaneEvents events_;
  std::vector<Entry> entries_;
  Step next_step_ = 0;
  bool overflows_ = false;
};

}  // namespace lukou::traffic
