#pragma once

namespace lukou {

/// Ends the program with the condition and its place. Reached only through LUKOU_EXPECT.
[[noreturn]] void contract_violated(const char* condition, const char* file, int line);

}  // namespace lukou

/// States what the caller must have made true. A violation is a bug of ours, never bad input; checked in all builds.
#define LUKOU_EXPECT(condition) \
  ((condition) ? static_cast<void>(0) : ::lukou::contract_violated(#condition, __FILE__, __LINE__))
