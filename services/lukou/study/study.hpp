#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/scenario/scenario.hpp"

namespace lukou::studies {

using Sets = std::vector<scenario::LabelledSet>;

/// One value of a factor.
struct Level {
  std::string text;              ///< "200", "PAPER", the name that the user gave it
  std::optional<double> number;  ///< of values and ranges
  Sets sets;
};

struct Factor {
  std::string name;
  std::string unit;  ///< may be empty
  std::vector<Level> levels;

  /// Whether all of its levels are numbers.
  [[nodiscard]] bool numeric() const;
};

/// "latency 200 ms"
std::string text(const Factor& factor, std::size_t level);

/// Factors that are crossed.
struct Grid {
  std::string name;  ///< may be empty
  std::vector<Factor> factors;
};

struct Arm {
  std::string name;
  Sets sets;
  std::vector<std::string> ignores;  ///< names of factors
};

struct Precision {
  std::string measure;
  double half_width = 0.05;  ///< share of the mean
  std::uint32_t at_most = 100;
};

enum class Overlay : std::uint8_t { kWebster, kHcm };

/// A study that has been checked: every scenario that it asks for is valid.
struct Study {
  std::string name;  ///< letters, digits, - and _
  std::string title;
  std::string base_text;                 ///< of the base scenario's file
  std::string base_origin;               ///< names it in errors
  std::filesystem::path base_directory;  ///< where relative paths in it start
  Sets sets;
  std::vector<Arm> arms;  ///< at least one
  std::optional<std::size_t> baseline;
  std::vector<Grid> grids;  ///< at least one, which may have no factors
  std::uint32_t first_seed = 1;
  std::uint32_t seeds = 10;
  std::optional<Precision> precision;
  std::vector<std::string> measures;  ///< at least one, as they stand in summary.json
  bool processes = false;
  std::vector<std::string> keep;  ///< files of each run; "*": all
  double confidence = 0.95;
  double stall_limit_s = 120.0;
  std::vector<Overlay> overlays;
  /// The study whole, with every default, and `scenario: "base.textproto"`: with a file of that name and base_text
  /// beside it, it is the same study anywhere.
  std::string text;
  /// Text and base text without the number of seeds and the precision: studies that have it in common share their runs.
  std::string core;
};

/// SHA-256 of the study and its base scenario.
std::string hash(const Study& study);

/// Names of a study's files in its folder.
inline constexpr const char* kStudyFile = "study.textproto";
inline constexpr const char* kBaseFile = "base.textproto";

/// What the command line adds to a study.
struct Additions {
  std::vector<std::string> sets;  ///< path=value, after those of the study
  std::optional<std::uint32_t> seeds;
};

/// Reads a study: a file or the bare name of a shipped one. The error lists everything that is wrong, one a line, each
/// as `file:line:column: what, and what would be right`.
Expected<Study> load(const std::string& path_or_name, const Additions& additions = {});

/// Whether a file, or a bare name that is no scenario's, is meant to be a study.
bool is_study(const std::string& path_or_name);

/// What a study may keep of a run, beside "*".
std::vector<std::string> names_of_tables();

/// Every field of a study as the schema documents it.
std::vector<scenario::FieldDoc> field_docs();

}  // namespace lukou::studies
