#pragma once

#include <string>

#include "services/lukou/study/statistics/intervals.hpp"

namespace lukou::studies {

/// With so many decimals; what rounds to nothing has no sign.
std::string fixed(double value, int decimals);
/// "85.1 % [84.6, 85.6]"; without brackets if there is no interval.
std::string percent_text(const statistics::Estimate& share);
/// "1.02 ± 0.03 s"
std::string value_text(const statistics::Estimate& value, const std::string& unit);

}  // namespace lukou::studies
