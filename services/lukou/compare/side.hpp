#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/lukou/study/gather.hpp"

namespace lukou::compare {

/// Runs that differ in the seed alone, as far as is known: of a study the arm in one cell.
struct Group {
  std::string label;  ///< the cell in words; empty outside of studies
  std::vector<studies::RunRecord> runs;
  std::vector<std::filesystem::path> folders;  ///< the result folder of each run
};

/// What is compared.
struct Side {
  std::string name;                   ///< as the user named it
  std::vector<std::string> measures;  ///< that it is about: a study's own, or the usual ones
  std::vector<Group> groups;          ///< with at least one run that has a result
  std::size_t failed = 0;             ///< runs of a study without a result
};

/// Reads a result folder, a folder of result folders (one a seed), or an arm of a study, `STUDY:ARM`; a study with one
/// arm needs no name. Error: it is none of these, has no result in it, holds a seed twice, or a file of it is broken.
Expected<Side> open_side(const std::string& name);

/// Gives every run the values of these measures. Error: a file that cannot be read.
Expected<Done> read_values(Side& side, const std::vector<std::string>& measures);

}  // namespace lukou::compare
