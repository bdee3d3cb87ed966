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

std::uint16_t second_mark_ms(Step step, double ahead_ms) {
  LUKOU_EXPECT(ahead_ms > -1e6 && ahead_ms < 1e6);
  const auto whole_ms = static_cast<std::int64_t>(ahead_ms < 0.0 ? ahead_ms - 0.5 : ahead_ms + 0.5);
  const std::int64_t in_minute_ms = (second_mark_ms(step) + whole_ms) % kMinute_ms;
  return static_cast<std::uint16_t>(in_minute_ms < 0 ? in_minute_ms + kMinute_ms : in_minute_ms);
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

Step step_near_second_mark(Step now, std::uint16_t mark_ms, Step ahead) {
  LUKOU_EXPECT(now >= 0 && mark_ms < kMinute_ms && ahead >= 0 && ahead < kStepsPerMinute);
  const Step newest = now + ahead;
  const Step candidate = newest / kStepsPerMinute * kStepsPerMinute + (mark_ms + kStep_ms / 2) / kStep_ms;
  return candidate <= newest ? candidate : candidate - kStepsPerMinute;
}

}  // namespace lukou
