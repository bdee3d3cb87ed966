#pragma once

#include <functional>
#include <map>
#include <string>

#include "common/core/expected.hpp"
#include "common/scenario/scenario.hpp"
#include "services/lukou/redrive/comparison.hpp"
#include "services/lukou/redrive/tape.hpp"

namespace lukou::redrive {

/// Is told the step that has been compared.
using Listener = std::function<void(Step)>;

/// Feeds the tape to the shipped algorithms that the scenario names, in this process. Errors: a broken log, an RSU that
/// cannot be made.
Expected<Done> in_process(Tape& tape, scenario::Resolved scenario, Comparison& comparison, const Listener& listener);

/// Feeds the tape over the bus to RSU programs, as engine and signal controller of a run without traffic would.
/// `commands`: by RSU; the others are not there. Errors: a broken log, DDS, a program that ends or hangs.
Expected<Done> as_processes(Tape& tape, const scenario::Resolved& scenario,
                            const std::map<std::uint32_t, std::string>& commands, Comparison& comparison,
                            const Listener& listener);

}  // namespace lukou::redrive
