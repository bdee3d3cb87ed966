#pragma once

#include <cstdint>

#include "common/core/step.hpp"

namespace lukou {

// Simulated time as messages carry it. Step 0 is the first instant of a year; assumed.

/// Time within the minute [ms], [0, 59999].
std::uint16_t second_mark_ms(Step step);
/// The same of a clock that is `ahead_ms` ahead, rounded to the millisecond; negative = behind. Requires |ahead_ms| <
/// 1e6.
std::uint16_t second_mark_ms(Step step, double ahead_ms);
/// Minute of the year, [0, 527039]; starts again after a year of 366 days.
std::uint32_t minute_of_year(Step step);
/// The newest step at or before `now` that may carry `mark_ms`: when a message heard at `now` was made.
/// A mark between two steps belongs to the later one. Requires mark_ms < 60000 and now >= 0.
Step step_of_second_mark(Step now, std::uint16_t mark_ms);
/// The step nearest to a mark of a clock that may be wrong: the newest at or before `now` + `ahead`. So a mark of the
/// near future is taken for what it says, not for one of a minute ago. May be negative. Requires as above, and
/// ahead in [0, 600).
Step step_near_second_mark(Step now, std::uint16_t mark_ms, Step ahead);

}  // namespace lukou
