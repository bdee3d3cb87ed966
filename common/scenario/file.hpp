#pragma once

// Inside this room only.

#include <cstdint>
#include <filesystem>
#include <string>

#include "common/core/expected.hpp"

namespace lukou::scenario {

/// Largest file that is read [bytes]; far above any scenario or trace.
inline constexpr std::uintmax_t kFileSizeMax = 256U << 20U;

/// The whole of a regular file. The error has no `where`.
Expected<std::string> read_file(const std::filesystem::path& file);

/// The file that a user means: a path, or the bare name of a shipped scenario.
Expected<std::filesystem::path> find_scenario(const std::string& path_or_name);

}  // namespace lukou::scenario
