#include "common/measures/safety_measures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou {
namespace {

/// An encounter is over when its threshold has not been met for so long, so that noise does not split it; assumed.
constexpr Step kOverAfter = 10;
/// Advice ends before or at the stop line; what it did shows at the crossing. Assumed.
constexpr Step kGuidedBefore = 100;
/// Speeds for the jerk are taken this many steps apart: 0.5 s.
constexpr Step kJerkGrid = 5;

bool is_worse(SafetyKind kind, double value, double than) {
  switch (kind) {
    case SafetyKind::kDrac:
      return value > than;
    case SafetyKind::kJerk:
      return std::abs(value) > std::abs(than);
    default:
      return value < than;
  }
}

bool in_force(std::uint8_t guidance) { return guidance == static_cast<std::uint8_t>(GuidanceState::kInForce); }

void count(SafetyCounts& counts, const Encounter& encounter) {
  ++counts.encounters[static_cast<std::size_t>(encounter.kind)];
  switch (encounter.kind) {
    case SafetyKind::kTtc:
      if (encounter.value < kTtcCritical_s) ++counts.ttc_critical;
      if (!counts.ttc_min_s || encounter.value < *counts.ttc_min_s) counts.ttc_min_s = encounter.value;
      break;
    case SafetyKind::kDrac:
      if (encounter.value >= kDracCritical_mps2) ++counts.drac_critical;
      break;
    case SafetyKind::kPet:
      if (encounter.value <= 0.0) ++counts.pet_both_inside;
      break;
    default:
      break;
  }
}

}  // namespace

SafetyCounts& SafetyCounts::operator+=(const SafetyCounts& other) {
  for (std::size_t kind = 0; kind < kSafetyKinds; ++kind) encounters[kind] += other.encounters[kind];
  ttc_critical += other.ttc_critical;
  drac_critical += other.drac_critical;
  pet_both_inside += other.pet_both_inside;
  if (other.ttc_min_s && (!ttc_min_s || *other.ttc_min_s < *ttc_min_s)) ttc_min_s = other.ttc_min_s;
  driven_steps += other.driven_steps;
  return *this;
}

SafetyMeasures::SafetyMeasures(const RoadLengths& road, double vehicle_length_m)
    : approach_m_(road.approach_m), vehicle_length_m_(vehicle_length_m), crossings_(road, vehicle_length_m) {}

SafetyMeasures::Car& SafetyMeasures::car(std::uint32_t vehicle) {
  Cars& cars = cars_[vehicle % kApproaches];
  const std::uint32_t n = vehicle / kApproaches;
  LUKOU_EXPECT(n >= cars.first && n - cars.first < cars.cars.size());
  return cars.cars[n - cars.first];
}

void SafetyMeasures::add(const TrafficBatch& batch) {
  LUKOU_EXPECT(batch.step == step_ + 1);
  step_ = batch.step;
  finished_.clear();
  add_entries(batch);
  add_following(batch);
  if (step_ % kJerkGrid == 0) add_jerks(batch);
  add_crossings(batch);
  for (const std::uint32_t vehicle : batch.left_vehicle) car(vehicle).left = true;
  end_stale();
  for (Cars& cars : cars_) {
    while (!cars.cars.empty() && cars.cars.front().left) {
      cars.cars.pop_front();
      ++cars.first;
    }
  }
}

void SafetyMeasures::add_entries(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.entered_vehicle.size(); ++i) {
    const std::uint32_t vehicle = batch.entered_vehicle[i];
    Cars& cars = cars_[vehicle % kApproaches];
    LUKOU_EXPECT(vehicle / kApproaches == cars.first + cars.cars.size());
    Car& entering = cars.cars.emplace_back();
    entering.vehicle = vehicle;
    entering.equipped = batch.entered_equipped[i] != 0;
  }
}

void SafetyMeasures::add_following(const TrafficBatch& batch) {
  std::uint64_t equipped = 0;
  std::uint64_t guided = 0;
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    if (batch.equipped[i] != 0) ++equipped;
    if (in_force(batch.guidance[i])) ++guided;
    if (batch.acceleration_mps2[i] < kHardBraking_mps2) {
      note(batch, i, SafetyKind::kHardBraking, batch.acceleration_mps2[i]);
    }
    if (i == 0 || batch.lane[i - 1] != batch.lane[i]) continue;
    const Following pair{.gap_m = batch.position_m[i - 1] - batch.position_m[i] - vehicle_length_m_,
                         .approach_mps = batch.speed_mps[i] - batch.speed_mps[i - 1],
                         .approach_mps2 = batch.acceleration_mps2[i] - batch.acceleration_mps2[i - 1]};
    if (is_ttc_encounter(pair)) note(batch, i, SafetyKind::kTtc, *time_to_collision_s(pair));
    if (is_drac_encounter(pair)) note(batch, i, SafetyKind::kDrac, *deceleration_to_avoid_crash_mps2(pair));
    if (!is_mttc_encounter(pair)) continue;
    if (const auto mttc_s = modified_time_to_collision_s(pair)) note(batch, i, SafetyKind::kMttc, *mttc_s);
  }
  equipped_.driven_steps += equipped;
  unequipped_.driven_steps += batch.vehicle.size() - equipped;
  guided_.driven_steps += guided;
}

void SafetyMeasures::add_jerks(const TrafficBatch& batch) {
  constexpr double kGrid_s = static_cast<double>(kJerkGrid) * kStep_s;
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    Car& seen = car(batch.vehicle[i]);
    const double speed_mps = batch.speed_mps[i];
    if (in_force(batch.guidance[i])) seen.guided = step_;
    if (seen.grid_points == 2) {
      const double jerk_mps3 = (speed_mps - 2.0 * seen.speed_mps[0] + seen.speed_mps[1]) / (kGrid_s * kGrid_s);
      if (std::abs(jerk_mps3) > kJerk_mps3) note(batch, i, SafetyKind::kJerk, jerk_mps3);
    } else {
      ++seen.grid_points;
    }
    seen.speed_mps = {speed_mps, seen.speed_mps[0]};
  }
}

void SafetyMeasures::note(const TrafficBatch& batch, std::size_t i, SafetyKind kind, double value) {
  Car& seen = car(batch.vehicle[i]);
  std::optional<Encounter>& lasting = seen.lasting[static_cast<std::size_t>(kind)];
  const bool alone = kind == SafetyKind::kHardBraking || kind == SafetyKind::kJerk;
  if (lasting && !alone && lasting->other != batch.vehicle[i - 1]) {
    finish(*lasting);
    lasting.reset();
  }
  const bool begins = !lasting;
  if (begins) {
    lasting = Encounter{.kind = kind,
                        .vehicle = seen.vehicle,
                        .lane = static_cast<Lane>(batch.lane[i]),
                        .equipped = seen.equipped,
                        .began = step_};
    if (!alone) {
      lasting->other = batch.vehicle[i - 1];
      lasting->other_lane = lasting->lane;
      lasting->other_equipped = batch.equipped[i - 1] != 0;
    }
    if (!seen.listed) open_.push_back(seen.vehicle);
    seen.listed = true;
  }
  lasting->last = step_;
  if (!begins && !is_worse(kind, value, lasting->value)) return;
  lasting->worst = step_;
  lasting->value = value;
  lasting->guided = in_force(batch.guidance[i]);
  lasting->distance_m = approach_m_ - batch.position_m[i];
  lasting->speed_mps = batch.speed_mps[i];
}

void SafetyMeasures::add_crossings(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    const double position_m = batch.position_m[i];
    const auto lane = static_cast<Lane>(batch.lane[i]);
    if (position_m <= approach_m_ || position_m > crossings_.end_m(lane)) continue;
    Car& seen = car(batch.vehicle[i]);
    crossings_.move({.vehicle = seen.vehicle,
                     .lane = lane,
                     .equipped = seen.equipped,
                     .guided = seen.guided >= 0 && step_ - seen.guided <= kGuidedBefore,
                     .position_m = position_m,
                     .speed_mps = batch.speed_mps[i],
                     .acceleration_mps2 = batch.acceleration_mps2[i]},
                    time_s(step_), seen.next_mark);
  }
  for (const PostEncroachment& pair : crossings_.settle()) {
    if (pair.pet_s >= kPet_s) continue;
    finish({.kind = pair.opposed_left ? SafetyKind::kPetOpposedLeft : SafetyKind::kPet,
            .vehicle = pair.second.vehicle,
            .lane = pair.second.lane,
            .equipped = pair.second.equipped,
            .other = pair.first.vehicle,
            .other_lane = pair.first.lane,
            .other_equipped = pair.first.equipped,
            .guided = pair.second.guided,
            .began = step_at_or_after(pair.entered_s - pair.pet_s),
            .last = step_,
            .worst = step_,
            .value = pair.pet_s,
            .distance_m = -pair.past_line_m,
            .speed_mps = pair.second.speed_mps});
  }
}

void SafetyMeasures::end_stale() {
  std::erase_if(open_, [&](std::uint32_t vehicle) {
    Car& seen = car(vehicle);
    bool lasts = false;
    for (std::optional<Encounter>& lasting : seen.lasting) {
      if (!lasting) continue;
      if (seen.left || step_ - lasting->last >= kOverAfter) {
        finish(*lasting);
        lasting.reset();
      } else {
        lasts = true;
      }
    }
    seen.listed = lasts;
    return !lasts;
  });
}

void SafetyMeasures::finish(Encounter encounter) {
  encounter.ended = step_;
  if (encounter.kind == SafetyKind::kPetOpposedLeft) {
    ++opposed_lefts_;
    if (encounter.value <= 0.0) ++opposed_lefts_both_inside_;
  } else {
    count(group(encounter.equipped), encounter);
    if (encounter.guided) count(guided_, encounter);
  }
  finished_.push_back(encounter);
}

std::vector<Encounter> SafetyMeasures::close() {
  finished_.clear();
  for (const std::uint32_t vehicle : std::exchange(open_, {})) {
    Car& seen = car(vehicle);
    seen.listed = false;
    for (std::optional<Encounter>& lasting : seen.lasting) {
      if (!lasting) continue;
      finish(*lasting);
      lasting.reset();
    }
  }
  return std::exchange(finished_, {});
}

SafetyFigures SafetyMeasures::figures() const {
  SafetyFigures figures{.all = equipped_,
                        .equipped = equipped_,
                        .unequipped = unequipped_,
                        .guided = guided_,
                        .opposed_lefts = opposed_lefts_,
                        .opposed_lefts_both_inside = opposed_lefts_both_inside_};
  figures.all += unequipped_;
  return figures;
}

}  // namespace lukou
