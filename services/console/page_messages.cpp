#include "services/console/page_messages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

#include "common/bus/batches.hpp"
#include "common/lockstep/roster.hpp"
#include "common/radio/reception_report.hpp"
#include "console.pb.h"

namespace lukou::console {
namespace {

constexpr double kClockSilent_s = 3.0;  ///< it speaks ten times a second

/// As in radio.csv, in the order of View::radio_lost.
constexpr std::array<const char*, 7> kCauses = {"random",    "burst",       "range", "path_loss",
                                                "collision", "half_duplex", "outage"};
constexpr std::size_t kDirections = 3;

/// In the order of Statistics::overridden.
constexpr std::array kOverrides = {AdviceFate::kChangedLimit, AdviceFate::kChangedGuard, AdviceFate::kChangedFollowing,
                                   AdviceFate::kChangedRed, AdviceFate::kChangedDriver};

std::string octets(const std::vector<std::uint8_t>& column) { return {column.begin(), column.end()}; }

/// -1: it never was.
std::int32_t steps_since(Step then, Step now) { return then < 0 ? -1 : static_cast<std::int32_t>(now - then); }

template <class Column, class Field>
void fill_floats(const Column& column, Field& field) {
  field.Reserve(static_cast<int>(column.size()));
  for (const double value : column) field.Add(static_cast<float>(value));
}

void fill(Figures& figures, const FigureColumns& columns, std::size_t group) {
  figures.set_arrived(columns.arrived[group]);
  figures.set_waiting_outside(columns.waiting[group]);
  figures.set_in_system(columns.in_system[group]);
  figures.set_left(columns.left[group]);
  figures.set_throughput_veh_per_h(columns.throughput_veh_per_h[group]);
  figures.set_standing(columns.standing[group]);
  figures.set_stops(columns.stops[group]);
  figures.set_stop_time_s(columns.stop_time_s[group]);
  const auto known = [](double value) { return !std::isnan(value); };
  if (const double v = columns.stops_per_vehicle[group]; known(v)) figures.set_stops_per_vehicle(v);
  if (const double v = columns.mean_stop_time_s[group]; known(v)) figures.set_mean_stop_time_s(v);
  if (const double v = columns.mean_delay_s[group]; known(v)) figures.set_mean_delay_s(v);
}

/// One direction of the air in the last second, all kinds of frames together.
struct DirectionSums {
  std::uint64_t sent = 0;
  std::uint64_t heard = 0;
  double latency_ms = 0.0;  ///< summed over what was heard
  std::array<std::uint32_t, kCauses.size()> lost{};

  [[nodiscard]] double delivery_ratio() const {
    std::uint64_t all = 0;
    for (const std::uint32_t cause : lost) all += cause;
    return sent == 0 ? 1.0 : 1.0 - static_cast<double>(all) / static_cast<double>(sent);
  }
  [[nodiscard]] double mean_latency_ms() const { return heard == 0 ? 0.0 : latency_ms / static_cast<double>(heard); }
};

std::array<DirectionSums, kDirections> radio_sums(const View& view) {
  std::array<DirectionSums, kDirections> sums;
  for (std::size_t row = 0; row < view.radio_direction.size(); ++row) {
    if (view.radio_direction[row] >= sums.size()) continue;
    DirectionSums& direction = sums[view.radio_direction[row]];
    direction.sent += view.radio_sent[row];
    direction.heard += view.radio_heard[row];
    if (view.radio_heard[row] > 0) direction.latency_ms += view.radio_latency_ms[row] * view.radio_heard[row];
    for (std::size_t cause = 0; cause < kCauses.size(); ++cause) {
      direction.lost[cause] += view.radio_lost[row * kCauses.size() + cause];
    }
  }
  return sums;
}

}  // namespace

Picture picture_of(const View& view) {
  Picture picture;
  picture.set_step(view.step);
  picture.mutable_vehicle()->Add(view.vehicle.begin(), view.vehicle.end());
  picture.set_lane(octets(view.lane));
  picture.set_equipped(octets(view.equipped));
  fill_floats(view.position_m, *picture.mutable_position_m());
  fill_floats(view.speed_mps, *picture.mutable_speed_mps());
  fill_floats(view.acceleration_mps2, *picture.mutable_acceleration_mps2());
  fill_floats(view.commanded_mps2, *picture.mutable_commanded_mps2());
  picture.set_state(octets(view.state));
  picture.set_guidance(octets(view.guidance));
  picture.set_bound_by(octets(view.bound_by));
  picture.set_missed(octets(view.missed));
  for (const std::uint32_t steps : view.standing_steps) {
    picture.add_stood_s(static_cast<float>(steps) / static_cast<float>(kStepsPerSecond));
  }
  for (const Step issued : view.advice_step) picture.add_advice_age(steps_since(issued, view.step));
  picture.set_heads(octets(view.heads));
  for (const Step at : view.change_step) {
    picture.add_change_in(at < 0 ? -1 : static_cast<std::int32_t>(at - view.step));
  }
  picture.set_next_aspect(octets(view.next_aspect));
  picture.set_uplink(octets(view.uplink));
  for (const Step sent : view.heard_step) picture.add_heard_age(steps_since(sent, view.step));
  picture.mutable_waiting()->Add(view.waiting.begin(), view.waiting.end());
  return picture;
}

Statistics statistics_of(const View& view) {
  Statistics statistics;
  statistics.set_step(view.step);
  fill(*statistics.mutable_all(), view.figures, 0);
  fill(*statistics.mutable_equipped(), view.figures, 1);
  fill(*statistics.mutable_unequipped(), view.figures, 2);
  statistics.mutable_queue()->Add(view.queue.begin(), view.queue.end());
  const auto equipped = static_cast<double>(view.figures.in_system[1]);
  const std::uint32_t cars = view.figures.in_system[0];
  statistics.set_equipped_share(cars == 0 ? 0.0 : equipped / cars);
  statistics.mutable_arrived()->Add(view.arrived.begin(), view.arrived.end());
  const auto sums = radio_sums(view);
  statistics.set_delivery_ratio_up(sums[0].delivery_ratio());
  statistics.set_delivery_ratio_down(sums[1].delivery_ratio());
  statistics.set_latency_up_ms(sums[0].mean_latency_ms());
  statistics.set_latency_down_ms(sums[1].mean_latency_ms());
  for (std::size_t direction = 0; direction < sums.size(); ++direction) {
    for (std::size_t cause = 0; cause < kCauses.size(); ++cause) {
      if (sums[direction].lost[cause] == 0) continue;
      LossCount& loss = *statistics.add_losses();
      loss.set_direction(std::string(name(static_cast<Direction>(direction))));
      loss.set_cause(kCauses[cause]);
      loss.set_frames(sums[direction].lost[cause]);
    }
  }
  for (const AdviceFate fate : kOverrides) statistics.add_overridden(view.advice[static_cast<std::size_t>(fate)]);
  return statistics;
}

void PaceMeter::note(double now_s, Step step) {
  if (!seen_.empty() && step < seen_.back().step) seen_.clear();  // another run
  seen_.push_back({now_s, step});
  while (seen_.size() > 2) {
    const double without_s = now_s - seen_[1].at_s;
    const bool enough = without_s >= 1.0 && step - seen_[1].step >= kStepsPerSecond;
    if (!enough && without_s < 5.0) break;
    seen_.pop_front();
  }
}

double PaceMeter::pace() const {
  if (seen_.size() < 2) return 0.0;
  const double wall_s = seen_.back().at_s - seen_.front().at_s;
  return wall_s > 0.0 ? time_s(seen_.back().step - seen_.front().step) / wall_s : 0.0;
}

RunStatus status_of(const RunState& state, std::uint32_t rsus, const std::vector<std::uint32_t>& rsus_heard,
                    double clock_silent_s) {
  RunStatus status;
  status.set_phase(std::string(name(state.phase)));
  status.set_granted(state.granted);
  status.set_recorded(state.recorded);
  status.set_end(state.end);
  status.set_pace(state.pace);
  status.set_text(state.text);
  status.set_culprit(state.culprit);
  const bool over = state.phase >= RunPhase::kEnded;
  const bool clock_silent = !over && clock_silent_s > kClockSilent_s;
  if (clock_silent) {
    status.set_text("has not been heard for " + std::to_string(static_cast<int>(clock_silent_s)) + " s");
    status.set_culprit(std::string(kClockRole));
  }
  // While a run forms, `text` lists who is missing.
  const std::string missing = state.phase == RunPhase::kForming ? " " + state.text + " " : "";
  const auto add = [&](const std::string& role, bool alive) {
    Member& member = *status.add_members();
    member.set_role(role);
    member.set_alive(alive && state.culprit != role && missing.find(" " + role + " ") == std::string::npos);
  };
  add(std::string(kClockRole), !clock_silent);
  for (const std::string& role : roles_of_a_run(rsus)) {
    const int rsu = rsu_index(role);
    const bool silent = rsu >= 0 && static_cast<std::size_t>(rsu) < rsus_heard.size() &&
                        rsus_heard[static_cast<std::size_t>(rsu)] == 0 && state.recorded > 0;
    add(role, !silent);
  }
  return status;
}

}  // namespace lukou::console
