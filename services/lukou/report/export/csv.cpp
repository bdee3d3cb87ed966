#include "services/lukou/report/export/csv.hpp"

#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "services/lukou/report/output_file.hpp"

namespace lukou::report {
namespace {

namespace fs = std::filesystem;

template <class Number>
void append(std::string& line, Number number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  line.append(digits.data(), end);
}

void append(std::string& line, const Cell& cell) {
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) {
    append(line, *whole);
  } else if (const auto* real = std::get_if<double>(&cell)) {
    append(line, *real);
  } else if (const auto* text = std::get_if<std::string_view>(&cell)) {
    line += *text;  // a name: no comma, no quote
  }
}

class CsvFolder final : public SheetSink {
 public:
  explicit CsvFolder(fs::path folder) : folder_(std::move(folder)) {}

  Expected<Done> open(SheetId id) override {
    auto file = OutputFile::create(folder_ / (std::string(sheet(id).name) + ".csv"));
    if (!file) return file.error();
    std::string line;
    for (const Column& column : sheet(id).columns) line += (line.empty() ? "" : ",") + std::string(column.name);
    auto& opened = files_[static_cast<std::size_t>(id)].emplace(std::move(file).value());
    return opened.write(line + "\n");
  }

  Expected<Done> row(SheetId id, std::span<const Cell> cells) override {
    line_.clear();
    for (const Cell& cell : cells) {
      if (&cell != cells.data()) line_ += ',';
      append(line_, cell);
    }
    line_ += '\n';
    return files_[static_cast<std::size_t>(id)]->write(line_);
  }

  Expected<Done> finish() override {
    for (auto& file : files_) {
      if (!file) continue;
      if (auto finished = file->finish(); !finished) return finished;
    }
    return Done{};
  }

 private:
  fs::path folder_;
  std::array<std::optional<OutputFile>, kSheets> files_;
  std::string line_;
};

}  // namespace

Expected<std::unique_ptr<SheetSink>> csv_folder(const fs::path& folder) {
  std::error_code code;
  if (fs::exists(folder, code) && !fs::is_empty(folder, code)) {
    return Error{folder.string(), "exists already and is not empty; name another with --out"};
  }
  return std::unique_ptr<SheetSink>(std::make_unique<CsvFolder>(folder));
}

}  // namespace lukou::report
