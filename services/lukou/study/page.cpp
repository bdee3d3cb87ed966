#include "services/lukou/study/page.hpp"

#include <algorithm>

#include "common/core/markup.hpp"
#include "common/core/version.hpp"
#include "services/lukou/study/number_text.hpp"

namespace lukou::studies {
namespace {

constexpr const char* kStyle = R"(
:root { --ink: #17202a; --muted: #55616e; --line: #d5dbe1; --ground: #eef1ef; --panel: #fff; --warn: #fff3d6; }
body { margin: 0; background: var(--ground); color: var(--ink); font: 15px/1.5 Helvetica, Arial, 'Noto Sans CJK SC', sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 1.5rem; }
section { background: var(--panel); border: 1px solid var(--line); border-radius: 8px; padding: 1rem 1.25rem; margin: 1rem 0; }
h1 { font-size: 1.6rem; margin: .5rem 0; } h2 { font-size: 1.2rem; margin: 0 0 .5rem; } h3 { font-size: 1rem; margin: 1rem 0 .25rem; }
p.meta { color: var(--muted); margin: 0; } ul { margin: .25rem 0; padding-left: 1.25rem; }
section.warnings { background: var(--warn); }
figure { margin: 1rem 0; overflow-x: auto; } figure svg { max-width: 100%; height: auto; min-width: 320px; }
figure svg[width] { width: min(100%, 1060px); } figure.single svg[width] { width: min(100%, 560px); }
figcaption { color: var(--muted); font-size: .875rem; max-width: 70ch; }
table { border-collapse: collapse; font-size: .875rem; } th, td { padding: .15rem .6rem; border-bottom: 1px solid var(--line); text-align: left; }
td.number { text-align: right; font-variant-numeric: tabular-nums; } tr.unclear td { color: var(--muted); }
div.wide { overflow-x: auto; } pre { background: var(--ground); padding: .75rem; overflow-x: auto; font-size: .8rem; }
summary { cursor: pointer; }
@media print { body { background: #fff; } section { border: 0; padding: 0; } details[open] summary { display: none; } }
)";

std::string tag(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

std::string cell(const std::string& text) { return tag("td", markup_text(text)); }
std::string number(const std::string& text) { return "<td class=\"number\">" + markup_text(text) + "</td>"; }

/// "0, 200, 400 ms"
std::string levels_text(const Factor& factor) {
  std::string text;
  for (const Level& level : factor.levels) text += (text.empty() ? "" : ", ") + level.text;
  return factor.unit.empty() ? text : text + " " + factor.unit;
}

class Page {
 public:
  Page(const StudyFolder& folder, const Outcome& outcome, const std::vector<Picture>& pictures)
      : folder_(folder), study_(folder.study()), plan_(folder.plan()), outcome_(outcome), pictures_(pictures) {}

  std::string text() {
    const std::string title = study_.title.empty() ? study_.name : study_.title;
    html_ =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\">\n" +
        tag("title", markup_text(title)) + "\n<style>" + kStyle + "</style>\n</head>\n<body>\n<main>\n";
    html_ += tag("h1", markup_text(title)) + "\n<p class=\"meta\">" + markup_text(meta()) + "</p>\n";
    what_was_run();
    warnings();
    for (std::size_t measure = 0; measure < outcome_.analysis.measures.size(); ++measure) of_measure(measure);
    others("pairing", "Pairing");
    others("warm-up", "Warm-up");
    again();
    return std::move(html_) + "</main>\n</body>\n</html>\n";
  }

 private:
  [[nodiscard]] std::string meta() const {
    const auto count = [&](RunRecord::State state) { return outcome_.gathered.count(state); };
    std::string text = std::to_string(plan_.cells.size()) + (plan_.cells.size() == 1 ? " cell, " : " cells, ") +
                       std::to_string(count(RunRecord::State::kDone)) + " runs done";
    for (const auto state : {RunRecord::State::kAnomaly, RunRecord::State::kFailed, RunRecord::State::kMissing}) {
      if (count(state) > 0) text += ", " + std::to_string(count(state)) + " " + std::string(name(state));
    }
    return text + ". Unit of analysis: the run. Intervals: Student's t, " + fixed(100.0 * study_.confidence, 1) +
           " %. Lukou " + std::string(version()) + ".";
  }

  void begin(const std::string& title, const std::string& kind = "") {
    html_ += kind.empty() ? "<section>\n" : "<section class=\"" + kind + "\">\n";
    html_ += tag("h2", markup_text(title)) + "\n";
  }
  void end() { html_ += "</section>\n"; }

  void what_was_run() {
    begin("What was run");
    html_ += "<div class=\"wide\"><table>\n";
    std::string arms;
    for (std::size_t arm = 0; arm < study_.arms.size(); ++arm) {
      arms += (arms.empty() ? "" : ", ") + study_.arms[arm].name + (study_.baseline == arm ? " (baseline)" : "");
    }
    html_ += "<tr>" + cell("arms") + cell(arms) + "</tr>\n";
    for (const Grid& grid : study_.grids)
      for (const Factor& factor : grid.factors) {
        const std::string of_grid = grid.name.empty() ? "" : " (" + grid.name + ")";
        html_ += "<tr>" + cell(factor.name + of_grid) + cell(levels_text(factor)) + "</tr>\n";
      }
    std::size_t least = SIZE_MAX;
    std::size_t most = 0;
    for (const auto& runs : outcome_.gathered.points) {
      least = std::min(least, runs.size());
      most = std::max(most, runs.size());
    }
    std::string seeds = std::to_string(study_.first_seed) + " and on, " + std::to_string(least);
    if (most != least) seeds += " to " + std::to_string(most);
    html_ += "<tr>" + cell("seeds") + cell(seeds + " for each arm and cell; all arms the same ones") + "</tr>\n";
    std::string sets;
    for (const auto& set : study_.sets) sets += (sets.empty() ? "" : ", ") + set.set;
    html_ += "<tr>" + cell("for all runs") + cell(sets) + "</tr>\n</table></div>\n";
    end();
  }

  void list(const std::vector<Sentence>& sentences, const std::string& about) {
    html_ += "<ul>\n";
    for (const Sentence& sentence : sentences)
      if (about.empty() || sentence.about == about) html_ += tag("li", markup_text(sentence.text)) + "\n";
    html_ += "</ul>\n";
  }

  void warnings() {
    if (outcome_.warnings.empty()) return;
    begin("Before you believe it", "warnings");
    list(outcome_.warnings, "");
    end();
  }

  void picture(const Picture& shown) {
    const bool single = shown.svg.find("<g transform=\"translate(0 0)\">") == shown.svg.rfind("<g transform=");
    html_ += std::string("<figure") + (single ? " class=\"single\"" : "") + ">\n" + shown.svg + "<figcaption>" +
             markup_text(shown.caption) + " <a href=\"figures/" + shown.name +
             ".svg\">SVG</a></figcaption>\n</figure>\n";
  }

  void of_measure(std::size_t measure) {
    const Measure& what = outcome_.analysis.measures[measure];
    begin(title(what));
    list(outcome_.findings, what.label);
    for (const Picture& shown : pictures_)
      if (shown.about == what.label) picture(shown);
    table(measure);
    end();
  }

  /// Every comparison, or every mean where there is no baseline.
  void table(std::size_t measure) {
    html_ += "<details><summary>All numbers</summary>\n<div class=\"wide\"><table>\n";
    const std::string& unit = outcome_.analysis.measures[measure].unit;
    if (study_.baseline) {
      html_ +=
          "<tr><th>cell</th><th>arm</th><th>n</th><th>baseline</th><th>arm</th><th>difference</th><th>gain</th>"
          "<th>p (Holm)</th></tr>\n";
      for (const Comparison& found : outcome_.analysis.comparisons) {
        if (found.measure != measure) continue;
        html_ += std::string("<tr") + (found.significant ? "" : " class=\"unclear\"") + ">" +
                 cell(studies::text(study_, plan_.cells[found.cell])) + cell(study_.arms[found.arm].name) +
                 number(std::to_string(found.paired.difference.n)) + number(value_text(found.of_baseline, unit)) +
                 number(value_text(found.of_arm, unit)) + number(value_text(found.paired.difference, unit)) +
                 number(found.gain ? percent_text(*found.gain) : "") +
                 number(found.comparable ? fixed(found.p_holm, 4) : "anomaly") + "</tr>\n";
      }
    } else {
      html_ += "<tr><th>arm and cell</th><th>n</th><th>mean</th></tr>\n";
      for (std::size_t p = 0; p < plan_.points.size(); ++p) {
        const auto& found = outcome_.analysis.points[p].measures[measure];
        if (!found) continue;
        html_ += "<tr>" + cell(studies::text(study_, plan_.points[p])) + number(std::to_string(found->n)) +
                 number(value_text(*found, unit)) + "</tr>\n";
      }
    }
    html_ += "</table></div>\n</details>\n";
  }

  void others(const std::string& about, const std::string& heading) {
    const auto of_it = [&](const auto& thing) { return thing.about == about; };
    if (std::ranges::none_of(outcome_.findings, of_it) && std::ranges::none_of(pictures_, of_it)) return;
    begin(heading);
    list(outcome_.findings, about);
    for (const Picture& shown : pictures_)
      if (of_it(shown)) picture(shown);
    end();
  }

  void again() {
    begin("To have it again");
    html_ += "<pre>lukou sweep " + markup_text(folder_.path().string()) +
             " --resume   # makes what is missing\nlukou report " + markup_text(folder_.path().string()) +
             "            # judges the runs anew</pre>\n<p>" +
             markup_text(
                 "study.sqlite holds every number (table results: a row a run), runs.csv, estimates.csv and "
                 "comparisons.csv the main ones; sha256.txt the hash of every file of every run, kept or not.") +
             "</p>\n<details><summary>The study, hash " + hash(study_) + "</summary>\n<pre>" +
             markup_text(study_.text) + "</pre>\n</details>\n";
    end();
  }

  const StudyFolder& folder_;
  const Study& study_;
  const Plan& plan_;
  const Outcome& outcome_;
  const std::vector<Picture>& pictures_;
  std::string html_;
};

}  // namespace

std::string page_of(const StudyFolder& folder, const Outcome& outcome, const std::vector<Picture>& pictures) {
  return Page(folder, outcome, pictures).text();
}

}  // namespace lukou::studies
