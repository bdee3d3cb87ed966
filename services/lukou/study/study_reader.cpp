#include "services/lukou/study/study_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "common/scenario/text_file.hpp"
#include "common/scenario/wording.hpp"
#include "services/lukou/study/measure.hpp"
#include "study.pb.h"

namespace lukou::studies {
namespace {

using scenario::FieldPath;
using scenario::LabelledSet;
using scenario::number_text;
using scenario::TextFile;

/// The field of that name in the message type at the end of `path`, or in a study.
FieldPath field(const FieldPath& path, const char* name, int index = -1) {
  const auto* type = path.empty() ? study::Study::descriptor() : path.back().field->message_type();
  return scenario::extended(path, type->FindFieldByName(name), index);
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
                              std::string::npos;
}

/// The units of the scenario's fields, by path without indices.
std::string unit_of(const std::string& path) {
  std::string plain;
  bool inside = false;
  for (const char c : path) {
    if (c == ']') inside = false;
    if (!inside) plain += c;
    if (c == '[') inside = true;
  }
  for (const scenario::FieldDoc& doc : scenario::field_docs())
    if (doc.path == plain) return doc.unit;
  return "";
}

/// A number as a person means it: 0.1 three times is 0.3.
double ten_digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return std::strtod(text.data(), nullptr);
}

/// The values of a range, or what is wrong with it.
Expected<std::vector<double>> values_of(const study::Range& range) {
  std::vector<double> values;
  if ((range.step() != 0.0) == (range.count() != 0)) return Error{"", "needs a step or a count, and not both"};
  if (range.logarithmic() && (range.count() == 0 || range.from() <= 0.0 || range.to() <= 0.0)) {
    return Error{"", "is logarithmic, so it needs a count, and both ends above 0"};
  }
  if (range.count() == 1) return Error{"", "has a count of 1, must be at least 2: both ends are among them"};
  if (range.count() > 0) {
    const double last = range.count() - 1.0;
    for (std::uint32_t i = 0; i < range.count(); ++i) {
      const double share = i / last;
      values.push_back(range.logarithmic() ? range.from() * std::pow(range.to() / range.from(), share)
                                           : range.from() + (range.to() - range.from()) * share);
    }
    return values;
  }
  const double steps = (range.to() - range.from()) / range.step();
  if (!(steps >= 0.0) || steps > 1000.0) {
    return Error{"", "of " + number_text(range.from()) + " to " + number_text(range.to()) + " in steps of " +
                         number_text(range.step()) + " must have 1 to 1001 values"};
  }
  // A step that ends just short of `to` by rounding counts as ending there.
  const auto count = static_cast<int>(std::floor(steps + 1e-9)) + 1;
  for (int i = 0; i < count; ++i) values.push_back(range.from() + i * range.step());
  return values;
}

/// Takes a parsed study apart and remembers what is wrong.
class Reader {
 public:
  Reader(const study::Study& message, const TextFile& file, std::size_t sets_of_file)
      : message_(message), file_(file), sets_of_file_(sets_of_file) {}

  Study read() {
    Study study;
    study.name = message_.name();
    study.title = message_.title();
    study.first_seed = message_.seeds().first();
    study.seeds = message_.seeds().count();
    study.processes = message_.mode() == study::PROCESSES;
    study.confidence = message_.confidence();
    study.stall_limit_s = message_.stall_limit_s();
    for (const int overlay : message_.overlays()) {
      study.overlays.push_back(overlay == study::HCM ? Overlay::kHcm : Overlay::kWebster);
    }
    if (!is_plain_name(study.name)) {
      add(field({}, "name"), "is `" + study.name + "`, must be letters, digits, `_` and `-`");
    }
    for (int i = 0; i < message_.set_size(); ++i) {
      const bool added = static_cast<std::size_t>(i) >= sets_of_file_;
      study.sets.push_back(added ? LabelledSet{message_.set(i), "--set " + message_.set(i)}
                                 : setting(field({}, "set", i), message_.set(i)));
    }
    arms(study);
    grids(study);
    measures(study);
    names_used(study);
    return study;
  }

  [[nodiscard]] const std::vector<scenario::Finding>& findings() const { return findings_; }

 private:
  void add(const FieldPath& path, const std::string& what) {
    findings_.push_back({path, {}, scenario::text(path) + " " + what, ""});
  }

  LabelledSet setting(const FieldPath& path, const std::string& set) {
    if (set.starts_with("run.seed=")) add(path, "sets run.seed; the study's seeds do that");
    return {set, file_.where(path) + ": " + set};
  }

  void arms(Study& study) {
    for (int i = 0; i < message_.algorithms_size(); ++i) {
      const std::string& name = message_.algorithms(i);
      study.arms.push_back({name, {setting(field({}, "algorithms", i), "rsus[0].algorithm=" + name)}, {}});
    }
    for (int i = 0; i < message_.arms_size(); ++i) {
      const FieldPath path = field({}, "arms", i);
      const study::Arm& said = message_.arms(i);
      Arm arm{.name = said.name(), .sets = {}, .ignores = {said.ignores().begin(), said.ignores().end()}};
      for (int s = 0; s < said.set_size(); ++s) arm.sets.push_back(setting(field(path, "set", s), said.set(s)));
      if (arm.name.empty()) add(field(path, "name"), "is empty");
      study.arms.push_back(std::move(arm));
    }
    if (study.arms.empty()) study.arms.push_back({"base", {}, {}});
    for (std::size_t i = 0; i < study.arms.size(); ++i) {
      const auto same = [&](const Arm& arm) { return arm.name == study.arms[i].name; };
      if (std::find_if(study.arms.begin(), study.arms.begin() + static_cast<std::ptrdiff_t>(i), same) !=
          study.arms.begin() + static_cast<std::ptrdiff_t>(i)) {
        add(field({}, "arms"), "has two arms called `" + study.arms[i].name + "`");
      }
      if (study.arms[i].name == message_.baseline()) study.baseline = i;
    }
    if (!message_.baseline().empty() && !study.baseline) {
      std::vector<std::string> names;
      for (const Arm& arm : study.arms) names.push_back(arm.name);
      add(field({}, "baseline"),
          "is `" + message_.baseline() + "`, no arm of this study" + scenario::suggestion(message_.baseline(), names));
    }
  }

  void grids(Study& study) {
    for (int g = 0; g < message_.grids_size(); ++g) {
      const study::Grid& said = message_.grids(g);
      const FieldPath path = field({}, "grids", g);
      Grid grid{.name = said.name(), .factors = {}};
      for (int f = 0; f < said.factors_size(); ++f) {
        const FieldPath of_factor = field(path, "factors", f);
        Factor factor = factor_of(said.factors(f), of_factor);
        const auto same = [&](const Factor& other) { return other.name == factor.name; };
        if (std::ranges::any_of(grid.factors, same)) add(of_factor, "is the second called `" + factor.name + "`");
        grid.factors.push_back(std::move(factor));
      }
      study.grids.push_back(std::move(grid));
    }
    if (study.grids.empty()) study.grids.emplace_back();
  }

  Factor factor_of(const study::Factor& said, const FieldPath& path) {
    Factor factor{.name = said.name(), .unit = said.unit(), .levels = {}};
    const int kinds = (said.values_size() > 0 ? 1 : 0) + (said.has_range() ? 1 : 0) + (said.words_size() > 0 ? 1 : 0) +
                      (said.levels_size() > 0 ? 1 : 0);
    if (kinds != 1) {
      add(path, std::string(kinds == 0 ? "has no values" : "has values of two kinds") +
                    "; give one of values, range, words and levels");
      return factor;
    }
    if ((said.paths_size() == 0) != (said.levels_size() > 0)) {
      add(field(path, "paths"), said.levels_size() > 0 ? "does not go with levels, which name what they set"
                                                       : "is empty; it takes the fields that get the values");
      return factor;
    }
    if (factor.unit.empty() && said.paths_size() > 0) factor.unit = unit_of(said.paths(0));
    for (int i = 0; i < said.values_size(); ++i) add_number(factor, said, said.values(i), field(path, "values", i));
    if (said.has_range()) {
      const FieldPath of_range = field(path, "range");
      const auto values = values_of(said.range());
      if (!values) add(of_range, values.error().what);
      if (values)
        for (const double value : values.value()) add_number(factor, said, value, of_range);
    }
    for (int i = 0; i < said.words_size(); ++i) {
      add_level(factor, said, {said.words(i), std::nullopt, {}}, field(path, "words", i));
    }
    for (int i = 0; i < said.levels_size(); ++i) {
      const FieldPath of_level = field(path, "levels", i);
      Level level{said.levels(i).name(), std::nullopt, {}};
      for (int s = 0; s < said.levels(i).set_size(); ++s) {
        level.sets.push_back(setting(field(of_level, "set", s), said.levels(i).set(s)));
      }
      add_level(factor, said, std::move(level), of_level);
    }
    return factor;
  }

  void add_number(Factor& factor, const study::Factor& said, double value, const FieldPath& path) {
    if (!std::isfinite(value)) return add(path, "is no finite number");
    const double rounded = ten_digits(value);
    add_level(factor, said, {number_text(rounded), rounded, {}}, path);
  }

  void add_level(Factor& factor, const study::Factor& said, Level level, const FieldPath& path) {
    for (const std::string& field_path : said.paths())
      level.sets.push_back(setting(path, field_path + "=" + level.text));
    const auto same = [&](const Level& other) { return other.text == level.text; };
    if (std::ranges::any_of(factor.levels, same)) add(path, "has the value `" + level.text + "` a second time");
    factor.levels.push_back(std::move(level));
  }

  void measures(Study& study) {
    const std::vector<std::string> known = known_measures();
    study.measures = {message_.measures().begin(), message_.measures().end()};
    for (int i = 0; i < message_.measures_size(); ++i) {
      const std::string& measure = message_.measures(i);
      if (std::ranges::find(known, measure) != known.end()) continue;
      const auto meant = scenario::nearest(measure, known);
      add(field({}, "measures", i), "is `" + measure + "`, no number of summary.json" +
                                        (meant ? "; did you mean `" + *meant + "`?" : "; docs/results.md lists them"));
    }
    if (study.measures.empty()) study.measures = default_measures();
    if (message_.has_precision()) {
      const study::Precision& said = message_.precision();
      study.precision = {said.measure(), said.half_width(), said.at_most()};
      if (std::ranges::find(study.measures, said.measure()) == study.measures.end()) {
        add(field(field({}, "precision"), "measure"), "is `" + said.measure() + "`, none of the study's measures");
      }
      if (said.at_most() < study.seeds) {
        add(field(field({}, "precision"), "at_most"), "is " + std::to_string(said.at_most()) +
                                                          " seeds, must be at least seeds.count, " +
                                                          std::to_string(study.seeds));
      }
    }
    const std::vector<std::string> tables = names_of_tables();
    study.keep = {message_.keep().begin(), message_.keep().end()};
    for (int i = 0; i < message_.keep_size(); ++i) {
      if (study.keep[static_cast<std::size_t>(i)] == "*" ||
          std::ranges::find(tables, message_.keep(i)) != tables.end()) {
        continue;
      }
      add(field({}, "keep", i),
          "is `" + message_.keep(i) + "`, must be \"*\" or one of " + scenario::joined(tables, ", "));
    }
  }

  /// What arms ignore must be factors of some grid.
  void names_used(const Study& study) {
    std::vector<std::string> names;
    for (const Grid& grid : study.grids)
      for (const Factor& factor : grid.factors) names.push_back(factor.name);
    for (int a = 0; a < message_.arms_size(); ++a)
      for (int i = 0; i < message_.arms(a).ignores_size(); ++i) {
        const std::string& name = message_.arms(a).ignores(i);
        if (std::ranges::find(names, name) != names.end()) continue;
        add(field(field({}, "arms", a), "ignores", i), "is `" + name + "`, no factor of this study");
      }
  }

  const study::Study& message_;
  const TextFile& file_;
  std::size_t sets_of_file_;
  std::vector<scenario::Finding> findings_;
};

}  // namespace

Study plain_study(const study::Study& message, const TextFile& file, std::size_t sets_of_file,
                  std::vector<scenario::Finding>& findings) {
  Reader reader(message, file, sets_of_file);
  Study study = reader.read();
  findings.insert(findings.end(), reader.findings().begin(), reader.findings().end());
  return study;
}

}  // namespace lukou::studies
