#pragma once

#include <filesystem>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"

namespace lukou::run_log {

/// Makes a run log that was cut off whole again: its last chunk is the last whole one that goes no further than step
/// `last`, and it gets an end. One in which not even the head is whole is taken away. Errors: the disk.
Expected<Done> repair(const std::filesystem::path& file, Step last);

}  // namespace lukou::run_log
