#include "services/rsu/algorithms/stages.hpp"

#include <algorithm>

#include "services/rsu/sdk/planning.hpp"

namespace lukou {
namespace {

constexpr Step kRequestLifetime = 5;  // steps; renewed in each

LaneSet lanes_of(Approach one, Approach opposite, std::initializer_list<Turn> turns) {
  LaneSet lanes;
  for (const Turn turn : turns) {
    lanes.insert(lane_of(one, turn));
    lanes.insert(lane_of(opposite, turn));
  }
  return lanes;
}

/// When what the lane shows at the end of the promise began.
Step shown_since(const LaneView& lane, Step promised_to) {
  Step since = lane.aspect_since;
  for (const SignalChange& change : lane.changes) {
    if (change.step <= promised_to) since = change.step;
  }
  return since;
}

}  // namespace

std::vector<LaneSet> stages_of(Staging staging) {
  using enum Approach;
  if (staging == Staging::kAxes) {
    return {lanes_of(kWest, kEast, {Turn::kLeft, Turn::kCenter, Turn::kRight}),
            lanes_of(kSouth, kNorth, {Turn::kLeft, Turn::kCenter, Turn::kRight})};
  }
  return {lanes_of(kWest, kEast, {Turn::kCenter, Turn::kRight}), lanes_of(kWest, kEast, {Turn::kLeft}),
          lanes_of(kSouth, kNorth, {Turn::kCenter, Turn::kRight}), lanes_of(kSouth, kNorth, {Turn::kLeft})};
}

StageControl::StageControl(Staging staging) : stages_(stages_of(staging)), green_until_(stages_.size(), -1) {}

void StageControl::see(const RsuView& heard) {
  acts_ = heard.request_acts;
  lead_s_ = time_s(acts_ - heard.step);
  const LaneSet green = promised_green(heard);
  for (std::size_t stage = 0; stage < stages_.size(); ++stage) {
    if (!(stages_[stage] & green).empty()) green_until_[stage] = heard.promised_to;
  }
  if (!begun_) {
    begun_ = true;
    const auto shown = std::ranges::find_if(stages_, [&](LaneSet lanes) { return (lanes - green).empty(); });
    if (shown != stages_.end()) current_ = static_cast<std::size_t>(shown - stages_.begin());
  }
  may_change_ = false;
  green_s_ = 0.0;
  if (!(stages_[current_] - green).empty()) return;
  Step since = 0;
  for (const Lane lane : stages_[current_]) {
    since = std::max(since, shown_since(heard.lanes[index(lane)], heard.promised_to));
  }
  green_s_ = time_s(acts_ - since);
  may_change_ = heard.actuation && acts_ - since >= heard.actuation->min_green;
}

double StageControl::red_s(std::size_t stage) const { return time_s(acts_ - green_until_[stage]); }

void StageControl::ask(RsuAnswer& answer) const { answer.request_green(stages_[current_], kRequestLifetime); }

}  // namespace lukou
