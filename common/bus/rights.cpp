#include "common/bus/rights.hpp"

#include <array>
#include <utility>

#include "common/bus/samples.hpp"
#include "common/lockstep/roster.hpp"

namespace lukou::bus {

Rights rights_of(std::string_view role) {
  constexpr std::array kOfMembers = {std::pair{Topic::kControl, TopicOf<Control>::kName},
                                     std::pair{Topic::kUp, TopicOf<Up>::kName},
                                     std::pair{Topic::kTraffic, TopicOf<TrafficBatch>::kName},
                                     std::pair{Topic::kAir, TopicOf<AirBatch>::kName},
                                     std::pair{Topic::kSignal, TopicOf<SignalBatch>::kName},
                                     std::pair{Topic::kRoadside, TopicOf<RoadsideBatch>::kName},
                                     std::pair{Topic::kRequest, TopicOf<RequestBatch>::kName}};
  Rights rights;
  for (const auto& [topic, name] : kOfMembers) {
    if (writes(role, topic)) rights.publish.emplace_back(name);
    if (reads(role, topic)) rights.subscribe.emplace_back(name);
  }
  const auto picture = [&](std::string_view writer, const char* name) {
    if (role == writer) rights.publish.emplace_back(name);
    if (role == kObserverRole) rights.subscribe.emplace_back(name);
  };
  picture(kClockRole, TopicOf<RunState>::kName);
  picture(kRecorderRole, TopicOf<View>::kName);
  return rights;
}

}  // namespace lukou::bus
