#include "common/scenario/arrivals.hpp"

#include <charconv>
#include <cmath>
#include <string_view>

#include "common/scenario/scenario.hpp"
#include "common/scenario/wording.hpp"

namespace lukou::scenario {
namespace {

constexpr std::string_view kHeader = "time_s,approach";

struct Row {
  double time_s = 0.0;
  Approach approach{};
};

Expected<Row> row_of(std::string_view line, const std::string& line_place) {
  const auto at_column = [&](std::size_t offset) { return line_place + ":" + std::to_string(offset + 1); };
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos || line.find(',', comma + 1) != std::string_view::npos) {
    return Error{at_column(0), "a row has two columns, time_s,approach"};
  }
  const std::string_view time = line.substr(0, comma);
  Row row;
  const auto number = std::from_chars(time.data(), time.data() + time.size(), row.time_s);
  if (number.ec != std::errc{} || number.ptr != time.data() + time.size() || !std::isfinite(row.time_s)) {
    return Error{at_column(0), "time_s is `" + std::string(time) + "`, must be a number of seconds"};
  }
  if (row.time_s < 0.0) return Error{at_column(0), "time_s is " + number_text(row.time_s) + " s, must be at least 0 s"};
  const std::string_view name = line.substr(comma + 1);
  const auto approach = approach_named(name);
  if (!approach) {
    return Error{at_column(comma + 1), "approach is `" + std::string(name) + "`, must be west, south, east or north"};
  }
  row.approach = *approach;
  return row;
}

std::string_view without_return(std::string_view line) {
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

}  // namespace

const Demand& demand_of(const Scenario& scenario, Approach approach) {
  switch (approach) {
    case Approach::kWest:
      return scenario.traffic().west();
    case Approach::kSouth:
      return scenario.traffic().south();
    case Approach::kEast:
      return scenario.traffic().east();
    case Approach::kNorth:
      break;
  }
  return scenario.traffic().north();
}

FieldPath demand_path(Approach approach) { return extended(path_to({"traffic"}), std::string(name(approach)).c_str()); }

Expected<std::vector<double>> read_arrivals(const std::string& file, Approach approach) {
  const auto content = read_file(file);
  if (!content) return content.error();
  std::string_view rest = content.value();
  std::vector<double> times_s;
  double last_s = 0.0;
  for (std::size_t number = 1; !rest.empty() || number == 1; ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = without_return(rest.substr(0, end));
    rest = rest.substr(std::min(end + 1, rest.size()));
    const std::string place = file + ":" + std::to_string(number);
    if (number == 1) {
      if (line == kHeader) continue;
      return Error{place + ":1", "the first line must be " + std::string(kHeader)};
    }
    const auto row = row_of(line, place);
    if (!row) return row.error();
    if (row.value().time_s < last_s) {
      return Error{place + ":1", "time_s is " + number_text(row.value().time_s) +
                                     " s, must not be before the row above, " + number_text(last_s) + " s"};
    }
    last_s = row.value().time_s;
    if (row.value().approach == approach) times_s.push_back(last_s);
  }
  return times_s;
}

Expected<std::vector<double>> arrivals(const Resolved& scenario, Approach approach) {
  const Demand& demand = demand_of(scenario.message(), approach);
  if (!demand.has_arrivals_csv()) return std::vector<double>{};
  return read_arrivals(demand.arrivals_csv(), approach);
}

}  // namespace lukou::scenario
