#include "services/rsu/algorithms/cv_phase.hpp"

#include <algorithm>
#include <limits>

#include "services/rsu/sdk/planning.hpp"

namespace lukou {
namespace {

constexpr double kForever_s = std::numeric_limits<double>::infinity();
constexpr double kEndEvery_s = 1.0;  // between two times at which the green could end

}  // namespace

CvPhase::CvPhase(const CvPhaseParameters& parameters) : parameters_(parameters), control_(parameters.staging) {}

void CvPhase::on_step(const RsuView& heard, RsuAnswer& answer) {
  control_.see(heard);
  if (control_.may_change() && heard.step % step_at_or_after(parameters_.decision_s) == 0) {
    predict(heard);
    control_.go_to(choice(*heard.actuation));
  }
  control_.ask(answer);
}

void CvPhase::predict(const RsuView& heard) {
  const double cruise_mps = parameters_.target_speed_share * heard.map.speed_limit_mps;
  for (std::size_t lane = 0; lane < arrivals_.size(); ++lane) {
    arrivals_[lane].clear();
    for (const HeardCar& car : heard.lanes[lane].cars) {
      arrivals_[lane].push_back(
          time_to_line_s(car.distance_m, car.speed_mps, parameters_.speeding_up_mps2, cruise_mps));
    }
  }
}

std::size_t CvPhase::choice(const Actuation& rules) const {
  const std::size_t now = control_.current();
  std::size_t longest_red = now;
  for (std::size_t stage = 0; stage < control_.stages().size(); ++stage) {
    if (control_.red_s(stage) > control_.red_s(longest_red)) longest_red = stage;
  }
  if (control_.red_s(longest_red) >= parameters_.max_red_s) return longest_red;

  std::size_t next = now;
  double at_once_s = kForever_s;
  double later_s = kForever_s;
  for (std::size_t to = 0; to < control_.stages().size(); ++to) {
    if (to == now) continue;
    for (double wait_s = 0.0; wait_s <= parameters_.horizon_s; wait_s += kEndEvery_s) {
      const double cost = cost_s(arrivals_, now, to, control_.lead_s() + wait_s, rules);
      if (wait_s > 0.0) {
        later_s = std::min(later_s, cost);
      } else if (cost < at_once_s) {
        at_once_s = cost;
        next = to;
      }
    }
  }
  return at_once_s < later_s ? next : now;
}

double CvPhase::cost_s(const Arrivals& arrivals, std::size_t from, std::size_t to, double end_s,
                       const Actuation& rules) const {
  const std::vector<LaneSet>& stages = control_.stages();
  const double clearance_s = time_s(rules.yellow + rules.all_red);
  std::array<std::size_t, kLanes> next{};
  double cost = 0.0;
  const auto serve_stage = [&](LaneSet lanes, const Green& green) {
    double last_s = 0.0;
    for (const Lane lane : lanes) {
      const Service service = serve(arrivals[index(lane)], next[index(lane)], green);
      cost += service.delay_s;
      last_s = std::max(last_s, service.last_s);
    }
    return last_s;
  };
  serve_stage(stages[from], {.first_s = 0.0, .end_s = end_s + parameters_.tail_s});
  const double begin_s = end_s + clearance_s;
  const double last_s = serve_stage(
      stages[to],
      {.first_s = begin_s + parameters_.first_crossing_s, .end_s = begin_s + parameters_.max_red_s, .until_gap = true});
  const double again_s = std::max(begin_s + time_s(rules.min_green), last_s) + clearance_s;
  serve_stage(stages[from], {.first_s = again_s + parameters_.first_crossing_s, .end_s = kForever_s});
  const double after_s = again_s + time_s(rules.min_green) + clearance_s + parameters_.first_crossing_s;
  serve_stage(kAllLanes, {.first_s = after_s, .end_s = kForever_s});
  return cost;
}

CvPhase::Service CvPhase::serve(const std::vector<double>& arrivals, std::size_t& next, const Green& green) const {
  const double headway_s = parameters_.headway_s / parameters_.equipped_share;
  Service service;
  double free_s = green.first_s;
  for (; next < arrivals.size(); ++next) {
    const double arrival_s = arrivals[next];
    const double crossing_s = std::max(arrival_s, free_s);
    if (crossing_s > green.end_s || (green.until_gap && arrival_s > free_s + parameters_.gap_s)) break;
    service.delay_s += crossing_s - arrival_s;
    service.last_s = crossing_s;
    free_s = crossing_s + headway_s;
  }
  return service;
}

}  // namespace lukou
