#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "common/bus/batches.hpp"

namespace lukou {

/// What became of a car's messages to the roadside.
struct CarUplink {
  std::uint8_t newest = 255;  ///< its newest message: kFrameHeard, 1 + LossCause; 255: it has sent none
  Step heard_step = -1;       ///< when the newest one that an RSU has heard was sent; -1: none was
};

/// Which cars the roadside hears. A message is heard if one RSU hears it. Under an ideal radio (no reception report) an
/// RSU that is not silent hears every unit at once, and nobody says so.
class UplinkWatch {
 public:
  /// Takes the next step's batch.
  void add(const TrafficBatch& batch);
  /// Of one car of the newest batch.
  [[nodiscard]] CarUplink now(const TrafficBatch& newest, std::size_t car) const;

 private:
  struct Record {
    CarUplink uplink;
    Step told = -1;  ///< the step whose message `newest` speaks of
  };
  struct UnderWay {
    std::uint32_t vehicle = 0;
    Step sent = 0;
  };
  void take(std::uint32_t vehicle, Step sent);

  Step all_heard_ = -1;  ///< the newest step whose messages an RSU heard all, the radio being ideal
  std::map<std::uint32_t, Record> cars_;
  std::map<Step, std::vector<UnderWay>> due_;  ///< heard then
};

}  // namespace lukou
