#pragma once

// Inside this room only.

#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/lane.hpp"
#include "common/scenario/schema.hpp"

namespace lukou::scenario {

/// The demand of an approach in a scenario, and the path to it.
const Demand& demand_of(const Scenario& scenario, Approach approach);
FieldPath demand_path(Approach approach);

/// Times at which cars arrive on an approach [s], in order, from a table with the columns time_s,approach. The table
/// may hold other approaches too. Times are at least 0 and never decrease. The error has no `where` if the file
/// cannot be read.
Expected<std::vector<double>> read_arrivals(const std::string& file, Approach approach);

}  // namespace lukou::scenario
