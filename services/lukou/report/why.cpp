#include "services/lukou/report/why.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "common/measures/stop_cause.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/manifest.hpp"
#include "common/results/table_reader.hpp"

namespace lukou::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Cells = std::vector<std::string_view>;

/// Where the columns that are asked for stand in a table.
struct Layout {
  const char* table;
  std::string columns;
  const char* how_to_record;
  std::size_t vehicle;
  std::size_t name;                  ///< of the cause or the fate
  std::optional<std::size_t> stood;  ///< seconds; a table of advice has none
};

Layout stops_layout() {
  return {results::kStopsTable, results::stops_columns(), "--set record.stops=true (the default)", 2, 9, 8};
}
Layout guidance_layout() {
  return {results::kGuidanceTable, results::guidance_columns(), "--set record.guidance=true", 6, 9, {}};
}

struct Total {
  std::string name;
  std::uint64_t rows = 0;
  std::int64_t stood_tenths = 0;  ///< of a second
};

double number(std::string_view cell) {
  double value = 0.0;
  std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return value;
}

/// How the run went on and ended, as far as the folder says.
Json run_facts(const fs::path& folder) {
  std::ifstream stream(folder / results::kManifest, std::ios::binary);
  const std::string content((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const auto manifest = results::parse_manifest(content, results::kManifest);
  if (!manifest) return {{"complete_to_step", nullptr}, {"ended_by", nullptr}};
  return {{"complete_to_step", manifest.value().complete_to_step}, {"ended_by", manifest.value().ended_by}};
}

/// Cells as JSON: numbers as numbers, nothing as null.
Json row_json(const Cells& names, const Cells& cells) {
  Json row;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double value = 0.0;
    const auto parsed = std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), value);
    const bool whole_cell = parsed.ec == std::errc{} && parsed.ptr == cells[i].data() + cells[i].size();
    Json& cell = row[std::string(names[i])];
    if (cells[i].empty()) {
      cell = nullptr;
    } else if (!whole_cell) {
      cell = std::string(cells[i]);
    } else if (cells[i].find('.') == std::string_view::npos) {
      cell = static_cast<std::int64_t>(value);
    } else {
      cell = value;
    }
  }
  return row;
}

/// Reads a table once, prints rows as they come, and adds up.
class Answer {
 public:
  explicit Answer(const WhyQuestion& question)
      : question_(question), layout_(question.guidance ? guidance_layout() : stops_layout()) {}

  Expected<Done> run() && {
    std::error_code code;
    if (!fs::is_directory(question_.folder, code)) return Error{question_.folder.string(), "is no result folder"};
    const fs::path table = question_.folder / layout_.table;
    if (!fs::is_regular_file(table, code)) {
      return Error{question_.folder.string(), std::string("holds no ") + layout_.table +
                                                  "; record it with `lukou run " + "SCENARIO " + layout_.how_to_record +
                                                  "`"};
    }
    if (const auto known = check_name(); !known) return known;
    const Cells names = results::cells_of(layout_.columns);
    const auto first = results::scan_table(table, [](const auto&, std::int64_t) { return std::string("later"); });
    if (!first) return first.error();
    if (first.value().columns != layout_.columns) {
      return Error{table.string() + ":1", "has other columns than " + layout_.columns};
    }
    if (question_.list && !question_.json) std::printf("%s\n", layout_.columns.c_str());
    const auto scan = results::scan_table(table, [&](const Cells& cells, std::int64_t) {
      take(names, cells);
      return std::string();
    });
    if (!scan) return scan.error();
    if (!scan.value().wrong.empty()) {
      return Error{table.string() + ":" + std::to_string(scan.value().good_rows + 2), scan.value().wrong};
    }
    question_.json ? print_json() : print_totals();
    return Done{};
  }

 private:
  Expected<Done> check_name() const {
    if (question_.cause.empty()) return Done{};
    std::string names;
    const auto knows = [&](std::string_view known) {
      names += (names.empty() ? "" : ", ") + std::string(known);
      return known == question_.cause;
    };
    bool found = false;
    if (question_.guidance) {
      for (int fate = 0; fate <= static_cast<int>(AdviceFate::kLate); ++fate) {
        const bool row_of_its_own = fate != static_cast<int>(AdviceFate::kDuplicate);
        found = (row_of_its_own && knows(name(static_cast<AdviceFate>(fate)))) || found;
      }
      found = knows(kDeadlineMissed) || found;
    } else {
      for (const std::string_view cause : kStopCauseNames) found = knows(cause) || found;
    }
    if (found) return Done{};
    return Error{"--cause " + question_.cause, "is not known; there are: " + names};
  }

  void take(const Cells& names, const Cells& cells) {
    const std::string_view name = cells[layout_.name];
    if (!question_.cause.empty() && name != question_.cause) return;
    if (question_.vehicle && cells[layout_.vehicle] != std::to_string(*question_.vehicle)) return;
    auto total = std::ranges::find(totals_, name, &Total::name);
    if (total == totals_.end()) total = totals_.insert(totals_.end(), Total{std::string(name)});
    ++total->rows;
    ++rows_;
    if (layout_.stood) total->stood_tenths += std::llround(number(cells[*layout_.stood]) * 10.0);
    if (!question_.list) return;
    if (question_.json) {
      listed_.push_back(row_json(names, cells));
      return;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
      std::printf("%s%.*s", i == 0 ? "" : ",", static_cast<int>(cells[i].size()), cells[i].data());
    }
    std::putchar('\n');
  }

  /// The most frequent first; of equal ones by name.
  void sort_totals() {
    std::ranges::sort(
        totals_, [](const Total& a, const Total& b) { return a.rows != b.rows ? a.rows > b.rows : a.name < b.name; });
  }

  void print_totals() {
    sort_totals();
    if (question_.list) std::putchar('\n');
    std::printf("%-22s %10s %8s%s\n", question_.guidance ? "fate of advice" : "cause of stop", "count", "share",
                layout_.stood ? "     stood s" : "");
    Total all{"total", rows_};
    for (const Total& total : totals_) {
      print_total(total);
      all.stood_tenths += total.stood_tenths;
    }
    print_total(all);
  }

  void print_total(const Total& total) const {
    const double share = rows_ == 0 ? 0.0 : 100.0 * static_cast<double>(total.rows) / static_cast<double>(rows_);
    std::printf("%-22s %10llu %7.1f%%", total.name.c_str(), static_cast<unsigned long long>(total.rows), share);
    if (layout_.stood) std::printf(" %11.1f", static_cast<double>(total.stood_tenths) / 10.0);
    std::putchar('\n');
  }

  void print_json() {
    sort_totals();
    Json json = {{"folder", question_.folder.string()}};
    json.update(run_facts(question_.folder));
    json["rows"] = rows_;
    Json& totals = json[question_.guidance ? "by_fate" : "by_cause"] = Json::array();
    for (const Total& total : totals_) {
      Json entry = {{"name", total.name},
                    {"count", total.rows},
                    {"share", static_cast<double>(total.rows) / static_cast<double>(rows_)}};
      if (layout_.stood) entry["stood_s"] = static_cast<double>(total.stood_tenths) / 10.0;
      totals.push_back(std::move(entry));
    }
    if (question_.list) json["stops"] = listed_;
    std::printf("%s\n", json.dump().c_str());
  }

  const WhyQuestion& question_;
  Layout layout_;
  std::vector<Total> totals_;
  std::uint64_t rows_ = 0;
  Json listed_ = Json::array();
};

}  // namespace

Expected<Done> answer_why(const WhyQuestion& question) { return Answer(question).run(); }

}  // namespace lukou::report
