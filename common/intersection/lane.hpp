#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lukou {

/// The side that cars come from, in the order of every table.
enum class Approach : std::uint8_t { kWest = 0, kSouth = 1, kEast = 2, kNorth = 3 };
/// Where a lane leads; the lane's place on its approach, from the centre line outwards.
enum class Turn : std::uint8_t { kLeft = 0, kCenter = 1, kRight = 2 };
/// One of the twelve approach lanes: WL WC WR SL SC SR EL EC ER NL NC NR.
enum class Lane : std::uint8_t {};

inline constexpr int kApproaches = 4;
inline constexpr int kLanesPerApproach = 3;
inline constexpr int kLanes = kApproaches * kLanesPerApproach;

constexpr std::size_t index(Approach approach) { return static_cast<std::size_t>(approach); }
constexpr std::size_t index(Lane lane) { return static_cast<std::size_t>(lane); }
constexpr Lane lane_of(Approach approach, Turn turn) {
  return static_cast<Lane>(static_cast<int>(approach) * kLanesPerApproach + static_cast<int>(turn));
}
constexpr Approach approach_of(Lane lane) { return static_cast<Approach>(static_cast<int>(lane) / kLanesPerApproach); }
constexpr Turn turn_of(Lane lane) { return static_cast<Turn>(static_cast<int>(lane) % kLanesPerApproach); }

inline constexpr std::array<Approach, kApproaches> kAllApproaches = {Approach::kWest, Approach::kSouth, Approach::kEast,
                                                                     Approach::kNorth};
/// "WL" and so on.
std::string_view name(Lane lane);
/// "west" and so on, as the scenario spells them.
std::string_view name(Approach approach);
std::optional<Lane> lane_named(std::string_view name);
std::optional<Approach> approach_named(std::string_view name);

}  // namespace lukou
