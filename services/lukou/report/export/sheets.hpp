#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "common/core/expected.hpp"

namespace lukou::report {

/// The sheets that CSV and SQLite hold; docs/export.md is their dictionary.
enum class SheetId : std::uint8_t { kRun, kCars, kTrajectories, kSignals, kMessages, kReceptions, kAdvice };
inline constexpr std::size_t kSheets = 7;

enum class CellKind : std::uint8_t { kWhole, kReal, kText };
struct Column {
  std::string_view name;  ///< with its unit
  CellKind kind = CellKind::kReal;
};
struct Sheet {
  std::string_view name;
  std::span<const Column> columns;
};
const Sheet& sheet(SheetId id);

/// Empty: not known, or there is none. A text must live until the row is written.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string_view>;
/// Not a number becomes empty.
Cell real(double value);

/// Where rows go.
class SheetSink {
 public:
  virtual ~SheetSink() = default;
  /// Before the rows of a sheet; a sheet that has none is opened, too.
  virtual Expected<Done> open(SheetId id) = 0;
  /// Requires as many cells as the sheet has columns.
  virtual Expected<Done> row(SheetId id, std::span<const Cell> cells) = 0;
  /// Makes everything visible under its name. Without it nothing is left.
  virtual Expected<Done> finish() = 0;
};

}  // namespace lukou::report
