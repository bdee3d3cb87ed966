#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lukou::scenario {

/// A number as a person writes it: 20000, 0.05. Does not depend on the locale.
std::string number_text(double value);
/// "1st", "2nd", "3rd", "4th", "11th", ...
std::string ordinal(std::size_t number);
std::string joined(const std::vector<std::string>& words, std::string_view separator);
/// The candidate with the smallest edit distance to `word`, the first of equals; none if all differ in more than half.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);
/// "; did you mean `x`?" or "; it has a, b, c"
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace lukou::scenario
