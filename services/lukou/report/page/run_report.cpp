#include "services/lukou/report/page/run_report.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "common/core/markup.hpp"
#include "services/lukou/report/page/charts.hpp"
#include "services/lukou/report/page/html.hpp"
#include "services/lukou/report/page/run_facts.hpp"
#include "services/lukou/report/plots/plot.hpp"
#include "services/lukou/report/plots/series.hpp"

namespace lukou::report {
namespace {

using html::both;
using html::element;
using Json = nlohmann::ordered_json;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The charts of a picture, if all of its panels can be charts.
Json charts_of(const Panels& english, const Panels& chinese) {
  Json charts = Json::array();
  for (std::size_t i = 0; i < english.figures.size(); ++i) {
    auto chart = chart_of(english.figures[i], chinese.figures[i]);
    if (!chart) return Json::array();
    charts.push_back(std::move(*chart));
  }
  return charts;
}

std::string picture(const std::string& svg, std::string_view language) {
  return element("div", svg, "class=\"" + std::string(language) + "\"");
}

std::string undrawn(const Plot& plot, const Error& error) {
  return element("p",
                 both({"Not drawn. It needs ", "未绘制。需要 "}) + element("code", markup_text(plot.needs)) + ".") +
         element("p", markup_text(error.text()), "class=\"muted\" lang=\"en\"");
}

/// A run that ended within its warm-up is shown from its beginning: there is nothing else.
PlotOptions options_of(const Plot& plot, const Result& result) {
  const bool warm = warmup_s(result) < end_s(result);
  return {.from_s = plot.takes_window && !warm ? std::optional(0.0) : std::nullopt};
}

}  // namespace

ChartCode load_chart_code(const std::filesystem::path& folder) {
  return {content_of(folder / "report.js"), content_of(folder / "report.css")};
}

Expected<std::string> run_report(const Result& result, const ChartCode& code, Language first) {
  const std::string name = result.name();
  html::Page page{.title = {"Lukou: " + name, "路口仿真：" + name}, .first = first};
  page.head = element("h1", both({"Lukou: run ", "路口仿真：运行 "}) + markup_text(name)) + "\n";
  page.content = warnings_section(result) + facts_section(result) + summary_section(result);
  Json charts = Json::object();
  for (const Plot& plot : plots()) {
    std::string content = element("h2", both(plot.title));
    const auto drawing = draw(plot.name, result, options_of(plot, result));
    if (drawing) {
      const Panels english = drawing.value()(Language::kEnglish);
      const Panels chinese = drawing.value()(Language::kChinese);
      Json of_plot = charts_of(english, chinese);
      const bool charted = !of_plot.empty();
      if (charted) charts[std::string(plot.name)] = std::move(of_plot);
      content += element("figure",
                         element("div", picture(svg_of(english), "en") + picture(svg_of(chinese), "zh"),
                                 charted ? "class=\"picture of-charts\"" : "class=\"picture\"") +
                             (charted ? "<div class=\"charts\"></div>" : ""),
                         "data-figure=\"" + std::string(plot.name) + "\"");
    } else {
      content += undrawn(plot, drawing.error());
    }
    page.content += element("section", content) + "\n";
  }
  page.content += record_section(result);
  page.script = code.script;
  page.style = code.style;
  page.data = Json{{"title", {{"en", page.title.en}, {"zh", page.title.zh}}}, {"charts", std::move(charts)}}.dump();
  return html::document(page);
}

}  // namespace lukou::report
