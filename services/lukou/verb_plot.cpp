#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "services/lukou/report/output_file.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct PlotArguments {
  std::string folder;
  std::string figure;
  std::string out;
  std::string lane;
  std::string language = "en";
  report::PlotOptions options;
};

int plot(PlotArguments& arguments) {
  if (!arguments.lane.empty()) {
    arguments.options.lane = lane_named(arguments.lane);
    if (!arguments.options.lane) {
      return report_errors({"--lane " + arguments.lane, "is no lane; there are WL WC WR SL SC SR EL EC ER NL NC NR"});
    }
  }
  const auto result = report::Result::open(arguments.folder);
  if (!result) return report_errors(result.error());
  const auto drawing = report::draw(arguments.figure, result.value(), arguments.options);
  if (!drawing) return report_errors(drawing.error());
  const auto language = arguments.language == "zh" ? report::Language::kChinese : report::Language::kEnglish;
  const std::string out = arguments.out.empty() ? arguments.figure + ".svg" : arguments.out;
  const auto written = report::write_new_file(out, report::svg_of(drawing.value()(language)));
  if (!written) return report_output_error(written.error());
  std::fprintf(stderr, "%s\n", out.c_str());
  return process::kExitDone;
}

}  // namespace

Action add_plot(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("plot", "draws a figure of a result folder as SVG");
  auto arguments = std::make_shared<PlotArguments>();
  std::string figures;
  for (const report::Plot& known : report::plots()) {
    figures += (figures.empty() ? "" : ", ") + std::string(known.name);
  }
  verb->add_option("result", arguments->folder, "result folder")->required();
  verb->add_option("--figure", arguments->figure, "one of " + figures)->required();
  verb->add_option("--out", arguments->out, "file to write; default FIGURE.svg");
  verb->add_option("--lane", arguments->lane, "only this lane: WL ... NR");
  verb->add_option("--from", arguments->options.from_s, "from this simulated time on [s]");
  verb->add_option("--to", arguments->options.to_s, "to this simulated time [s]");
  verb->add_option("--vehicle", arguments->options.vehicle, "of this vehicle");
  verb->add_option("--lang", arguments->language, "language of its texts: en or zh")
      ->check(CLI::IsMember({"en", "zh"}));
  return [arguments] { return plot(*arguments); };
}

}  // namespace lukou
