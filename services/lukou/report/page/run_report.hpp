#pragma once

#include <filesystem>
#include <string>

#include "services/lukou/report/result.hpp"
#include "services/lukou/report/words.hpp"

namespace lukou::report {

/// The console's charts, built for reports. Both are empty where the page was not built.
struct ChartCode {
  std::string script;
  std::string style;

  [[nodiscard]] bool built() const { return !script.empty(); }
};
/// From the folder that the page's build makes.
ChartCode load_chart_code(const std::filesystem::path& folder);

/// report.html of a run: one file that needs nothing else. A figure that the result's record cannot give says what to
/// record. Errors: a file of the result that is broken.
Expected<std::string> run_report(const Result& result, const ChartCode& code, Language first);

}  // namespace lukou::report
