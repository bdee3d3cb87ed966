#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"

namespace lukou::report {

/// A row of a table: the cells of the columns that were asked for, in that order.
class TableRow {
 public:
  TableRow(const std::vector<std::string_view>& cells, const std::vector<std::size_t>& places)
      : cells_(cells), places_(places) {}

  [[nodiscard]] std::string_view text(std::size_t column) const { return cells_[places_[column]]; }
  /// Not a number: the cell is empty.
  [[nodiscard]] double real(std::size_t column) const;
  /// 0: the cell is empty.
  [[nodiscard]] std::int64_t whole(std::size_t column) const;

 private:
  const std::vector<std::string_view>& cells_;
  const std::vector<std::size_t>& places_;
};

/// Reads a CSV table row by row; a last row without its line end is passed over. Errors: the file, a column that it
/// does not have, a row that is wrong, as `file:line: what`.
Expected<Done> for_each_row(const std::filesystem::path& file, const std::vector<std::string_view>& columns,
                            const std::function<void(const TableRow&)>& take);

}  // namespace lukou::report
