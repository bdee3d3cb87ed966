#pragma once

#include <string>
#include <vector>

#include "services/lukou/report/figure/figure.hpp"
#include "services/lukou/study/plan.hpp"

namespace lukou::studies {

/// A panel of a picture: some factors of a grid are drawn along its axes, the others are held.
struct Panel {
  std::string title;                ///< the held ones in words; may be empty
  std::vector<std::size_t> levels;  ///< by factor; of those that are drawn it is 0 and changes
};
/// One for each combination of the factors that do not stand among `drawn`, in the order of the cells.
std::vector<Panel> panels_of(const Grid& grid, const std::vector<std::size_t>& drawn);

/// The axis of a factor: its numbers or its names.
figure::Axis numbers_axis(const Factor& factor);
/// The axis with a place for each level, whether they are numbers or not.
figure::Axis places_axis(const Factor& factor);
/// Where a level stands on numbers_axis().
double place_of(const Factor& factor, std::size_t level);

/// A picture of one or several panels, with at most `columns` beside each other.
std::string svg_of(const std::vector<figure::Figure>& panels, int columns);

/// A text as part of a file's name: letters, digits, `_` and `-`.
std::string slug(const std::string& text);

}  // namespace lukou::studies
