#include "services/lukou/report/plots/signals.hpp"

#include <algorithm>
#include <cmath>

#include "common/intersection/signal_promise.hpp"
#include "scenario.pb.h"

namespace lukou::report {
namespace {

/// Lengthens the last span by a step, or begins a new one.
void add_step(std::vector<AspectSpan>& spans, Aspect aspect, Step step) {
  const double from_s = time_s(step);
  const double to_s = time_s(step + 1);
  if (!spans.empty() && spans.back().aspect == aspect && spans.back().to_s >= from_s - 1e-9) {
    spans.back().to_s = to_s;
  } else {
    spans.push_back({aspect, from_s, to_s});
  }
}

Expected<std::vector<AspectSpan>> from_log(run_log::RunLogReader log, Lane lane, Step from, Step to) {
  std::vector<AspectSpan> spans;
  SignalPromise promise;
  log.read_only({run_log::Channel::kSignal});
  // A batch speaks of steps some time ahead.
  log.seek(std::max<Step>(0, from - 20 * kStepsPerSecond));
  Step next = from;
  while (next <= to) {
    const auto step = log.next();
    if (!step) return step.error();
    if (step.value() == nullptr) break;
    if (!step.value()->signal) continue;
    const SignalBatch& batch = *step.value()->signal;
    if (promise.end() == 0) next = std::max(next, batch.first);
    if (!promise.extend(batch.first, batch.heads)) return Error{run_log::kRunLog, "has a gap in the signal's heads"};
    for (; next <= to && promise.covers(next); ++next) add_step(spans, promise.at(next)[index(lane)], next);
    promise.forget_before(std::min(next, promise.end()));
  }
  return spans;
}

}  // namespace

std::optional<SignalPlan> fixed_plan(const Result& result) {
  const auto& scenario = result.scenario();
  if (scenario.message().signals().has_actuation()) return std::nullopt;
  const auto of_signals = [](const Directive& directive) { return directive.set.starts_with("signals."); };
  if (std::ranges::any_of(result.directives().sets, of_signals)) return std::nullopt;
  auto plan = scenario::signal_plan(scenario);
  if (!plan) return std::nullopt;
  return std::move(plan).value();
}

Expected<std::vector<AspectSpan>> aspect_spans(const Result& result, Lane lane, const Window& window) {
  std::vector<AspectSpan> spans;
  const Step from = step_at_or_after(std::max(0.0, std::floor(window.from_s * 10.0) / 10.0));
  const Step to = step_at_or_after(window.to_s) - 1;
  if (const auto plan = fixed_plan(result)) {
    for (Step step = from; step <= to; ++step) add_step(spans, aspect_at(*plan, lane, step), step);
    return spans;
  }
  if (!result.holds(run_log::kRunLog)) return spans;
  auto log = result.run_log(run_log::Level::kEvents, "the signal's states");
  if (!log) return log.error();
  return from_log(std::move(log).value(), lane, from, to);
}

std::vector<figure::Layer> signal_strip(const std::vector<AspectSpan>& spans, double low, double high,
                                        Language language) {
  std::vector<figure::Layer> layers;
  const auto strip = [&](Aspect aspect, const Words& name, figure::Colour colour) {
    figure::Boxes boxes{.name = name.in(language), .boxes = {}, .colour = colour};
    for (const AspectSpan& span : spans) {
      if (span.aspect == aspect) boxes.boxes.push_back({span.from_s, span.to_s, low, high});
    }
    if (!boxes.boxes.empty()) layers.emplace_back(std::move(boxes));
  };
  strip(Aspect::kRed, says::kRed, figure::kRedLamp);
  strip(Aspect::kYellow, says::kYellow, figure::kYellowLamp);
  strip(Aspect::kGreen, says::kGreen, figure::kGreenLamp);
  return layers;
}

}  // namespace lukou::report
