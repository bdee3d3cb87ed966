#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "services/lukou/report/figure/axis.hpp"
#include "services/lukou/report/figure/colour.hpp"

// Figures as a paper prints them. A figure is plain data: two axes and layers that are drawn one over the other;
// svg_of() makes SVG of it. Texts are UTF-8. Names go to the legend; a layer without one does not stand there.

namespace lukou::figure {

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// Points joined in their order. A point that is not finite interrupts the line, so that one layer may hold many.
struct Line {
  std::string name;
  std::vector<Point> points;
  int look = 0;  ///< as look_of()
  bool markers = false;
  bool steps = false;  ///< holds each value until the next point's x
  double width_pt = 1.2;
  std::optional<Colour> colour;  ///< instead of the look's, and without dashes
};

/// What lies between two lines: an interval along a curve, a range of quantiles.
struct Band {
  std::string name;
  std::vector<double> x;
  std::vector<double> low;   ///< as many as x
  std::vector<double> high;  ///< as many as x
  int look = 0;
};

/// Points by themselves.
struct Scatter {
  std::string name;
  std::vector<Point> points;
  int look = 0;
  double size_pt = 4.0;
};

/// Whiskers through a point, along y.
struct Interval {
  Point at;
  double low = 0.0;
  double high = 0.0;
};
struct Intervals {
  std::vector<Interval> intervals;
  int look = 0;
};

struct Bar {
  double at = 0.0;
  double from = 0.0;
  double to = 0.0;
};
struct Bars {
  std::string name;
  std::vector<Bar> bars;
  double width = 0.8;       ///< in units of the axis that they stand on
  bool horizontal = false;  ///< stand on the y axis
  int look = 0;
  std::optional<Colour> colour;
};

/// Filled rectangles: phases of a signal, outages, a warm-up.
struct Box {
  double x_min = 0.0;
  double x_max = 0.0;
  double y_min = 0.0;
  double y_max = 0.0;
};
struct Boxes {
  std::string name;
  std::vector<Box> boxes;
  Colour colour = kFaint;
  double opacity = 1.0;
  bool hatched = false;
};

/// A map of values: row after row from below, each from the left. A value that is not finite leaves its cell empty.
struct Cells {
  std::vector<double> x_edges;      ///< columns + 1, rising
  std::vector<double> y_edges;      ///< rows + 1, rising
  std::vector<double> values;       ///< columns * rows
  std::vector<std::string> texts;   ///< written into the cells; as many, or none
  std::vector<std::string> hovers;  ///< shown under the mouse; as many, or none
  std::vector<bool> hatched;        ///< as many, or none
  std::string hatched_name;         ///< what hatching says
  ColourScale scale;
};
/// Edges of cells over the places 0, 1, ... of an axis with names: -0.5, 0.5, ...
std::vector<double> edges_of_names(std::size_t names);

/// Lines of equal value over a grid, labelled.
struct Contours {
  std::string name;
  std::vector<double> x;       ///< of the grid's columns, rising
  std::vector<double> y;       ///< of its rows, rising
  std::vector<double> values;  ///< row after row from below; not finite: no line near it
  std::vector<double> levels;
  std::string unit;  ///< behind the number in a label: "%"
};

/// A line across the whole picture.
struct Rule {
  std::string name;
  double at = 0.0;
  bool vertical = false;
  Colour colour = kInk;
  bool dashed = true;
};

struct Note {
  enum class Anchor : std::uint8_t { kStart, kMiddle, kEnd };
  Point at;
  std::string text;
  Anchor anchor = Anchor::kStart;
  Colour colour = kInk;
};

using Layer = std::variant<Line, Band, Scatter, Intervals, Bars, Boxes, Cells, Contours, Rule, Note>;

struct Size {
  double width_mm = 85.0;
  double height_mm = 66.0;
};
inline constexpr Size kOneColumn{85.0, 66.0};
inline constexpr Size kTwoColumns{175.0, 85.0};

struct Figure {
  std::string title;
  std::string subtitle;  ///< small, below it: what is drawn, over how many runs
  Axis x;
  Axis y;
  std::vector<Layer> layers;  ///< the first is drawn first
  Size size = kOneColumn;
};

/// The figure as an SVG document: vector text, no scripts, no references, the same bytes for the same figure. Requires
/// that lists which belong together are equally long.
std::string svg_of(const Figure& figure);
/// Several figures of the same size as one document, `columns` beside each other. Requires at least one of each.
std::string svg_of(std::span<const Figure> panels, int columns);

}  // namespace lukou::figure
