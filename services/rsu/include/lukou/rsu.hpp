#pragma once

// All that a program needs which is an RSU of its own: docs/sdk.md. Link `Lukou::rsu`.

#include "services/rsu/process/run_rsu.hpp"
#include "services/rsu/sdk/arrival.hpp"
#include "services/rsu/sdk/planning.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"
#include "services/rsu/sdk/seen_cars.hpp"
