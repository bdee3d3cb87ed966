#include "services/rsu/algorithms/arrive_on_green.hpp"

#include <algorithm>
#include <limits>

#include "common/core/contract.hpp"
#include "services/rsu/sdk/planning.hpp"

namespace lukou {
namespace {

// Source of all: the guidance study, algorithm "punctual".
constexpr double kSlowest_mps = 0.3;         // a standing car counts as moving at this speed
constexpr double kCommittedHeadway_s = 1.5;  // a car that cannot stop crosses this much after the one before
constexpr double kGoDistance_m = 150.0;      // a car this near that makes its green need not brake for red
constexpr double kGoHorizon_s = 20.0;        // ... if the green begins within this time
constexpr int kBisections = 11;

}  // namespace

ArriveOnGreen::ArriveOnGreen(const ArriveOnGreenParameters& parameters)
    : parameters_(parameters), cars_(parameters.lifetime_s) {
  LUKOU_EXPECT(parameters.acceleration_max_mps2 > 0.0 && parameters.gain_time_s > 0.0);
  go_mps2_ = carriable_mps2(parameters.acceleration_max_mps2, parameters.acceleration_max_mps2);
}

void ArriveOnGreen::on_step(const RsuView& heard, RsuAnswer& answer) {
  for (const LaneView& lane : heard.lanes) guide_lane(heard, lane, answer);
  cars_.end_step();
}

void ArriveOnGreen::guide_lane(const RsuView& heard, const LaneView& lane, RsuAnswer& answer) {
  const ArriveOnGreenParameters& p = parameters_;
  const double target_mps = p.target_speed_share * heard.map.speed_limit_mps;
  const double now_s = heard.time_s;
  double before_s = lane.last_crossing_s.value_or(-std::numeric_limits<double>::infinity());
  for (const HeardCar& car : lane.cars) {
    const double earliest_s = now_s + approach_time_s(p.rates, {.distance_m = car.distance_m,
                                                                .speed_mps = std::max(car.speed_mps, kSlowest_mps),
                                                                .cruise_mps = std::max(car.speed_mps, target_mps),
                                                                .final_mps = target_mps});
    const double braking_m = car.speed_mps * car.speed_mps / (2 * p.acceleration_max_mps2);
    if (lane.aspect != Aspect::kGreen && braking_m > car.distance_m) {  // committed: it crosses anyway
      before_s = std::max(earliest_s, before_s + kCommittedHeadway_s);
      cars_.release(car, answer);
      continue;
    }
    double crossing_s = std::max(earliest_s, before_s + p.headway_s);
    const std::optional<GreenWindow> green = green_at_or_after(lane, crossing_s, p.tail_s);
    if (!green) {  // no green is known that late
      before_s = crossing_s;
      cars_.release(car, answer);
      continue;
    }
    crossing_s = std::max(crossing_s, green->begin_s + p.first_crossing_s);
    before_s = crossing_s;
    const bool is_to_come = green->begin_s > now_s;

    bool go = lane.aspect != Aspect::kGreen && car.distance_m < kGoDistance_m && green->begin_s <= now_s + kGoHorizon_s;
    if (crossing_s > earliest_s + p.slack_s) {
      const double into_green_s = std::max(0.0, crossing_s - green->begin_s - p.first_crossing_s);
      const double final_mps = std::min(target_mps, p.first_speed_mps + p.speed_ramp_mps2 * into_green_s);
      if (const auto acceleration_mps2 = acceleration_for(car, final_mps, crossing_s - now_s)) {
        cars_.advise(car, *acceleration_mps2, answer);
        continue;
      }
      go = go || is_to_come;
    }
    if (go) {
      cars_.advise(car, go_mps2_, answer);
    } else {
      cars_.release(car, answer);
    }
  }
}

std::optional<double> ArriveOnGreen::acceleration_for(const HeardCar& car, double final_mps,
                                                      double time_to_line_s) const {
  const auto time_at_s = [&](double cruise_mps) {
    return approach_time_s(
        parameters_.rates,
        {.distance_m = car.distance_m, .speed_mps = car.speed_mps, .cruise_mps = cruise_mps, .final_mps = final_mps});
  };
  double slow_mps = parameters_.speed_min_mps;
  double fast_mps = std::max({final_mps, car.speed_mps, slow_mps});
  if (time_at_s(fast_mps) >= time_to_line_s) return std::nullopt;
  double cruise_mps = slow_mps;
  if (time_at_s(slow_mps) > time_to_line_s) {
    for (int i = 0; i < kBisections; ++i) {
      cruise_mps = 0.5 * (slow_mps + fast_mps);
      if (time_at_s(cruise_mps) > time_to_line_s) {
        slow_mps = cruise_mps;
      } else {
        fast_mps = cruise_mps;
      }
    }
    cruise_mps = 0.5 * (slow_mps + fast_mps);
  }
  const double most_mps2 = std::min(parameters_.rates.speeding_up_mps2, go_mps2_);
  const double least_mps2 = -std::min(parameters_.rates.slowing_down_mps2, go_mps2_);
  return std::clamp((cruise_mps - car.speed_mps) / parameters_.gain_time_s, least_mps2, most_mps2);
}

}  // namespace lukou
