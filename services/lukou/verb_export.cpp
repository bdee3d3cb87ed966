#include <charconv>
#include <cmath>
#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "services/lukou/report/export/csv.hpp"
#include "services/lukou/report/export/recorded_cars.hpp"
#include "services/lukou/report/export/sheet_rows.hpp"
#include "services/lukou/report/export/sqlite.hpp"
#include "services/lukou/report/export/trajectory_files.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct ExportArguments {
  std::string folder;
  std::string format;
  std::vector<std::string> what;
  std::string period;
  std::string out;
};

/// "1s", "0.5 s" and "500ms" as steps; a bare number is seconds.
Expected<Step> steps_of(const std::string& text) {
  const Error wrong{"--period " + text, "must be a multiple of 0.1 s, as in 0.1s, 500ms or 1s"};
  double value = 0.0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (code != std::errc{}) return wrong;
  const std::string_view unit(end, text.data() + text.size());
  if (unit != "" && unit != "s" && unit != "ms") return wrong;
  const double steps = (unit == "ms" ? value / 1000.0 : value) * static_cast<double>(kStepsPerSecond);
  if (!(steps > 0.5 && steps < 1e9) || std::abs(steps - std::round(steps)) > 1e-6) return wrong;
  return static_cast<Step>(std::llround(steps));
}

Expected<report::ExportWish> wish_of(const ExportArguments& arguments, const report::Result& result, bool sheets) {
  report::ExportWish wish;
  if (!sheets) {
    if (!arguments.what.empty() && arguments.what != std::vector<std::string>{"trajectories"}) {
      return Error{"--what", "is trajectories in the format " + arguments.format + "; csv and sqlite hold more"};
    }
    wish.trajectories = true;
  } else if (arguments.what.empty()) {
    auto all = report::everything(result);
    if (!all) return all;
    wish = all.value();
  }
  for (const std::string& what : arguments.what) {
    if (what == "cars") wish.cars = true;
    if (what == "trajectories") wish.trajectories = true;
    if (what == "signals") wish.signals = true;
    if (what == "messages") wish.messages = true;
    if (what == "advice") wish.advice = true;
  }
  if (arguments.period.empty()) return wish;
  if (!wish.trajectories)
    return Error{"--period " + arguments.period, "speaks of trajectories, which are not asked for"};
  const auto period = steps_of(arguments.period);
  if (!period) return period.error();
  wish.period = period.value();
  return wish;
}

std::string default_out(const std::string& name, const std::string& format) {
  if (format == "csv") return name + "-csv";
  if (format == "sqlite") return name + ".sqlite";
  if (format == "fcd") return name + ".fcd.xml";
  if (format == "ssam") return name + ".trj";
  return name + ".foxglove.mcap";
}

Expected<Done> write_sheets(const report::Result& result, const report::ExportWish& wish, Step period, bool csv,
                            const std::string& out) {
  auto sink = csv ? report::csv_folder(out) : report::sqlite_file(out);
  if (!sink) return sink.error();
  if (auto given = report::give_sheets(result, wish, period, *sink.value()); !given) return given;
  return sink.value()->finish();
}

int export_run(const ExportArguments& arguments) {
  const auto result = report::Result::open(arguments.folder);
  if (!result) return report_errors(result.error());
  const std::string& format = arguments.format;
  const bool sheets = format == "csv" || format == "sqlite";
  const auto wish = wish_of(arguments, result.value(), sheets);
  if (!wish) return report_errors(wish.error());
  const auto period = report::check_wish(result.value(), wish.value());
  if (!period) return report_errors(period.error());
  const std::string out = arguments.out.empty() ? default_out(result.value().name(), format) : arguments.out;
  const auto write = format == "fcd"    ? report::write_fcd
                     : format == "ssam" ? report::write_ssam
                                        : report::write_foxglove;
  const auto written = sheets ? write_sheets(result.value(), wish.value(), period.value(), format == "csv", out)
                              : write(result.value(), period.value(), out);
  if (!written) return report_output_error(written.error());
  std::fprintf(stderr, "%s\n", out.c_str());
  return process::kExitDone;
}

}  // namespace

Action add_export(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("export", "a run's record in the formats of other tools");
  auto arguments = std::make_shared<ExportArguments>();
  verb->add_option("result", arguments->folder, "result folder with a run.mcap")->required();
  verb->add_option("--format", arguments->format,
                   "csv (a folder), sqlite, fcd (SUMO), ssam (FHWA's .trj), foxglove (a scene as MCAP)")
      ->required()
      ->check(CLI::IsMember({"csv", "sqlite", "fcd", "ssam", "foxglove"}));
  verb->add_option("--what", arguments->what,
                   "of csv and sqlite, with commas: cars, trajectories, signals, messages, advice; default all that is "
                   "on record")
      ->delimiter(',')
      ->check(CLI::IsMember({"cars", "trajectories", "signals", "messages", "advice"}));
  verb->add_option("--period", arguments->period,
                   "between two instants of trajectories: 0.1s, 500ms, 1s; default as recorded");
  verb->add_option("--out", arguments->out, "file or folder to write; default RESULT with the format's ending");
  return [arguments] { return export_run(*arguments); };
}

}  // namespace lukou
