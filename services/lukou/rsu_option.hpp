#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"

namespace lukou {

/// The value of an option that speaks of all RSUs ("./my_rsu") or of one ("1=./my_rsu").
struct RsuOption {
  std::optional<std::uint32_t> rsu;  ///< index in the scenario's list; empty: no number before a `=`
  std::string value;
};
RsuOption rsu_option(const std::string& text);

/// The values of an option that may be repeated: for all RSUs, and for single ones.
struct RsuOptions {
  std::string all;
  std::map<std::uint32_t, std::string> of;
};
/// Refuses two values for the same. `name`: of the option, for the error.
Expected<RsuOptions> rsu_options(const std::string& name, const std::vector<std::string>& texts);

/// What follows `rsus[0].computing=` for free, declared:20ms or real. Refuses anything else.
Expected<std::string> computing_value(const std::string& text);

}  // namespace lukou
