#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_file.hpp"

namespace lukou::architecture {

/// "common/bus/x.cpp:12: what is wrong, and what would be right", one for each violation.
using Violations = std::vector<std::string>;

/// Includes follow the rooms: Cyclone in common/bus alone, Protobuf's headers in no shared header, no service in
/// another, each room of common/ only in rooms that may know it, models pure, the wall clock's room in mains alone.
Violations include_violations(const SourceFile& file);

/// The allowed includes among rooms of common/ agree with the order in common/CMakeLists.txt (lowest first).
Violations order_violations(const SourceFile& common_cmake);

/// Words of the code that only some places may use: clocks, sleep, threads, the environment, unkeyed randomness, the C
/// library's functions that differ between processors. `used` collects the exceptions that were needed.
Violations word_violations(const SourceFile& file, std::vector<std::string>& used);
/// Exceptions of word_violations() that no file needs any more.
Violations idle_exceptions(const std::vector<std::string>& used);

/// No work left undone, no file that is too long.
Violations form_violations(const SourceFile& file);

}  // namespace lukou::architecture
