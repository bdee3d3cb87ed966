#pragma once

#include <string>
#include <vector>

#include "services/lukou/study/database.hpp"

namespace lukou::studies {

/// A picture of the report.
struct Picture {
  std::string name;     ///< of its file, without ending: "map-mean_stop_time_s-1"
  std::string about;    ///< the measure's label, or what else it is about
  std::string caption;  ///< what is drawn, in a sentence or two
  std::string svg;
};

/// Every picture that a study's results allow, each kind in the order of measures and grids.
std::vector<Picture> pictures_of(const Study& study, const Plan& plan, const Outcome& outcome);

// The kinds.

/// The gain over two factors, a panel for each combination of the others: colour by size, contours, hatched where no
/// difference can be told. Without a baseline the measure itself.
std::vector<Picture> maps_of(const Study& study, const Plan& plan, const Analysis& analysis);
/// A measure over the first factor with intervals, a line for each level of the second or for each arm, and what
/// formulas say.
std::vector<Picture> curves_of(const Study& study, const Plan& plan, const Analysis& analysis);
/// Arms side by side with intervals, for grids without factors.
std::vector<Picture> bars_of(const Study& study, const Plan& plan, const Analysis& analysis);
/// Each pair of runs as a point: the baseline across, the arm up.
std::vector<Picture> scatters_of(const Study& study, const Plan& plan, const Outcome& outcome);
/// How far the mean gain, or the mean itself, moves over each factor.
std::vector<Picture> tornados_of(const Study& study, const Plan& plan, const Analysis& analysis);
/// Standing cars and the running mean stop time over time, means over the runs, with the warm-up and MSER-5's cut.
std::vector<Picture> courses_of(const Study& study, const Plan& plan, const Outcome& outcome);

}  // namespace lukou::studies
