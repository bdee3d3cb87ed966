#pragma once

#include <cstdint>

#include "common/core/step.hpp"

namespace lukou {

// Simulated time as messages carry it. Step 0 is the first instant of a year; assumed.

/// Time within the minute [ms], [0, 59999].
std::uint16_t second_mark_ms(Step step);
/// Minute of the year, [0, 527039]; starts again after a year of 366 days.
std::uint32_t minute_of_year(Step step);
/// The newest step at or before `now` that may carry `mark_ms`: when a message heard at `now` was made.
/// A mark between two steps belongs to the later one. Requires mark_ms < 60000 and now >= 0.
Step step_of_second_mark(Step now, std::uint16_t mark_ms);

}  // namespace lukou
