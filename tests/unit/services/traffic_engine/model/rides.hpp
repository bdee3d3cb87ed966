#pragma once

#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "common/intersection/signal_plan.hpp"
#include "services/traffic_engine/model/engine.hpp"

namespace lukou::traffic {

inline Heads all_heads(Aspect aspect) {
  Heads heads{};
  heads.fill(aspect);
  return heads;
}

/// Drivers without spread and actuators without noise: everybody enters at, and wants, 15 m/s.
inline EngineParameters calm_parameters() {
  EngineParameters parameters;
  parameters.vehicles.actuation_noise_mps2 = 0.0;
  parameters.driving.desired_speed_deviation = 0.0;
  parameters.equipped_ratio = 1.0;
  for (DemandParameters& demand : parameters.demand) demand.flows.clear();
  return parameters;
}

/// Cars arrive from the west at these times, on the lane WC alone.
inline EngineParameters with_arrivals(EngineParameters parameters, std::initializer_list<double> arrivals_s) {
  DemandParameters& west = parameters.demand[index(Approach::kWest)];
  west.listed = true;
  west.arrivals_s = arrivals_s;
  west.lane_weights = {0.0, 1.0, 0.0};
  return parameters;
}

inline constexpr Lane kWestCenter = lane_of(Approach::kWest, Turn::kCenter);

/// An engine that is driven step by step under heads that the test sets.
class Ride {
 public:
  explicit Ride(const EngineParameters& parameters, Aspect aspect = Aspect::kGreen)
      : engine_(parameters), heads_(all_heads(aspect)) {
    engine_.step(0, heads_, {});
  }

  void show(Aspect aspect) { heads_ = all_heads(aspect); }
  void show(const Heads& heads) { heads_ = heads; }
  void step(std::span<const Advice> advice = {}) {
    engine_.hear_rsu(0, step_);
    engine_.step(++step_, heads_, advice);
    for (const Crossing& crossing : engine_.events().crossings) crossings_.push_back(crossing);
    for (const OutcomeEvent& outcome : engine_.events().outcomes) outcomes_.push_back(outcome);
  }
  void run_to(Step step_number) {
    while (step_ < step_number) step();
  }

  [[nodiscard]] Step now() const { return step_; }
  [[nodiscard]] const Engine& engine() const { return engine_; }
  [[nodiscard]] Engine& engine() { return engine_; }
  [[nodiscard]] const std::vector<Car>& cars() const { return engine_.lane(kWestCenter).cars(); }
  [[nodiscard]] const std::vector<Crossing>& crossings() const { return crossings_; }
  /// Every outcome since the last call.
  std::vector<OutcomeEvent> take_outcomes() { return std::exchange(outcomes_, {}); }
  /// A GUARD advice for a car on WC, issued now, for the next step and the ones after.
  [[nodiscard]] Advice advise(std::size_t car, double acceleration_mps2, Step lifetime = 5) {
    return {.target = cars().at(car).temporary_id,
            .acceleration_mps2 = acceleration_mps2,
            .binding = AdviceBinding::kGuard,
            .release = false,
            .issued = step_,
            .lifetime = lifetime,
            .rsu = 0,
            .sequence = next_sequence_++};
  }

 private:
  Engine engine_;
  Heads heads_;
  Step step_ = 0;
  std::uint32_t next_sequence_ = 0;
  std::vector<Crossing> crossings_;
  std::vector<OutcomeEvent> outcomes_;
};

}  // namespace lukou::traffic
