#pragma once

#include "services/lukou/study/findings.hpp"
#include "services/lukou/study/study_folder.hpp"

namespace lukou::studies {

inline constexpr const char* kDatabase = "study.sqlite";

/// Everything that a study knows, for the files beside its folder.
struct Outcome {
  Gathered gathered;
  Analysis analysis;
  std::vector<Sentence> findings;
  std::vector<Sentence> warnings;
};

/// Reads a study's folder and judges it.
Expected<Outcome> outcome_of(const StudyFolder& folder);

/// Writes study.sqlite anew, whole or not at all. It holds no fact of the wall clock: the same results give the same
/// content, however they came about. docs/studies.md has its tables.
Expected<Done> write_database(const StudyFolder& folder, const Outcome& outcome);

/// Writes runs.csv, estimates.csv, comparisons.csv and sha256.txt.
Expected<Done> write_tables(const StudyFolder& folder, const Outcome& outcome);

}  // namespace lukou::studies
