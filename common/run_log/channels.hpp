#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lukou::run_log {

/// The channels of run.mcap; the values are their numbers in the file.
enum class Channel : std::uint16_t {
  kDirective = 1,
  kSignal = 2,
  kEvents = 3,
  kCars = 4,
  kReception = 5,
  kAir = 6,
  kRoadside = 7,
};
inline constexpr std::size_t kChannels = 7;
inline constexpr std::array<std::string_view, kChannels> kTopics = {"/directive", "/signal", "/events",  "/cars",
                                                                    "/reception", "/air",    "/roadside"};
inline constexpr std::array<std::string_view, kChannels> kTypes = {
    "lukou.record.Directive", "lukou.record.Signal", "lukou.record.Events",  "lukou.record.Cars",
    "lukou.record.Reception", "lukou.record.Air",    "lukou.record.Roadside"};

}  // namespace lukou::run_log
