#include "services/traffic_engine/model/demand.hpp"

#include <algorithm>
#include <limits>

#include "common/core/contract.hpp"
#include "common/core/keyed_random.hpp"

namespace lukou::traffic {
namespace {

constexpr double kSecondsPerHour = 3600.0;

}  // namespace

Demand::Demand(std::uint64_t seed, Approach approach, const DemandParameters& parameters)
    : seed_(seed),
      approach_(approach),
      flows_(parameters.flows),
      listed_(parameters.listed),
      arrivals_s_(parameters.arrivals_s) {
  LUKOU_EXPECT(std::ranges::is_sorted(arrivals_s_));
  LUKOU_EXPECT(std::ranges::is_sorted(flows_, {}, &Flow::from_s));
  draw_next_gap();
}

void Demand::draw_next_gap() {
  due_at_ += unit_exponential({.run_seed = seed_,
                               .purpose = Purpose::kArrivalGap,
                               .entity = static_cast<std::uint32_t>(approach_),
                               .index = taken_});
}

void Demand::move_base_to(double time_s) {
  integral_ += rate_per_s_ * (time_s - base_s_);
  base_s_ = time_s;
}

std::optional<double> Demand::next_listed_until(double now_s) {
  if (taken_ >= arrivals_s_.size() || arrivals_s_[taken_] > now_s) return std::nullopt;
  return arrivals_s_[taken_++];
}

std::optional<double> Demand::next_until(double now_s) {
  if (listed_) return next_listed_until(now_s);
  for (;;) {
    const double flow_ends_s =
        next_flow_ < flows_.size() ? flows_[next_flow_].from_s : std::numeric_limits<double>::infinity();
    if (rate_per_s_ > 0.0) {
      const double arrival_s = base_s_ + (due_at_ - integral_) / rate_per_s_;
      if (arrival_s <= std::min(now_s, flow_ends_s)) {
        ++taken_;
        draw_next_gap();
        return arrival_s;
      }
    }
    if (flow_ends_s > now_s) return std::nullopt;
    move_base_to(flow_ends_s);
    rate_per_s_ = flows_[next_flow_++].flow_veh_per_h / kSecondsPerHour;
  }
}

void Demand::change_flow(double now_s, double flow_veh_per_h) {
  if (listed_) {  // from now on arrivals are drawn
    listed_ = false;
    arrivals_s_.clear();
    base_s_ = now_s;
    integral_ = 0.0;
    due_at_ = 0.0;
    draw_next_gap();
  } else {
    move_base_to(now_s);
  }
  flows_.clear();
  next_flow_ = 0;
  rate_per_s_ = flow_veh_per_h / kSecondsPerHour;
}

}  // namespace lukou::traffic
