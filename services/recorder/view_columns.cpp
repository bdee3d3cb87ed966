#include "services/recorder/view_columns.hpp"

#include <limits>

namespace lukou {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void add(FigureColumns& columns, const GroupNow& group) {
  const auto count = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  columns.arrived.push_back(count(group.arrived));
  columns.waiting.push_back(count(group.waiting));
  columns.in_system.push_back(count(group.in_system));
  columns.left.push_back(count(group.left));
  columns.standing.push_back(count(group.standing));
  columns.stops.push_back(count(group.stops));
  columns.throughput_veh_per_h.push_back(group.throughput_veh_per_h);
  columns.stops_per_vehicle.push_back(group.stops_per_vehicle.value_or(kUnknown));
  columns.stop_time_s.push_back(static_cast<double>(group.standing_steps) / static_cast<double>(kStepsPerSecond));
  columns.mean_stop_time_s.push_back(group.mean_stop_time_s.value_or(kUnknown));
  columns.mean_delay_s.push_back(group.mean_delay_s.value_or(kUnknown));
}

}  // namespace

void fill_cars(View& view, const TrafficBatch& traffic, const RunMeasures& measures, const UplinkWatch& uplink) {
  view.arrived = traffic.arrived;
  view.waiting = traffic.waiting;
  view.heard_epoch = traffic.heard_epoch;
  view.vehicle = traffic.vehicle;
  view.lane = traffic.lane;
  view.state = traffic.state;
  view.equipped = traffic.equipped;
  view.position_m = traffic.position_m;
  view.speed_mps = traffic.speed_mps;
  view.acceleration_mps2 = traffic.acceleration_mps2;
  view.commanded_mps2 = traffic.commanded_mps2;
  view.guidance = traffic.guidance;
  view.bound_by = traffic.bound_by;
  view.missed = traffic.missed;
  view.standing_steps.clear();
  view.advice_step.clear();
  view.uplink.clear();
  view.heard_step.clear();
  for (std::size_t i = 0; i < traffic.vehicle.size(); ++i) {
    const CarNow car = measures.now(traffic.vehicle[i]);
    view.standing_steps.push_back(car.standing_steps);
    view.advice_step.push_back(car.newest_advice);
    const CarUplink heard = uplink.now(traffic, i);
    view.uplink.push_back(heard.newest);
    view.heard_step.push_back(heard.heard_step);
  }
}

void fill_figures(View& view, const RunMeasures& measures) {
  view.figures = {};
  const RunNow now = measures.now();
  for (const GroupNow* group : {&now.all, &now.equipped, &now.unequipped}) add(view.figures, *group);
  view.queue.clear();
  for (const LaneTotals& lane : measures.lanes()) view.queue.push_back(lane.standing_now);
  view.advice.clear();
  for (const std::uint64_t count : measures.advice_by_fate()) view.advice.push_back(static_cast<std::uint32_t>(count));
}

void fill_radio(View& view, std::span<const ReceptionFigures> last_second) {
  view.radio_direction.clear();
  view.radio_kind.clear();
  view.radio_sent.clear();
  view.radio_heard.clear();
  view.radio_lost.clear();
  view.radio_latency_ms.clear();
  const auto count = [](std::uint64_t value) { return static_cast<std::uint32_t>(value); };
  for (const ReceptionFigures& row : last_second) {
    view.radio_direction.push_back(static_cast<std::uint8_t>(row.direction));
    view.radio_kind.push_back(static_cast<std::uint8_t>(row.kind));
    view.radio_sent.push_back(count(row.sent));
    view.radio_heard.push_back(count(row.heard));
    for (const std::uint64_t lost : {row.lost_random, row.lost_burst, row.lost_range, row.lost_path_loss,
                                     row.lost_collision, row.lost_half_duplex, row.lost_outage}) {
      view.radio_lost.push_back(count(lost));
    }
    view.radio_latency_ms.push_back(row.latency_mean_ms.value_or(kUnknown));
  }
}

void HeadForecast::take(const SignalBatch& signal) {
  lane_ = signal.change_lane;
  aspect_ = signal.change_aspect;
  at_ = signal.change_step;
}

void HeadForecast::fill(View& view, const SignalPromise& promise) const {
  view.heads.clear();
  view.change_step.clear();
  view.next_aspect.clear();
  if (!promise.covers(view.step)) return;
  const Heads now = promise.at(view.step);
  for (const Aspect aspect : now) view.heads.push_back(static_cast<std::uint8_t>(aspect));
  view.change_step.assign(kLanes, -1);
  view.next_aspect.assign(kLanes, 0);
  Step step = view.step + 1;
  for (; promise.covers(step); ++step) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if (view.change_step[lane] >= 0 || promise.at(step)[lane] == now[lane]) continue;
      view.change_step[lane] = step;
      view.next_aspect[lane] = static_cast<std::uint8_t>(promise.at(step)[lane]);
    }
  }
  for (std::size_t i = 0; i < lane_.size(); ++i) {
    const std::size_t lane = lane_[i];
    if (at_[i] < step || view.change_step[lane] >= 0) continue;
    view.change_step[lane] = at_[i];
    view.next_aspect[lane] = aspect_[i];
  }
}

}  // namespace lukou
