#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"

namespace lukou::results {

/// What a table holds, read from front to back.
struct TableScan {
  std::string columns;          ///< first line; empty if not even that is whole
  std::int64_t good_rows = 0;   ///< rows before the first that is torn or wrong
  std::int64_t good_bytes = 0;  ///< end of the last of them
  std::int64_t torn_bytes = 0;  ///< after the last line end
  std::string wrong;            ///< what is wrong with the row after the good ones; empty if none is or if it is torn
};

/// The cells of a line, parts of it.
std::vector<std::string_view> cells_of(std::string_view line);

/// Judges a row: its cells, and its number from 1. Returns what is wrong with it, or nothing.
using RowCheck = std::function<std::string(const std::vector<std::string_view>& cells, std::int64_t row)>;

/// Reads a table until its end or the first wrong row. A row with more or fewer cells than there are columns is wrong.
/// Memory does not grow with the table.
Expected<TableScan> scan_table(const std::filesystem::path& file, const RowCheck& check);

/// Row n of a table of steps must be of step n.
std::string check_step_row(const std::vector<std::string_view>& cells, std::int64_t row);

/// A row of a table of events must be of a step not before `before`, which it moves on, and not after `last`.
std::string check_event_row(const std::vector<std::string_view>& cells, Step last, Step& before);

/// SHA-256 of a file's bytes.
Expected<std::string> file_sha256(const std::filesystem::path& file);

}  // namespace lukou::results
