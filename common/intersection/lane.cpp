#include "common/intersection/lane.hpp"

namespace lukou {
namespace {

constexpr std::array<std::string_view, kLanes> kLaneNames = {"WL", "WC", "WR", "SL", "SC", "SR",
                                                             "EL", "EC", "ER", "NL", "NC", "NR"};
constexpr std::array<std::string_view, kApproaches> kApproachNames = {"west", "south", "east", "north"};

}  // namespace

std::string_view name(Lane lane) { return kLaneNames[index(lane)]; }

std::string_view name(Approach approach) { return kApproachNames[index(approach)]; }

std::optional<Lane> lane_named(std::string_view name) {
  for (std::size_t i = 0; i < kLaneNames.size(); ++i)
    if (kLaneNames[i] == name) return static_cast<Lane>(i);
  return std::nullopt;
}

std::optional<Approach> approach_named(std::string_view name) {
  for (std::size_t i = 0; i < kApproachNames.size(); ++i)
    if (kApproachNames[i] == name) return static_cast<Approach>(i);
  return std::nullopt;
}

}  // namespace lukou
