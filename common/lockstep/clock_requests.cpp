// What operators ask of the clock: the requests of `lukou ctl` and of the console.

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/lockstep/clock_core.hpp"

namespace lukou {
namespace {

std::string seconds_text(Step step) {
  return std::to_string(step / kStepsPerSecond) + "." + std::to_string(step % kStepsPerSecond) + " s";
}

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

Expected<double> pace_of(const std::string& text) {
  static const std::map<std::string, double> kWords = {
      {"max", 0.0}, {"very-slow", 0.1}, {"slow", 1.0}, {"medium", 10.0}, {"fast", 100.0}};
  if (const auto word = kWords.find(text); word != kWords.end()) return word->second;
  const auto value = number_in(text);
  if (value && *value > 0.0 && *value <= 1e6) return *value;
  return Error{"pace",
               "`" + text + "` is not a pace; use max, very-slow, slow, medium, fast or a factor in (0, 1000000]"};
}

Control& ClockCore::reply(const Up& request, bool ok, const std::string& text) {
  Control& reply = send(Control::Kind::kReply, request.incarnation);
  reply.number = request.number;
  reply.ok = ok;
  reply.text = text;
  return reply;
}

void ClockCore::request(double now_s, const Up& message) {
  // What an observer that comes late has missed; what is said after this answer it hears itself.
  if (message.text == "scenario") {
    add_directives_sent(reply(message, true, settings_.scenario_text));
    return;
  }
  // An operator whose reader was not matched yet missed the answer and asks again, under the same number.
  const auto answered = answers_.find(message.incarnation);
  if (answered != answers_.end() && message.number != 0 && answered->second.number == message.number) {
    reply(message, answered->second.ok, answered->second.text);
    return;
  }
  const auto space = message.text.find(' ');
  const std::string verb = message.text.substr(0, space);
  const std::string argument = space == std::string::npos ? "" : message.text.substr(space + 1);
  const auto answer = execute(now_s, verb, argument);
  const Control& said = reply(message, answer.ok(), answer ? answer.value() : answer.error().text());
  answers_[message.incarnation] = {message.number, said.ok, said.text};
  grant(now_s);
}

Expected<std::string> ClockCore::execute(double now_s, const std::string& verb, const std::string& argument) {
  if (outcome_ || phase_ == RunPhase::kEnding) return Error{verb, "the run is ending"};
  // "at 300": a simulated time for pause and stop.
  std::optional<Step> at;
  if (!argument.empty() && (verb == "pause" || verb == "stop" || verb == "interrupt")) {
    const auto at_s = argument.starts_with("at ") ? number_in(argument.substr(3)) : std::nullopt;
    if (!at_s || *at_s < 0.0 || *at_s > 1e9) return Error{verb, "`" + argument + "` is not a time; use `at SECONDS`"};
    at = std::max(step_at_or_after(*at_s), through_);
  }
  if (verb == "pause") {
    hold_at_ = at.value_or(std::max<Step>(through_, 0));
    single_steps_ = false;
    return "pauses at step " + std::to_string(hold_at_) + " (" + seconds_text(hold_at_) + ")";
  }
  if (verb == "resume") {
    hold_at_ = kNever;
    single_steps_ = false;
    pace_from_s_ = now_s;
    pace_from_step_ = std::max<Step>(through_, 0);
    return std::string("runs");
  }
  if (verb == "step") {
    const auto count = argument.empty() ? std::optional<double>(1.0) : number_in(argument);
    if (!count || *count < 1.0 || *count > 1e9 || *count != std::floor(*count)) {
      return Error{verb, "`" + argument + "` is not a number of steps; use a whole number of at least 1"};
    }
    const Step from = hold_at_ == kNever ? std::max<Step>(through_, 0) : hold_at_;
    hold_at_ = from + static_cast<Step>(*count);
    single_steps_ = true;
    return "pauses at step " + std::to_string(hold_at_) + " (" + seconds_text(hold_at_) + ")";
  }
  if (verb == "pace") {
    const auto pace = pace_of(argument);
    if (!pace) return pace.error();
    pace_ = pace.value();
    pace_from_s_ = now_s;
    pace_from_step_ = std::max<Step>(through_, 0);
    return "pace " + argument;
  }
  if (verb == "stop" || verb == "interrupt") {
    end_ = std::min(end_, at.value_or(std::max<Step>(through_, 0)));
    hold_at_ = kNever;
    single_steps_ = false;
    if (end_ < settings_.end) stopped_ = verb == "stop" ? "stopped" : "interrupted";
    return "ends at step " + std::to_string(end_) + " (" + seconds_text(end_) + ")";
  }
  if (verb == "set") return change(argument);
  return Error{verb, "is not a request; use pause, resume, step, pace, stop or set"};
}

Expected<std::string> ClockCore::change(const std::string& set) {
  if (!settings_.check_change) return Error{"set", "this run takes no changes"};
  const Step step = std::max<Step>(through_ + 1, 1);
  // Everybody takes directives in the order of their steps.
  if (!directives_.empty() && directives_.back().step > step) {
    return Error{"set", "this run replays a change at step " + std::to_string(directives_.back().step) +
                            "; it takes others from then on"};
  }
  if (auto checked = settings_.check_change(set); !checked) return checked.error();
  directives_.push_back({step, set});
  return set + " from step " + std::to_string(step) + " (" + seconds_text(step) + ")";
}

}  // namespace lukou
