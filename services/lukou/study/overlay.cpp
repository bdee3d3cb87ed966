#include "services/lukou/study/overlay.hpp"

#include <array>

#include "common/intersection/lane.hpp"
#include "scenario.pb.h"
#include "services/lukou/study/statistics/delay_formulas.hpp"

namespace lukou::studies {

std::string name(Overlay overlay) { return overlay == Overlay::kWebster ? "Webster" : "HCM"; }

std::optional<double> formula_delay_s(const scenario::Resolved& scenario, Overlay overlay) {
  const auto plan = scenario::signal_plan(scenario);
  if (!plan) return std::nullopt;
  const scenario::Traffic& traffic = scenario.message().traffic();
  const std::array<const scenario::Demand*, kApproaches> demands = {&traffic.west(), &traffic.south(), &traffic.east(),
                                                                    &traffic.north()};
  double flow_veh_per_h = 0.0;
  double delay_s = 0.0;
  for (const Approach approach : kAllApproaches) {
    const scenario::Demand& demand = *demands[index(approach)];
    if (!demand.has_flow_veh_per_h()) return std::nullopt;
    const std::array<double, kLanesPerApproach> shares = {demand.shares().left(), demand.shares().center(),
                                                          demand.shares().right()};
    const double sum = shares[0] + shares[1] + shares[2];
    for (std::size_t turn = 0; turn < shares.size(); ++turn) {
      const statistics::SignalisedLane lane{
          .flow_veh_per_h = demand.flow_veh_per_h() * shares[turn] / sum,
          .saturation_veh_per_h = scenario::kSaturationFlow_veh_per_h,
          .cycle_s = time_s(plan.value().cycle),
          .green_s =
              time_s(plan.value().cycle) * green_share(plan.value(), lane_of(approach, static_cast<Turn>(turn)))};
      if (lane.flow_veh_per_h <= 0.0) continue;
      if (lane.green_s <= 0.0) return std::nullopt;
      const auto of_lane_s = overlay == Overlay::kWebster
                                 ? statistics::webster_delay_s(lane)
                                 : std::optional(statistics::hcm_delay_s(lane, scenario.message().run().duration_s()));
      if (!of_lane_s) return std::nullopt;
      flow_veh_per_h += lane.flow_veh_per_h;
      delay_s += lane.flow_veh_per_h * *of_lane_s;
    }
  }
  if (flow_veh_per_h <= 0.0) return std::nullopt;
  return delay_s / flow_veh_per_h;
}

}  // namespace lukou::studies
