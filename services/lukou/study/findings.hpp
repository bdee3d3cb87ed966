#pragma once

#include <string>
#include <vector>

#include "services/lukou/study/analysis.hpp"

namespace lukou::studies {

/// A plain sentence.
struct Sentence {
  std::string about;  ///< the measure's label, or what else it is about
  std::string text;
};

/// What the study found: for each measure, grid and arm how the arm does against the baseline along the first factor;
/// without a baseline, where the measure is least and most. Then what pairing has gained.
std::vector<Sentence> findings_of(const Study& study, const Plan& plan, const Analysis& analysis);

/// What a reader has to know before the findings are believed: runs that failed, were ended by an anomaly or are
/// missing, cars that had not left, a warm-up that was too short, intervals that are wide, and what the scenarios warn
/// of.
std::vector<Sentence> warnings_of(const Study& study, const Plan& plan, const Gathered& gathered,
                                  const Analysis& analysis);

}  // namespace lukou::studies
