#include "services/lukou/study/gather.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "services/lukou/study/measure.hpp"
#include "services/lukou/study/statistics/intervals.hpp"

namespace lukou::studies {
namespace {

using Json = nlohmann::ordered_json;

Expected<Done> read_result(const StudyFolder& folder, RunRecord& record) {
  const auto result = folder.result(record.key);
  const auto manifest = scenario::read_file(result / results::kManifest);
  if (!manifest) return manifest.error();
  auto parsed = results::parse_manifest(manifest.value(), (result / results::kManifest).string());
  if (!parsed) return parsed.error();
  record.manifest = std::move(parsed).value();
  const auto read = read_summary(result);
  if (!read) return read.error();
  const Json& summary = read.value();
  record.simulated_s = value_of(summary, "simulated_s").value_or(0.0);
  record.warmup_s = value_of(summary, "warmup_s").value_or(0.0);
  record.arrived = value_of(summary, "vehicles_arrived").value_or(0.0);
  record.left = value_of(summary, "vehicles_left").value_or(0.0);
  auto series = read_series(folder.run(record.key) / kSeriesFile);
  if (!series) return series.error();
  record.series = std::move(series).value();
  record.values = values_of(record, summary, folder.study().measures);
  return Done{};
}

Expected<RunRecord> read_run(const StudyFolder& folder, const RunKey& key) {
  RunRecord record{.key = key};
  const auto marker = folder.marker(key);
  if (!marker) return record;
  record.exit_code = marker->exit_code;
  record.what = marker->what;
  record.state = marker->failed()         ? RunRecord::State::kFailed
                 : marker->exit_code == 0 ? RunRecord::State::kDone
                                          : RunRecord::State::kAnomaly;
  if (!record.has_result()) return record;
  if (auto read = read_result(folder, record); !read) return read.error();
  return record;
}

/// Runs that were read, so that the rounds of a precision read each once.
class Reader {
 public:
  explicit Reader(const StudyFolder& folder) : folder_(folder) {}

  const RunRecord* read(const RunKey& key) {
    if (const auto known = records_.find(key); known != records_.end()) return &known->second;
    auto record = read_run(folder_, key);
    if (!record) {
      if (!error_) error_ = record.error();
      return nullptr;
    }
    return &records_.emplace(key, std::move(record).value()).first->second;
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }
  std::map<RunKey, RunRecord>& records() { return records_; }

 private:
  const StudyFolder& folder_;
  std::map<RunKey, RunRecord> records_;
  std::optional<Error> error_;
};

/// The next number of seeds for a point that has results of `seeds`; the same number if it is precise enough.
std::uint32_t next_seeds(const std::vector<double>& values, std::uint32_t seeds, const Precision& precision,
                         double confidence) {
  std::size_t needed = std::size_t{2} * seeds;
  if (values.size() >= 2) {
    const statistics::Estimate found = statistics::estimate(values, confidence);
    if (*found.half_width <= precision.half_width * std::abs(found.mean)) return seeds;
    needed = statistics::replications_needed(found, precision.half_width, confidence).value_or(needed);
  }
  // At most twice as many at once: the estimate of what is needed is itself a rough one.
  const std::size_t next = std::clamp(needed, std::size_t{seeds} + 1, std::size_t{2} * seeds);
  return static_cast<std::uint32_t>(std::min<std::size_t>(next, precision.at_most));
}

}  // namespace

Expected<Json> read_summary(const std::filesystem::path& result) {
  const auto content = scenario::read_file(result / "summary.json");
  if (!content) return content.error();
  Json summary = Json::parse(content.value(), nullptr, false);
  if (!summary.is_object()) return Error{(result / "summary.json").string(), "is no JSON object"};
  return summary;
}

std::vector<std::optional<double>> values_of(const RunRecord& run, const Json& summary,
                                             const std::vector<std::string>& measures) {
  std::vector<std::optional<double>> values;
  for (const std::string& measure : measures) {
    values.push_back(measure == kSettlingTime ? settling_time_s(run.series) : value_of(summary, measure));
  }
  return values;
}

std::string_view name(RunRecord::State state) {
  switch (state) {
    case RunRecord::State::kMissing:
      return "missing";
    case RunRecord::State::kDone:
      return "done";
    case RunRecord::State::kAnomaly:
      return "anomaly";
    case RunRecord::State::kFailed:
      return "failed";
  }
  return "";
}

std::size_t Gathered::count(RunRecord::State state) const {
  std::size_t found = 0;
  for (const auto& runs : points) found += static_cast<std::size_t>(std::ranges::count(runs, state, &RunRecord::state));
  return found;
}

std::vector<std::uint32_t> seeds_wanted(const Study& study, const Plan& plan, const ValueOfRun& value) {
  std::vector<std::uint32_t> of_cell(plan.cells.size(), study.seeds);
  const auto of_points = [&] {
    std::vector<std::uint32_t> seeds(plan.points.size(), study.seeds);
    for (std::size_t c = 0; c < plan.cells.size(); ++c)
      for (const std::size_t point : plan.cells[c].points) seeds[point] = std::max(seeds[point], of_cell[c]);
    return seeds;
  };
  for (bool grown = study.precision.has_value(); grown;) {
    grown = false;
    for (std::size_t c = 0; c < plan.cells.size(); ++c) {
      std::uint32_t wanted = of_cell[c];
      for (const std::size_t point : plan.cells[c].points) {
        std::vector<double> values;
        for (std::uint32_t i = 0; i < of_cell[c]; ++i) {
          if (const auto found = value({point, std::uint64_t{study.first_seed} + i})) values.push_back(*found);
        }
        // First what is asked for already; a run that failed does not come back.
        if (values.size() < of_cell[c]) continue;
        wanted = std::max(wanted, next_seeds(values, of_cell[c], *study.precision, study.confidence));
      }
      grown = grown || wanted > of_cell[c];
      of_cell[c] = wanted;
    }
  }
  return of_points();
}

Expected<Gathered> gather(const StudyFolder& folder) {
  const Study& study = folder.study();
  Reader reader(folder);
  std::size_t measure = 0;
  if (study.precision) {
    measure =
        static_cast<std::size_t>(std::ranges::find(study.measures, study.precision->measure) - study.measures.begin());
  }
  const auto seeds = seeds_wanted(study, folder.plan(), [&](const RunKey& run) -> std::optional<double> {
    const RunRecord* record = reader.read(run);
    return record != nullptr && record->has_result() ? record->values[measure] : std::nullopt;
  });
  Gathered gathered;
  for (std::size_t point = 0; point < seeds.size(); ++point) {
    gathered.points.emplace_back();
    for (std::uint32_t i = 0; i < seeds[point]; ++i) {
      const RunKey key{point, std::uint64_t{study.first_seed} + i};
      static_cast<void>(reader.read(key));
      if (reader.error()) return *reader.error();
      gathered.points.back().push_back(std::move(reader.records().at(key)));
    }
  }
  return gathered;
}

std::vector<RunKey> missing_runs(const Gathered& gathered) {
  std::vector<RunKey> missing;
  for (const auto& runs : gathered.points)
    for (const RunRecord& record : runs)
      if (!record.has_result()) missing.push_back(record.key);
  std::ranges::stable_sort(missing, {}, &RunKey::seed);
  return missing;
}

}  // namespace lukou::studies
