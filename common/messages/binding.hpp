#pragma once

#include <cstdint>

namespace lukou {

/// How a car takes a commanded acceleration; ours, outside the standard. The values stand in the message.
enum class Binding : std::uint8_t {
  kGuard = 0,      ///< used as commanded; only the limits and the guard may change it
  kFollowing = 1,  ///< the smaller of the command and the following law
};

}  // namespace lukou
