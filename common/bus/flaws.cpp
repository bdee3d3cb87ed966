#include "common/bus/flaws.hpp"

#include <algorithm>
#include <cmath>

namespace lukou::bus {
namespace {

constexpr std::size_t kApproaches = 4;
constexpr std::size_t kLanes = 12;

/// Goes through the columns of a batch and keeps the first thing that is wrong.
class Check {
 public:
  /// The column whose length those that follow must have.
  template <class T>
  Check& group(const char* name, const std::vector<T>& column) {
    first_ = name;
    rows_ = column.size();
    return *this;
  }
  Check& rows(const char* of, std::size_t count) {
    first_ = of;
    rows_ = count;
    return *this;
  }
  template <class T>
  Check& same(const char* name, const std::vector<T>& column) {
    if (column.size() != rows_) {
      fail(std::string(name) + " has " + std::to_string(column.size()) + " values, " + first_ + " has " +
           std::to_string(rows_));
    }
    return *this;
  }
  /// What is named from now on is part of this.
  Check& in(const char* part) {
    part_ = part;
    return *this;
  }
  /// Every value passes; `must`: what it should be.
  template <class T, class Good>
  Check& each(const char* name, const std::vector<T>& column, const char* must, Good good) {
    const auto bad = std::ranges::find_if_not(column, good);
    if (bad != column.end()) {
      fail(std::string(name) + "[" + std::to_string(bad - column.begin()) + "] is " + std::to_string(*bad) +
           ", must be " + must);
    }
    return *this;
  }
  template <class T, class Good>
  Check& column(const char* name, const std::vector<T>& values, const char* must, Good good) {
    return same(name, values).each(name, values, must, good);
  }
  Check& that(bool good, const char* name, const char* must) {
    if (!good) fail(std::string(name) + " must be " + must);
    return *this;
  }
  [[nodiscard]] std::string wrong() const { return wrong_; }

 private:
  void fail(const std::string& what) {
    if (wrong_.empty()) wrong_ = part_ + what;
  }

  const char* part_ = "";
  std::string first_;
  std::size_t rows_ = 0;
  std::string wrong_;
};

constexpr const char* kANumber = "a finite number";
constexpr const char* kFewEnough = "at most 65536 in a step";
constexpr const char* kAStep = "a step, at least 0";

// As objects, so that each column is one tight loop: these checks are made in every step.
constexpr auto finite = [](double value) { return std::isfinite(value); };
constexpr auto finite_or_none = [](double value) { return !std::isinf(value); };
constexpr auto not_negative_or_none = [](double value) {
  return std::isnan(value) || (!std::isinf(value) && value >= 0.0);
};
constexpr auto step_or_none = [](Step value) { return value >= -1; };
constexpr auto not_negative = [](double value) { return std::isfinite(value) && value >= 0.0; };
constexpr auto step = [](Step value) { return value >= 0; };
/// In [First, Last].
template <std::uint8_t First, std::uint8_t Last>
constexpr auto within = [](std::uint8_t value) { return value >= First && value <= Last; };
constexpr auto yes_or_no = within<0, 1>;
constexpr auto lane = within<0, kLanes - 1>;
constexpr auto aspect = within<1, 3>;
constexpr auto frame_kind = within<1, 5>;

void check(Check& check, const Frames& frames) {
  check.group("frames.sender", frames.sender).same("frames.sequence_number", frames.sequence);
  check.column("frames.kind", frames.kind, "1 to 5", frame_kind);
  check.column("frames.wire_bytes", frames.wire_bytes, "at most 65535",
               [](std::uint32_t bytes) { return bytes <= kWireBytesMax; });
  check.column("frames.antenna_x_m", frames.antenna_x_m, kANumber, finite);
  check.column("frames.antenna_y_m", frames.antenna_y_m, kANumber, finite);
  check.same("frames.payload_end", frames.payload_end);
  std::uint32_t end = 0;
  for (const std::uint32_t next : frames.payload_end) {
    check.that(next >= end && next <= frames.payload.size(), "frames.payload_end", "rising, within the payload");
    end = next;
  }
  check.that(end == frames.payload.size(), "frames.payload", "nothing but the bytes of the frames");
}

void check(Check& check, const SensedColumns& sensed) {
  check.group("sensed.rsu", sensed.rsu).same("sensed.sensor", sensed.sensor).same("sensed.track", sensed.track);
  check.column("sensed.x_m", sensed.x_m, kANumber, finite).column("sensed.y_m", sensed.y_m, kANumber, finite);
  check.column("sensed.speed_mps", sensed.speed_mps, "a speed, at least 0", not_negative);
  check.column("sensed.heading_rad", sensed.heading_rad, kANumber, finite);
  check.column("sensed.length_class", sensed.length_class, "1 to 3", within<1, 3>);
  check.column("sensed.measured_step", sensed.measured, kAStep, step);
}

void check(Check& check, const ReceptionReport& report) {
  check.group("reception.direction", report.direction);
  check.each("reception.direction", report.direction, "0 to 2", within<0, 2>);
  check.column("reception.kind", report.kind, "1 to 5", frame_kind);
  check.that(report.well_formed(), "reception", "a report whose columns have one value a row");
  check.each("reception.busy_ratio", report.busy_ratio, "0 to 1, or NaN",
             [](double ratio) { return std::isnan(ratio) || (ratio >= 0.0 && ratio <= 1.0); });
  check.each("reception.latency_ms", report.latency_ms, "at least 0", not_negative);
}

/// The rows of the group that stands.
void check(Check& check, const FrameFates& fates) {
  check.column("uplink.fate", fates.fate, "0 to 7", within<0, kFrameFates - 1>);
  check.column("uplink.due", fates.due, "a step, or -1", step_or_none);
  check.column("uplink.latency_ms", fates.latency_ms, "at least 0, or NaN", not_negative_or_none);
}

}  // namespace

std::string flaw_of(const AirBatch& batch) {
  Check air;
  air.that(batch.step >= 0, "step", kAStep);
  air.that(batch.frames.size() <= kFramesMax, "frames", kFewEnough);
  check(air, batch.frames);
  check(air, batch.sensed);
  return air.wrong();
}

std::string flaw_of(const RoadsideBatch& batch) {
  Check roadside;
  roadside.that(batch.step >= 0, "step", kAStep);
  roadside.that(batch.frames.size() <= kFramesMax, "frames", kFewEnough);
  check(roadside, batch.frames);
  check(roadside, batch.reception);
  check(roadside.group("uplink.fate", batch.uplink.fate), batch.uplink);
  roadside.group("request_lanes", batch.request_lanes).that(batch.request_lanes.size() <= 1, "request_lanes", "one");
  roadside.same("request_lifetime", batch.request_lifetime);
  return roadside.wrong();
}

std::string flaw_of(const RequestBatch& batch) {
  // What it asks for is judged by the controller, and refused with a reason.
  Check request;
  request.that(batch.step >= 0, "step", kAStep).group("lanes", batch.lanes).same("lifetime", batch.lifetime);
  return request.wrong();
}

std::string flaw_of(const SignalBatch& batch) {
  Check signal;
  signal.that(batch.step >= 0, "step", kAStep).that(batch.first >= 0, "first", kAStep);
  signal.that(!batch.heads.empty() && batch.heads.size() % kLanes == 0, "heads", "twelve for each step");
  signal.each("heads", batch.heads, "1 to 3", aspect);
  signal.group("change_lane", batch.change_lane).each("change_lane", batch.change_lane, "0 to 11", lane);
  signal.column("change_aspect", batch.change_aspect, "1 to 3", aspect);
  signal.column("change_step", batch.change_step, kAStep, step);
  signal.group("request_step", batch.request_step).each("request_step", batch.request_step, kAStep, step);
  signal.column("request_asked", batch.request_asked, kAStep, step).same("request_rsu", batch.request_rsu);
  signal.same("request_lanes", batch.request_lanes);
  signal.column("request_outcome", batch.request_outcome, "0 to 6", within<0, 6>);
  return signal.wrong();
}

std::string flaw_of(const TrafficBatch& batch) {
  Check traffic;
  traffic.that(batch.step >= 0, "step", kAStep).that(batch.overflow <= 1, "overflow", "0 or 1");
  traffic.group("vehicle", batch.vehicle).column("lane", batch.lane, "0 to 11", lane);
  traffic.column("state", batch.state, "0 to 3", within<0, 3>);
  traffic.column("equipped", batch.equipped, "0 or 1", yes_or_no);
  traffic.column("position_m", batch.position_m, kANumber, finite);
  traffic.column("speed_mps", batch.speed_mps, kANumber, finite);
  traffic.column("acceleration_mps2", batch.acceleration_mps2, kANumber, finite);
  traffic.column("commanded_mps2", batch.commanded_mps2, "a number, or NaN", finite_or_none);
  traffic.column("noise_mps2", batch.noise_mps2, kANumber, finite);
  traffic.column("guidance", batch.guidance, "0 to 8", within<0, kGuidanceStates - 1>);
  traffic.column("bound_by", batch.bound_by, "0 to 6", within<0, 6>);
  traffic.column("missed", batch.missed, "0 to 22, or 255",
                 [](std::uint8_t value) { return value < kAdviceFates || value == kNothingMissed; });
  traffic.rows("the junction", kApproaches).same("arrived", batch.arrived).same("waiting", batch.waiting);
  traffic.same("arrived_equipped", batch.arrived_equipped).same("waiting_equipped", batch.waiting_equipped);
  traffic.group("entered_vehicle", batch.entered_vehicle).column("entered_lane", batch.entered_lane, "0 to 11", lane);
  traffic.column("entered_equipped", batch.entered_equipped, "0 or 1", yes_or_no);
  traffic.column("entered_speed_mps", batch.entered_speed_mps, kANumber, finite);
  traffic.column("entered_desired_speed_mps", batch.entered_desired_speed_mps, kANumber, finite);
  traffic.group("crossed_vehicle", batch.crossed_vehicle);
  traffic.column("crossed_time_s", batch.crossed_time_s, kANumber, finite);
  traffic.column("crossed_aspect", batch.crossed_aspect, "1 to 3", aspect);
  traffic.column("crossed_committed", batch.crossed_committed, "0 or 1", yes_or_no);
  traffic.group("left_vehicle", batch.left_vehicle).column("left_time_s", batch.left_time_s, kANumber, finite);
  traffic.group("fate_vehicle", batch.fate_vehicle).same("fate_rsu", batch.fate_rsu);
  traffic.same("fate_sequence", batch.fate_sequence);
  traffic.column("fate", batch.fate, "0 to 22", within<0, kAdviceFates - 1>);
  traffic.column("fate_again", batch.fate_again, "0 or 1", yes_or_no);
  traffic.column("fate_issued", batch.fate_issued, "a step, or -1", step_or_none);
  traffic.column("fate_commanded_mps2", batch.fate_commanded_mps2, "a number, or NaN", finite_or_none);
  traffic.column("fate_kind", batch.fate_kind, "0 to 3", within<0, kAdviceKinds - 1>);
  traffic.column("fate_speed_mps", batch.fate_speed_mps, "a number, or NaN", finite_or_none);
  traffic.group("heard_epoch", batch.heard_epoch).same("computing_ms", batch.computing_ms);
  check(traffic, batch.reception);
  traffic.group("uplink_vehicle", batch.uplink_vehicle).same("uplink_rsu", batch.uplink_rsu);
  check(traffic, batch.uplink);
  traffic.group("asked_rsu", batch.asked_rsu).same("asked_lanes", batch.asked_lanes);
  traffic.same("asked_lifetime", batch.asked_lifetime);
  traffic.group("said.sender", batch.said.sender).same("said_rsu", batch.said_rsu);
  check(traffic.in("air: "), batch.air);
  check(traffic, batch.sensed);
  check(traffic.in("said: "), batch.said);
  return traffic.wrong();
}

std::string flaw_of(const Control& message) {
  Check control;
  const auto kind = static_cast<int>(message.kind);
  control.that(kind >= 1 && kind <= static_cast<int>(Control::Kind::kReply), "kind", "1 to 8");
  control.group("roster_incarnation", message.roster_incarnation).same("roster_role", message.roster_role);
  control.group("directive_step", message.directive_step).same("directive_set", message.directive_set);
  control.group("attach_rsu", message.attach_rsu).same("attach_epoch", message.attach_epoch);
  control.column("attach_from", message.attach_from, kAStep, step);
  return control.wrong();
}

std::string flaw_of(const Up& message) {
  Check up;
  const auto kind = static_cast<int>(message.kind);
  up.that(kind >= 1 && kind <= static_cast<int>(Up::Kind::kLost), "kind", "1 to 9");
  return up.wrong();
}

std::string flaw_of(const RunState& message) {
  Check state;
  state.that(static_cast<int>(message.phase) <= static_cast<int>(RunPhase::kAborted), "phase", "0 to 5");
  state.that(not_negative(message.pace), "pace", "a number, at least 0");
  return state.wrong();
}

std::string flaw_of(const View& message) {
  Check view;
  view.that(message.well_formed(), "view", "one whose columns have one value a row");
  return view.wrong();
}

}  // namespace lukou::bus
