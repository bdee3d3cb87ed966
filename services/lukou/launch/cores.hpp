#pragma once

#include <vector>

namespace lukou::launch {

/// Processors that this process may use, in order.
std::vector<int> usable_cores();

/// Keeps this process and what it starts to one processor.
void stay_on(int core);

}  // namespace lukou::launch
