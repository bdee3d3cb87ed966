#include <cstdio>
#include <memory>

#include "common/process/environment.hpp"
#include "services/lukou/scenario_arguments.hpp"
#include "services/lukou/study/sweep.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

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

int report(const std::string& folder) {
  if (studies::StudyFolder::is_one(folder)) return report_study(folder);
  return report_errors({folder, "is no study's folder: it holds no study.textproto"});
}

}  // namespace

Action add_report(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("report", "report.html and study.sqlite of a study's runs");
  auto folder = std::make_shared<std::string>();
  verb->add_option("study", *folder, "folder of a study")->required();
  return [folder] { return report(*folder); };
}

}  // namespace lukou
