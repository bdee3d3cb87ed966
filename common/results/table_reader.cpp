#include "common/results/table_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>

#include "common/core/hash.hpp"

namespace lukou::results {
namespace {

constexpr std::size_t kChunkBytes = 1U << 20U;
/// A longer line is no row of ours.
constexpr std::size_t kRowBytesMax = 1U << 20U;

void split(std::string_view row, std::vector<std::string_view>& cells) {
  cells.clear();
  std::size_t from = 0;
  while (true) {
    const std::size_t to = row.find(',', from);
    cells.push_back(row.substr(from, to - from));
    if (to == std::string_view::npos) return;
    from = to + 1;
  }
}

std::optional<Step> step_of(std::string_view cell) {
  Step step = 0;
  const auto result = std::from_chars(cell.data(), cell.data() + cell.size(), step);
  if (result.ec != std::errc{} || result.ptr != cell.data() + cell.size()) return std::nullopt;
  return step;
}

/// Takes lines one by one and judges them.
class Scanner {
 public:
  explicit Scanner(const RowCheck& check) : check_(check) {}

  /// Returns false when there is nothing more to learn.
  bool take(std::string_view line) {
    if (scan.columns.empty()) {
      scan.columns = line;
      split(line, cells_);
      column_count_ = cells_.size();
    } else {
      split(line, cells_);
      if (cells_.size() != column_count_) {
        scan.wrong = "has " + std::to_string(cells_.size()) + " cells, must have " + std::to_string(column_count_);
      } else {
        scan.wrong = check_(cells_, scan.good_rows + 1);
      }
      if (!scan.wrong.empty()) return false;
      ++scan.good_rows;
    }
    scan.good_bytes += static_cast<std::int64_t>(line.size()) + 1;
    return true;
  }

  TableScan scan;

 private:
  const RowCheck& check_;
  std::vector<std::string_view> cells_;
  std::size_t column_count_ = 0;
};

Error unreadable(const std::filesystem::path& file) {
  return Error{file.string(), std::string("cannot be read: ") + std::strerror(errno)};
}

}  // namespace

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  split(line, cells);
  return cells;
}

Expected<TableScan> scan_table(const std::filesystem::path& file, const RowCheck& check) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return unreadable(file);
  Scanner scanner(check);
  std::string pending;
  std::string chunk(kChunkBytes, '\0');
  bool more = true;
  while (more && stream) {
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    pending.append(chunk, 0, static_cast<std::size_t>(stream.gcount()));
    std::size_t from = 0;
    for (std::size_t to = pending.find('\n'); more && to != std::string::npos; to = pending.find('\n', from)) {
      more = scanner.take(std::string_view(pending).substr(from, to - from));
      from = to + 1;
    }
    pending.erase(0, from);
    if (pending.size() > kRowBytesMax) break;
  }
  if (stream.bad()) return unreadable(file);
  if (more) scanner.scan.torn_bytes = static_cast<std::int64_t>(pending.size());
  return scanner.scan;
}

std::string check_step_row(const std::vector<std::string_view>& cells, std::int64_t row) {
  if (step_of(cells[0]) != row) {
    return "is of step `" + std::string(cells[0]) + "`, must be of step " + std::to_string(row);
  }
  return "";
}

std::string check_event_row(const std::vector<std::string_view>& cells, Step last, Step& before) {
  const auto step = step_of(cells[0]);
  if (!step || *step < before || *step > last) {
    return "is of step `" + std::string(cells[0]) + "`, must be of one from " + std::to_string(before) + " to " +
           std::to_string(last);
  }
  before = *step;
  return "";
}

Expected<std::string> file_sha256(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return unreadable(file);
  Sha256 hash;
  std::string chunk(kChunkBytes, '\0');
  while (stream) {
    stream.read(chunk.data(), static_cast<std::streamsize>(chunk.size()));
    hash.add(std::string_view(chunk).substr(0, static_cast<std::size_t>(stream.gcount())));
  }
  if (stream.bad()) return unreadable(file);
  return hash.hex();
}

}  // namespace lukou::results
