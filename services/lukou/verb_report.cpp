#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "common/results/result_folder.hpp"
#include "services/lukou/home.hpp"
#include "services/lukou/report/output_file.hpp"
#include "services/lukou/report/page/run_report.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/sweep.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

struct ReportArguments {
  std::string folder;
  std::string out;  ///< empty: in the result folder
  std::string language = "en";
};

/// Judges a study's runs anew: study.sqlite, CSV, pictures, report.html.
int report_study(const std::string& folder) {
  const auto opened = studies::StudyFolder::open(folder);
  if (!opened) return report_errors(opened.error());
  const auto outcome = studies::write_report(opened.value());
  if (!outcome) {
    std::fprintf(stderr, "%s\n", outcome.error().text().c_str());
    return process::kExitIo;
  }
  for (const studies::Sentence& warning : outcome.value().warnings) {
    std::fprintf(stderr, "warning: %s\n", warning.text.c_str());
  }
  const auto page = opened.value().path() / "report.html";
  std::fprintf(stderr, "%s\n", page.c_str());
  return process::kExitDone;
}

int report_run(const ReportArguments& arguments) {
  const auto result = report::Result::open(arguments.folder);
  if (!result) return report_errors(result.error());
  const auto code = report::load_chart_code(find_home().report_page);
  if (!code.built()) {
    std::fprintf(
        stderr,
        "the charts of the page are not built (npm was missing when this was built): the report holds pictures "
        "only\n");
  }
  const auto language = arguments.language == "zh" ? report::Language::kChinese : report::Language::kEnglish;
  const auto page = report::run_report(result.value(), code, language);
  if (!page) return report_errors(page.error());
  // In the result folder it is what the folder says of itself, and made anew; elsewhere nothing is replaced.
  const bool inside = arguments.out.empty();
  const std::filesystem::path out =
      inside ? result.value().folder() / results::kReportPage : std::filesystem::path(arguments.out);
  const auto written = inside ? results::write_file(out, page.value()) : report::write_new_file(out, page.value());
  if (!written) return report_output_error(written.error());
  std::fprintf(stderr, "%s\n", out.c_str());
  return process::kExitDone;
}

}  // namespace

Action add_report(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("report", "a result folder, or a study's, as one HTML file, with all figures");
  auto arguments = std::make_shared<ReportArguments>();
  verb->add_option("result", arguments->folder, "result folder, or folder of a study")->required();
  verb->add_option("--out", arguments->out, "file to write; default report.html in the result folder");
  verb->add_option("--lang", arguments->language, "language that it opens in: en or zh; it holds both")
      ->check(CLI::IsMember({"en", "zh"}));
  return [arguments, verb] {
    if (!studies::StudyFolder::is_one(arguments->folder)) return report_run(*arguments);
    for (const char* option : {"--out", "--lang"}) {
      if (verb->count(option) > 0) {
        return report_errors({option, "is for the report of a run; a study's is in English, in the study's folder"});
      }
    }
    return report_study(arguments->folder);
  };
}

}  // namespace lukou
