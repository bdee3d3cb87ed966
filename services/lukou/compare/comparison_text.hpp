#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/lukou/compare/judgement.hpp"

namespace lukou::compare {

/// For people: one table of measures, or, where there are several groups, one of groups for each measure.
std::string text(const Comparison& comparison);

/// For programs: {"groups": [{"label", "measures": [{"measure", "basis", "n", "a", "b", "difference", ...}]}],
/// "warnings": [...]}. What is not known is null.
nlohmann::ordered_json json(const Comparison& comparison);

}  // namespace lukou::compare
