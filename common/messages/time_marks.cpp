#include "common/messages/time_marks.hpp"

#include "common/core/contract.hpp"

namespace lukou {
namespace {

constexpr std::int64_t kMinute_ms = 60'000;
constexpr Step kStepsPerMinute = kMinute_ms / kStep_ms;
constexpr std::int64_t kMinutesPerYear = 527'040;  // 366 days

}  // namespace

std::uint16_t second_mark_ms(Step step) {
  LUKOU_EXPECT(step >= 0);
  return static_cast<std::uint16_t>(step % kStepsPerMinute * kStep_ms);
}

std::uint32_t minute_of_year(Step step) {
  LUKOU_EXPECT(step >= 0);
  return static_cast<std::uint32_t>(step / kStepsPerMinute % kMinutesPerYear);
}

Step step_of_second_mark(Step now, std::uint16_t mark_ms) {
  LUKOU_EXPECT(now >= 0 && mark_ms < kMinute_ms);
  const Step in_minute = (mark_ms + kStep_ms - 1) / kStep_ms;
  const Step candidate = now / kStepsPerMinute * kStepsPerMinute + in_minute;
  return candidate <= now ? candidate : candidate - kStepsPerMinute;
}

}  // namespace lukou
