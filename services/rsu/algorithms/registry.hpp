#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "services/rsu/algorithms/arrive_on_green.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

/// The parameters of every algorithm that ships with Lukou.
struct AlgorithmParameters {
  ArriveOnGreenParameters arrive_on_green;
};

/// Names of the algorithms, in the order of the alphabet.
std::vector<std::string_view> algorithm_names();

/// Makes the algorithm of that name; for an unknown one the error says which exist, and the nearest.
Expected<std::unique_ptr<RsuAlgorithm>> make_algorithm(std::string_view name, const AlgorithmParameters& parameters);

}  // namespace lukou
