#include "services/lukou/replay/player.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/lockstep/clock_core.hpp"

namespace lukou::replay {
namespace {

std::string place(Step step) {
  return std::to_string(step) + " (" + std::to_string(step / kStepsPerSecond) + "." +
         std::to_string(step % kStepsPerSecond) + " s)";
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Step> step_in(std::string_view seconds) {
  const auto at_s = number_in(seconds);
  if (!at_s || *at_s < 0.0 || *at_s > 1e9) return std::nullopt;
  return step_at_or_after(*at_s);
}

}  // namespace

void Player::play_from(double now_s, Step step) {
  from_s_ = now_s;
  from_ = step;
}

Expected<std::string> Player::seek(double now_s, const std::string& argument) {
  const auto step = step_in(argument);
  if (!step) return Error{"seek", "`" + argument + "` is not a time; use a number of seconds of at least 0"};
  const bool held = hold_at_ != kForever;
  seek_ = std::min(*step, last_);
  if (held) hold_at_ = *seek_;
  play_from(now_s, *seek_);
  return "at step " + place(*seek_);
}

Expected<std::string> Player::request(double now_s, const std::string& text) {
  const auto space = text.find(' ');
  const std::string verb = text.substr(0, space);
  const std::string argument = space == std::string::npos ? "" : text.substr(space + 1);
  if (verb == "seek") return seek(now_s, argument);
  if (verb == "pause") {
    const auto at = argument.starts_with("at ") ? step_in(std::string_view(argument).substr(3)) : std::nullopt;
    if (!argument.empty() && !at) return Error{verb, "`" + argument + "` is not a time; use `at SECONDS`"};
    hold_at_ = std::min(std::max(at.value_or(at_), at_), last_);
    return "pauses at step " + place(hold_at_);
  }
  if (verb == "resume") {
    hold_at_ = kForever;
    play_from(now_s, seek_.value_or(at_));
    return std::string("runs");
  }
  if (verb == "step") {
    const auto count = argument.empty() ? std::optional<double>(1.0) : number_in(argument);
    if (!count || *count < 1.0 || *count > 1e9 || *count != std::floor(*count)) {
      return Error{verb, "`" + argument + "` is not a number of steps; use a whole number of at least 1"};
    }
    const Step from = hold_at_ == kForever ? at_ : hold_at_;
    hold_at_ = std::min(from + static_cast<Step>(*count), last_);
    seek_ = hold_at_;
    return "pauses at step " + place(hold_at_);
  }
  if (verb == "pace") {
    const auto pace = pace_of(argument);
    if (!pace) return pace.error();
    pace_ = pace.value();
    play_from(now_s, seek_.value_or(at_));
    return "pace " + argument;
  }
  if (verb == "stop") {
    stopped_ = true;
    return "ends at step " + place(at_);
  }
  if (verb == "set" || verb == "restart") return Error{verb, "nothing can be changed in a recording"};
  return Error{verb, "is not a request; use pause, resume, step, pace, stop or seek"};
}

Step Player::due(double now_s) const {
  if (seek_) return *seek_;
  Step step = last_;
  if (pace_ > 0.0) {
    const double played = (now_s - from_s_) * pace_ * static_cast<double>(kStepsPerSecond);
    step = from_ + static_cast<Step>(std::min(played, 1e12));
  }
  return std::min({std::max(step, at_), std::max(hold_at_, at_), last_});
}

void Player::reached(double now_s, Step step) {
  at_ = step;
  if (seek_ && step == *seek_) {
    seek_.reset();
    play_from(now_s, step);
    return;
  }
  // Who cannot keep the pace does not catch up later.
  const double behind_s = time_s(due(now_s) - step);
  if (pace_ > 0.0 && behind_s > pace_) play_from(now_s, step);
}

RunState Player::state(const std::string& run) const {
  const bool plays = hold_at_ > at_ && at_ < last_;
  return {.run = run,
          .phase = stopped_ ? RunPhase::kEnded
                   : plays  ? RunPhase::kRunning
                            : RunPhase::kPaused,
          .granted = at_,
          .recorded = at_,
          .end = last_,
          .pace = pace_};
}

}  // namespace lukou::replay
