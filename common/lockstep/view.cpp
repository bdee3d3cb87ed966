#include <algorithm>
#include <initializer_list>

#include "common/lockstep/messages.hpp"

namespace lukou {
namespace {

bool all_are(std::size_t length, std::initializer_list<std::size_t> sizes) {
  return std::ranges::all_of(sizes, [&](std::size_t size) { return size == length; });
}

}  // namespace

bool View::well_formed() const {
  constexpr std::size_t kGroups = 3;
  constexpr std::size_t kApproaches = 4;
  constexpr std::size_t kLanes = 12;
  constexpr std::size_t kCauses = 7;
  constexpr std::size_t kAdviceFates = 23;
  const FigureColumns& f = figures;
  return all_are(kGroups, {f.arrived.size(), f.waiting.size(), f.in_system.size(), f.left.size(), f.standing.size(),
                           f.stops.size(), f.throughput_veh_per_h.size(), f.stops_per_vehicle.size(),
                           f.stop_time_s.size(), f.mean_stop_time_s.size(), f.mean_delay_s.size()}) &&
         all_are(kLanes, {queue.size()}) && all_are(kApproaches, {arrived.size(), waiting.size()}) &&
         all_are(vehicle.size(),
                 {lane.size(), state.size(), equipped.size(), position_m.size(), speed_mps.size(),
                  acceleration_mps2.size(), commanded_mps2.size(), guidance.size(), bound_by.size(), missed.size(),
                  standing_steps.size(), advice_step.size(), uplink.size(), heard_step.size()}) &&
         (heads.empty() || heads.size() == kLanes) && all_are(heads.size(), {change_step.size(), next_aspect.size()}) &&
         all_are(radio_direction.size(),
                 {radio_kind.size(), radio_sent.size(), radio_heard.size(), radio_latency_ms.size()}) &&
         radio_lost.size() == kCauses * radio_direction.size() && all_are(kAdviceFates, {advice.size()});
}

}  // namespace lukou
