#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/intersection/lane.hpp"
#include "services/traffic_engine/model/parameters.hpp"

namespace lukou::traffic {

/// The arrivals of one approach, in order. With a flow, arrival n falls where the integral of the rate reaches the sum
/// of the first n + 1 unit exponentials: a Poisson process (the paper, 4.2), whose draws a changed flow leaves alone.
class Demand {
 public:
  Demand(std::uint64_t seed, Approach approach, const DemandParameters& parameters);

  /// Time [s] of the next arrival if it is at most `now_s`; it then counts as taken. Requires now_s never to decrease.
  std::optional<double> next_until(double now_s);
  /// From `now_s` on the flow is this one, whatever was planned. Requires that no arrival after `now_s` was taken.
  void change_flow(double now_s, double flow_veh_per_h);
  [[nodiscard]] std::uint32_t taken() const { return taken_; }

 private:
  std::optional<double> next_listed_until(double now_s);
  /// Moves the point from which the integral is counted.
  void move_base_to(double time_s);
  void draw_next_gap();

  std::uint64_t seed_;
  Approach approach_;
  std::vector<Flow> flows_;
  std::size_t next_flow_ = 0;  ///< the first of `flows_` that does not hold yet
  bool listed_;
  std::vector<double> arrivals_s_;
  std::uint32_t taken_ = 0;
  double rate_per_s_ = 0.0;
  double base_s_ = 0.0;    ///< the integral is known up to here
  double integral_ = 0.0;  ///< of the rate, up to base_s_
  double due_at_ = 0.0;    ///< value of the integral at the next arrival
};

}  // namespace lukou::traffic
