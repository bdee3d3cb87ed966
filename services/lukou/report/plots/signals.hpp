#pragma once

#include <optional>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/signal_plan.hpp"
#include "services/lukou/report/figure/figure.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/result.hpp"

namespace lukou::report {

/// A time over which a head shows the same.
struct AspectSpan {
  Aspect aspect = Aspect::kRed;
  double from_s = 0.0;
  double to_s = 0.0;
};

/// The plan of a run in which nothing but the plan decides the heads: not actuated, and nobody has changed it.
std::optional<SignalPlan> fixed_plan(const Result& result);

/// What the head of a lane showed in that time, span after span: by the plan if it is fixed, else by the run log.
/// Empty if neither says. Errors: a run log that is broken.
Expected<std::vector<AspectSpan>> aspect_spans(const Result& result, Lane lane, const Window& window);

/// The spans as coloured strips from `low` to `high` on the y axis, each aspect with its name.
std::vector<figure::Layer> signal_strip(const std::vector<AspectSpan>& spans, double low, double high,
                                        Language language);

}  // namespace lukou::report
