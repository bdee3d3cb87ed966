#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lukou {

/// Topics of the bus that members exchange; observers' topics are not part of the start barrier.
enum class Topic : std::uint8_t { kControl, kUp, kTraffic, kAir, kSignal, kRoadside, kRequest };

// Roles of a run's processes.
inline constexpr std::string_view kClockRole = "clock";
inline constexpr std::string_view kEngineRole = "traffic-engine";
inline constexpr std::string_view kControllerRole = "signal-controller";
inline constexpr std::string_view kRecorderRole = "recorder";
inline constexpr std::string_view kObserverRole = "observer";
/// "rsu0", "rsu1", ...
std::string rsu_role(std::uint32_t rsu);
/// Index of an RSU's role; -1 for any other role.
int rsu_index(std::string_view role);

/// Who must be there before step 0, the clock excepted.
std::vector<std::string> roles_of_a_run(std::uint32_t rsus);

/// The wiring of design: which role writes and which reads a topic.
bool writes(std::string_view role, Topic topic);
bool reads(std::string_view role, Topic topic);

}  // namespace lukou
