#include "services/lukou/report/table_rows.hpp"

#include <algorithm>
#include <charconv>
#include <limits>

#include "common/results/table_reader.hpp"

namespace lukou::report {

double TableRow::real(std::size_t column) const {
  const std::string_view cell = text(column);
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

std::int64_t TableRow::whole(std::size_t column) const {
  const std::string_view cell = text(column);
  std::int64_t value = 0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

Expected<Done> for_each_row(const std::filesystem::path& file, const std::vector<std::string_view>& columns,
                            const std::function<void(const TableRow&)>& take) {
  const auto head = results::scan_table(file, [](const auto&, std::int64_t) { return std::string("later"); });
  if (!head) return head.error();
  const auto names = results::cells_of(head.value().columns);
  std::vector<std::size_t> places;
  for (const std::string_view column : columns) {
    const auto found = std::ranges::find(names, column);
    if (found == names.end()) return Error{file.string() + ":1", "has no column " + std::string(column)};
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  const auto scan = results::scan_table(file, [&](const std::vector<std::string_view>& cells, std::int64_t) {
    take(TableRow(cells, places));
    return std::string();
  });
  if (!scan) return scan.error();
  if (scan.value().wrong.empty()) return Done{};
  return Error{file.string() + ":" + std::to_string(scan.value().good_rows + 2), scan.value().wrong};
}

}  // namespace lukou::report
