#include "services/lukou/study/database.hpp"

#include <algorithm>

#include "common/core/version.hpp"
#include "services/lukou/sqlite/writer.hpp"

namespace lukou::studies {
namespace {

namespace fs = std::filesystem;
using statistics::Estimate;

template <class T>
sqlite::Value sql(const std::optional<T>& value) {
  return value ? sqlite::Value(*value) : sqlite::Value();
}
sqlite::Value sql(std::size_t value) { return static_cast<std::int64_t>(value); }
sqlite::Value sql(int value) { return std::int64_t{value}; }
sqlite::Value sql(bool value) { return std::int64_t{value ? 1 : 0}; }

constexpr const char* kSchema = R"(
CREATE TABLE provenance (key TEXT PRIMARY KEY, value TEXT);
CREATE TABLE arms (arm TEXT PRIMARY KEY, is_baseline INTEGER);
CREATE TABLE points (point TEXT PRIMARY KEY, arm TEXT, runs INTEGER, anomalies INTEGER, failed INTEGER, missing INTEGER,
                     unfinished_share REAL, warmup_s REAL, mser5_cut_s REAL);
CREATE TABLE parameters (point TEXT, factor TEXT, unit TEXT, value_text TEXT, value REAL, PRIMARY KEY (point, factor));
CREATE TABLE cells (cell INTEGER, grid TEXT, name TEXT, arm TEXT, point TEXT, PRIMARY KEY (cell, arm));
CREATE TABLE runs (run TEXT PRIMARY KEY, point TEXT, seed INTEGER, state TEXT, exit_code INTEGER, ended_by TEXT,
                   simulated_s REAL, scenario_hash TEXT, lukou_version TEXT);
CREATE TABLE measure_info (measure TEXT PRIMARY KEY, label TEXT, unit TEXT, less_is_better INTEGER);
CREATE TABLE measures (run TEXT, measure TEXT, value REAL, PRIMARY KEY (run, measure));
CREATE TABLE estimates (point TEXT, measure TEXT, n INTEGER, mean REAL, deviation REAL, half_width REAL,
                        PRIMARY KEY (point, measure));
CREATE TABLE comparisons (cell INTEGER, arm TEXT, measure TEXT, n INTEGER, arm_mean REAL, baseline_mean REAL,
                          difference REAL, difference_half_width REAL, p REAL, p_holm REAL, comparable INTEGER,
                          significant INTEGER, gain REAL, gain_low REAL, gain_high REAL, correlation REAL,
                          variance_gain REAL, PRIMARY KEY (cell, arm, measure));
CREATE TABLE series (run TEXT, from_s REAL, standing_veh REAL, crossed_veh REAL, mean_stop_time_s REAL);
CREATE TABLE files (run TEXT, name TEXT, sha256 TEXT, rows INTEGER, PRIMARY KEY (run, name));
CREATE TABLE findings (number INTEGER PRIMARY KEY, about TEXT, sentence TEXT);
CREATE TABLE warnings (number INTEGER PRIMARY KEY, about TEXT, sentence TEXT);
)";

/// One row a run, with its parameters and measures side by side: what a table of a paper or a data frame begins with.
std::string wide_view(const Study& study) {
  std::string columns;
  std::vector<std::string> factors;
  for (const Grid& grid : study.grids)
    for (const Factor& factor : grid.factors) {
      if (std::ranges::find(factors, factor.name) != factors.end()) continue;
      factors.push_back(factor.name);
      const std::string column = factor.unit.empty() ? factor.name : factor.name + " [" + factor.unit + "]";
      columns += ", (SELECT coalesce(value, value_text) FROM parameters p WHERE p.point = r.point AND factor = " +
                 sqlite::text_literal(factor.name) + ") AS " + sqlite::name_literal(column);
    }
  for (const std::string& measure : study.measures) {
    columns += ", (SELECT value FROM measures m WHERE m.run = r.run AND measure = " + sqlite::text_literal(measure) +
               ") AS " + sqlite::name_literal(measure);
  }
  return "CREATE VIEW results AS SELECT r.run, p.arm, r.seed, r.state" + columns +
         " FROM runs r JOIN points p ON p.point = r.point";
}

class Filler {
 public:
  Filler(const StudyFolder& folder, const Outcome& outcome, sqlite::Writer& database)
      : study_(folder.study()), plan_(folder.plan()), outcome_(outcome), database_(database) {}

  void fill() {
    database_.execute(kSchema);
    database_.execute(wide_view(study_));
    provenance();
    for (std::size_t arm = 0; arm < study_.arms.size(); ++arm) {
      database_.insert("arms", {study_.arms[arm].name, sql(study_.baseline == arm)});
    }
    for (const Measure& measure : outcome_.analysis.measures) {
      database_.insert("measure_info", {measure.path, measure.label, measure.unit, sql(measure.less_is_better)});
    }
    for (std::size_t point = 0; point < plan_.points.size(); ++point) add_point(point);
    cells();
    for (const Comparison& found : outcome_.analysis.comparisons) comparison(found);
    sentences("findings", outcome_.findings);
    sentences("warnings", outcome_.warnings);
  }

 private:
  void provenance() {
    const auto say = [&](const char* key, const std::string& value) { database_.insert("provenance", {key, value}); };
    say("study", study_.name);
    say("title", study_.title);
    say("study_hash", hash(study_));
    say("study_text", study_.text);
    say("base_scenario", study_.base_text);
    say("lukou_version", std::string(version()));
    say("confidence", std::to_string(study_.confidence));
    say("mode", study_.processes ? "processes" : "in-process");
  }

  void add_point(std::size_t number) {
    const Point& point = plan_.points[number];
    const PointResult& found = outcome_.analysis.points[number];
    database_.insert("points",
                     {point.id, study_.arms[point.arm].name, sql(found.runs), sql(found.anomalies), sql(found.failed),
                      sql(found.missing), found.unfinished, found.warmup_s, sql(found.cut_s)});
    for (const Coordinate& at : point.coordinates) {
      database_.insert("parameters", {point.id, at.factor, at.unit, at.level.text, sql(at.level.number)});
    }
    for (std::size_t m = 0; m < found.measures.size(); ++m) {
      if (!found.measures[m]) continue;
      const Estimate& estimate = *found.measures[m];
      database_.insert("estimates", {point.id, study_.measures[m], sql(estimate.n), estimate.mean, estimate.deviation,
                                     sql(estimate.half_width)});
    }
    for (const RunRecord& run : outcome_.gathered.points[number]) add_run(point, run);
  }

  void add_run(const Point& point, const RunRecord& run) {
    const std::string id = id_of(plan_, run.key);
    const auto seed = static_cast<std::int64_t>(run.key.seed);
    const std::string state(name(run.state));
    if (!run.has_result()) {
      const bool failed = run.state == RunRecord::State::kFailed;
      const sqlite::Value code = failed ? sql(run.exit_code) : sqlite::Value();
      database_.insert("runs", {id, point.id, seed, state, code, {}, {}, {}, {}});
      return;
    }
    database_.insert("runs", {id, point.id, seed, state, sql(run.exit_code), run.manifest.ended_by, run.simulated_s,
                              run.manifest.scenario_hash, run.manifest.lukou_version});
    for (std::size_t m = 0; m < run.values.size(); ++m) {
      database_.insert("measures", {id, study_.measures[m], sql(run.values[m])});
    }
    for (const results::FileEntry& file : run.manifest.files) {
      database_.insert("files", {id, file.name, file.sha256, sql(file.rows)});
    }
    for (std::size_t i = 0; i < run.series.standing_veh.size(); ++i) {
      database_.insert("series", {id, static_cast<double>(i) * run.series.interval_s, run.series.standing_veh[i],
                                  run.series.crossed_veh[i], run.series.mean_stop_time_s[i]});
    }
  }

  void cells() {
    for (std::size_t c = 0; c < plan_.cells.size(); ++c) {
      const Cell& cell = plan_.cells[c];
      for (std::size_t arm = 0; arm < cell.points.size(); ++arm) {
        database_.insert("cells", {sql(c), study_.grids[cell.grid].name, text(study_, cell), study_.arms[arm].name,
                                   plan_.points[cell.points[arm]].id});
      }
    }
  }

  void comparison(const Comparison& found) {
    const auto of_gain = [&](double (Estimate::*end)() const) {
      return found.gain && found.gain->half_width ? sqlite::Value(((*found.gain).*end)()) : sqlite::Value();
    };
    database_.insert("comparisons",
                     {sql(found.cell), study_.arms[found.arm].name, study_.measures[found.measure],
                      sql(found.paired.difference.n), found.of_arm.mean, found.of_baseline.mean,
                      found.paired.difference.mean, sql(found.paired.difference.half_width), found.paired.p,
                      found.p_holm, sql(found.comparable), sql(found.significant),
                      found.gain ? sqlite::Value(found.gain->mean) : sqlite::Value(), of_gain(&Estimate::low),
                      of_gain(&Estimate::high), sql(found.paired.correlation), sql(found.paired.variance_gain)});
  }

  void sentences(const char* table, const std::vector<Sentence>& said) {
    for (std::size_t i = 0; i < said.size(); ++i) database_.insert(table, {sql(i + 1), said[i].about, said[i].text});
  }

  const Study& study_;
  const Plan& plan_;
  const Outcome& outcome_;
  sqlite::Writer& database_;
};

}  // namespace

Expected<Outcome> outcome_of(const StudyFolder& folder) {
  auto gathered = gather(folder);
  if (!gathered) return gathered.error();
  Outcome outcome{.gathered = std::move(gathered).value(), .analysis = {}, .findings = {}, .warnings = {}};
  outcome.analysis = analyse(folder.study(), folder.plan(), outcome.gathered);
  outcome.findings = findings_of(folder.study(), folder.plan(), outcome.analysis);
  outcome.warnings = warnings_of(folder.study(), folder.plan(), outcome.gathered, outcome.analysis);
  return outcome;
}

Expected<Done> write_database(const StudyFolder& folder, const Outcome& outcome) {
  const fs::path unfinished = folder.path() / (std::string(kDatabase) + ".unfinished");
  std::error_code code;
  fs::remove(unfinished, code);
  sqlite::Writer database(unfinished);
  Filler(folder, outcome, database).fill();
  if (auto done = database.finish(); !done) return done;
  fs::rename(unfinished, folder.path() / kDatabase, code);
  if (code) return Error{(folder.path() / kDatabase).string(), "cannot be written: " + code.message()};
  return Done{};
}

}  // namespace lukou::studies
