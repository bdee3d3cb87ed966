#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lukou::results {

/// A JSON file's text: keys in the order in which they were set, two blanks of indentation, a line end. A double has
/// the fewest digits that give it back; one that is not finite becomes null. Text that is not UTF-8 is replaced, not
/// fatal.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace lukou::results
