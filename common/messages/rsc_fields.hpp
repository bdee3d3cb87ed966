#pragma once

// Inside this room only: what writing and reading an RSC have in common.

#include <cstdint>

namespace lukou::rsc {

inline constexpr std::uint32_t kBindingField = 100;
inline constexpr std::uint32_t kLaneLifetimeField = 100;
inline constexpr std::uint32_t kLifetimeUnit_ms = 10;
inline constexpr std::int64_t kLifetimeMax = 65'534;

}  // namespace lukou::rsc
