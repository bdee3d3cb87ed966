#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/lukou/report/figure/figure.hpp"

namespace lukou::figure {

/// A rectangle on the paper [pt], y downwards.
struct Frame {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  [[nodiscard]] double right() const { return left + width; }
  [[nodiscard]] double bottom() const { return top + height; }
};

struct Stroke {
  Colour colour = kInk;
  double width_pt = 0.6;
  std::string_view dashes;  ///< as SVG's stroke-dasharray
};

struct TextStyle {
  double size_pt = 7.0;
  Note::Anchor anchor = Note::Anchor::kStart;
  Colour colour = kInk;
  bool bold = false;
  double turn_deg = 0.0;  ///< about the anchor, clockwise
  bool halo = false;      ///< a white edge, to stand over lines
};

/// Collects the elements of an SVG document. Places are in points on the paper.
class Svg {
 public:
  void line(Point from, Point to, const Stroke& stroke);
  void polyline(std::span<const Point> points, const Stroke& stroke);
  void polygon(std::span<const Point> points, Colour fill, double opacity);
  /// `hover`: shown under the mouse; may be empty.
  void rectangle(const Frame& frame, Colour fill, double opacity = 1.0, std::string_view hover = {});
  void outline(const Frame& frame, const Stroke& stroke);
  /// Parallel lines at 45 degrees that go on in the next rectangle.
  void hatching(const Frame& frame, Colour colour);
  void marker(Point at, Marker marker, double size_pt, Colour colour);
  /// `at` is the middle of the line's height.
  void text(Point at, std::string_view text, const TextStyle& style);

  /// What follows is moved, until the matching end(). Nothing outside the frame is seen if it is clipped.
  void begin_moved(Point by);
  void begin_clipped(const Frame& frame);
  void end_moved() { body_ += "</g>\n"; }
  void end_clipped() { body_ += "</svg>\n"; }

  /// The document. `title` names it for those who cannot see it.
  [[nodiscard]] std::string document(double width_pt, double height_pt, std::string_view title) const;

 private:
  std::string body_;
};

/// Text as it may stand in an element.
std::string escaped(std::string_view text);
/// How wide a text will be [pt], rather too wide than too narrow: the widest of the fonts that may be taken.
double text_width_pt(std::string_view text, double size_pt);
/// A text in lines of at most that width, broken between words.
std::vector<std::string> wrapped(const std::string& text, double size_pt, double width_pt);

}  // namespace lukou::figure
