#include <deque>
#include <utility>

#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/redrive/redrive.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/rsu_node.hpp"

namespace lukou::redrive {

Expected<Done> in_process(Tape& tape, scenario::Resolved scenario, Comparison& comparison, const Listener& listener) {
  std::deque<RsuNode> rsus;
  const std::uint32_t count = scenario::protocol(scenario).rsus;
  for (std::uint32_t rsu = 0; rsu < count; ++rsu) {
    const auto config = rsu_config(scenario.message(), rsu);
    if (!config) return config.error();
    auto algorithm = make_algorithm(config.value().algorithm, config.value().parameters);
    if (!algorithm) return algorithm.error();
    rsus.emplace_back(config.value(), std::move(algorithm).value());
  }
  RoadsideBatch out;
  while (true) {
    const auto next = tape.next();
    if (!next) return next.error();
    if (next.value() == nullptr) return Done{};
    const TapeStep& got = *next.value();
    for (const Directive& directive : got.directives) {
      if (auto done = scenario::change(scenario, directive.set); !done) return done;
    }
    for (std::uint32_t rsu = 0; rsu < count; ++rsu) {
      if (!got.directives.empty()) rsus[rsu].change(rsu_config(scenario.message(), rsu).value());
      rsus[rsu].step(got.step, got.signal ? &*got.signal : nullptr, got.air, out);
      comparison.add(got, rsu, {out.frames, out.request_lanes, out.request_lifetime});
    }
    listener(got.step);
  }
}

}  // namespace lukou::redrive
