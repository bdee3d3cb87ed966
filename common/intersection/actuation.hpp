#pragma once

#include "common/core/step.hpp"

namespace lukou {

/// What the signal controller keeps when RSUs may ask for greens, whatever they ask for. Defaults: the scenario's.
struct Actuation {
  Step min_green = 80;   ///< steps: no green is shorter
  Step yellow = 30;      ///< steps of yellow at the end of each green
  Step all_red = 10;     ///< steps from the red of a lane to the green of one that crosses it
  Step max_wait = 1200;  ///< steps: a lane that has been red for longer comes before every request

  friend bool operator==(const Actuation&, const Actuation&) = default;
};

}  // namespace lukou
