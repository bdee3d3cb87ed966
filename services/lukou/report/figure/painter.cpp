#include "services/lukou/report/figure/painter.hpp"

#include <algorithm>
#include <cmath>

#include "common/core/contract.hpp"
#include "services/lukou/report/figure/isolines.hpp"

namespace lukou::figure {
namespace {

constexpr double kMarker_pt = 4.0;
constexpr double kBandOpacity = 0.2;

Colour colour_of(const Line& line) { return line.colour.value_or(look_of(line.look).colour); }
Colour colour_of(const Bars& bars) { return bars.colour.value_or(look_of(bars.look).colour); }
Stroke stroke_of(const Line& line) {
  return {colour_of(line), line.width_pt, line.colour ? std::string_view() : look_of(line.look).dashes};
}
Stroke stroke_of(const Rule& rule) { return {rule.colour, 0.8, rule.dashed ? "2.5 2" : ""}; }
constexpr Stroke kContour{kInk, 0.8, {}};

/// Draws the layers of one figure into its plot.
class Painter {
 public:
  Painter(Svg& svg, const Layout& layout) : svg_(svg), at_(layout) {}

  void operator()(const Line& line) {
    std::vector<Point> run;
    const auto end_run = [&] {
      if (run.size() > 1) svg_.polyline(run, stroke_of(line));
      run.clear();
    };
    for (const Point& point : line.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) {
        end_run();
        continue;
      }
      const Point here = at_.place(point);
      if (line.steps && !run.empty()) run.push_back({here.x, run.back().y});
      run.push_back(here);
    }
    end_run();
    if (line.markers) markers(line.points, look_of(line.look).marker, kMarker_pt, colour_of(line));
  }

  void operator()(const Band& band) {
    LUKOU_EXPECT(band.low.size() == band.x.size() && band.high.size() == band.x.size());
    std::vector<Point> outline;
    for (std::size_t i = 0; i < band.x.size(); ++i) outline.push_back(at_.place({band.x[i], band.high[i]}));
    for (std::size_t i = band.x.size(); i-- > 0;) outline.push_back(at_.place({band.x[i], band.low[i]}));
    std::erase_if(outline, [](const Point& point) { return !std::isfinite(point.x) || !std::isfinite(point.y); });
    if (outline.size() > 2) svg_.polygon(outline, look_of(band.look).colour, kBandOpacity);
  }

  void operator()(const Scatter& scatter) {
    const Look look = look_of(scatter.look);
    markers(scatter.points, look.marker, scatter.size_pt, look.colour);
  }

  void operator()(const Intervals& whiskers) {
    const Stroke stroke{look_of(whiskers.look).colour, 0.8, {}};
    for (const Interval& interval : whiskers.intervals) {
      if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) continue;
      const Point low = at_.place({interval.at.x, interval.low});
      const Point high = at_.place({interval.at.x, interval.high});
      svg_.line(low, high, stroke);
      for (const Point& end : {low, high}) svg_.line({end.x - 2.0, end.y}, {end.x + 2.0, end.y}, stroke);
    }
  }

  void operator()(const Bars& bars) {
    for (const Bar& bar : bars.bars) {
      if (!std::isfinite(bar.from) || !std::isfinite(bar.to)) continue;
      const double near = bar.at - bars.width / 2.0;
      const double far = bar.at + bars.width / 2.0;
      const Box box = bars.horizontal ? Box{bar.from, bar.to, near, far} : Box{near, far, bar.from, bar.to};
      const Frame frame = frame_of(box);
      svg_.rectangle(frame, colour_of(bars), 0.85);
      svg_.outline(frame, {colour_of(bars), 0.5, {}});
    }
  }

  void operator()(const Boxes& boxes) {
    for (const Box& box : boxes.boxes) {
      const Frame frame = frame_of(box);
      if (boxes.hatched) {
        svg_.hatching(frame, boxes.colour);
      } else {
        svg_.rectangle(frame, boxes.colour, boxes.opacity);
      }
    }
  }

  void operator()(const Cells& cells) {
    const std::size_t columns = cells.x_edges.size() - 1;
    LUKOU_EXPECT(cells.x_edges.size() > 1 && cells.y_edges.size() > 1);
    LUKOU_EXPECT(cells.values.size() == columns * (cells.y_edges.size() - 1));
    const auto fits = [&](const auto& list) { return list.empty() || list.size() == cells.values.size(); };
    LUKOU_EXPECT(fits(cells.texts) && fits(cells.hovers) && fits(cells.hatched));
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
      if (!std::isfinite(cells.values[i])) continue;
      const std::size_t column = i % columns;
      const std::size_t row = i / columns;
      const Frame frame =
          frame_of({cells.x_edges[column], cells.x_edges[column + 1], cells.y_edges[row], cells.y_edges[row + 1]});
      const Colour fill = cells.scale.at(cells.values[i]);
      const Colour ink = is_dark(fill) ? kWhite : kInk;
      svg_.rectangle(frame, fill, 1.0, cells.hovers.empty() ? "" : cells.hovers[i]);
      if (!cells.hatched.empty() && cells.hatched[i]) svg_.hatching(frame, mixed(fill, ink, 0.55));
      if (cells.texts.empty()) continue;
      const Point middle{frame.left + frame.width / 2.0, frame.top + frame.height / 2.0};
      svg_.text(middle, cells.texts[i], {.size_pt = kTick_pt, .anchor = Note::Anchor::kMiddle, .colour = ink});
      taken_.push_back({middle, cells.texts[i]});
    }
  }

  void operator()(const Contours& contours) {
    for (const double level : contours.levels) {
      const std::string label = tick_text(level, std::abs(level) > 0.0 ? std::abs(level) : 1.0) + contours.unit;
      for (const std::vector<Point>& isoline : isolines(contours, level)) {
        std::vector<Point> places;
        for (const Point& point : isoline) places.push_back(at_.place(point));
        svg_.polyline(places, kContour);
        label_line(places, label);
      }
    }
  }

  void operator()(const Rule& rule) {
    const Point on = at_.place({rule.vertical ? rule.at : at_.x.min(), rule.vertical ? at_.y.min() : rule.at});
    const Point from = rule.vertical ? Point{on.x, at_.plot.bottom()} : Point{at_.plot.left, on.y};
    const Point to = rule.vertical ? Point{on.x, at_.plot.top} : Point{at_.plot.right(), on.y};
    svg_.line(from, to, stroke_of(rule));
  }

  void operator()(const Note& note) {
    svg_.text(at_.place(note.at), note.text,
              {.size_pt = kTick_pt, .anchor = note.anchor, .colour = note.colour, .halo = true});
  }

  /// What stands over everything else.
  void finish() {
    for (const auto& [place, text] : labels_) {
      svg_.text(place, text, {.size_pt = kTick_pt, .anchor = Note::Anchor::kMiddle, .halo = true});
    }
  }

 private:
  struct Label {
    Point place;
    std::string text;
  };

  /// Labels a line somewhere along it, where no other text stands; not at all if there is no such place.
  void label_line(const std::vector<Point>& line, const std::string& text) {
    const double width = text_width_pt(text, kTick_pt);
    const auto covers = [&](const Point& place, const Label& other) {
      const double apart = (width + text_width_pt(other.text, kTick_pt)) / 2.0;
      return std::abs(place.x - other.place.x) < apart && std::abs(place.y - other.place.y) < kTick_pt * kLineHeight;
    };
    constexpr std::size_t kPlaces = 16;
    for (std::size_t i = 0; i <= kPlaces; ++i) {
      const Point place = along(line, i, kPlaces);
      if (std::ranges::any_of(taken_, [&](const Label& other) { return covers(place, other); })) continue;
      taken_.push_back({place, text});
      labels_.push_back(taken_.back());
      return;
    }
  }

  /// The i-th of some places on a line, from its middle to its ends.
  static Point along(const std::vector<Point>& line, std::size_t i, std::size_t places) {
    const std::size_t pair = (i + 1) / 2;
    const double offset = static_cast<double>(pair) * (i % 2 == 0 ? 1.0 : -1.0);
    const double at = (0.5 + offset / static_cast<double>(places)) * static_cast<double>(line.size() - 1);
    const auto before = std::min(static_cast<std::size_t>(at), line.size() - 2);
    const double share = at - static_cast<double>(before);
    return {line[before].x + (line[before + 1].x - line[before].x) * share,
            line[before].y + (line[before + 1].y - line[before].y) * share};
  }

  void markers(const std::vector<Point>& points, Marker marker, double size_pt, Colour colour) {
    for (const Point& point : points)
      if (std::isfinite(point.x) && std::isfinite(point.y)) svg_.marker(at_.place(point), marker, size_pt, colour);
  }

  [[nodiscard]] Frame frame_of(const Box& box) const {
    const Point a = at_.place({box.x_min, box.y_min});
    const Point b = at_.place({box.x_max, box.y_max});
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::abs(a.x - b.x), std::abs(a.y - b.y)};
  }

  Svg& svg_;
  const Layout& at_;
  std::vector<Label> labels_;  ///< of lines, drawn at last
  std::vector<Label> taken_;   ///< these and the texts in cells
};

/// Draws the symbol of a legend entry into a frame of a line's height.
class SymbolPainter {
 public:
  SymbolPainter(Svg& svg, const Frame& frame, bool hatched) : svg_(svg), frame_(frame), hatched_(hatched) {}

  void operator()(const Line& line) {
    stroke(stroke_of(line));
    if (line.markers) svg_.marker(middle(), look_of(line.look).marker, kMarker_pt, colour_of(line));
  }
  void operator()(const Band& band) { svg_.rectangle(patch(), look_of(band.look).colour, kBandOpacity); }
  void operator()(const Scatter& scatter) {
    svg_.marker(middle(), look_of(scatter.look).marker, scatter.size_pt, look_of(scatter.look).colour);
  }
  void operator()(const Bars& bars) { svg_.rectangle(patch(), colour_of(bars), 0.85); }
  void operator()(const Boxes& boxes) {
    if (boxes.hatched) {
      svg_.hatching(patch(), boxes.colour);
      svg_.outline(patch(), {boxes.colour, 0.5, {}});
    } else {
      svg_.rectangle(patch(), boxes.colour, boxes.opacity);
    }
  }
  void operator()(const Cells& /*cells*/) {
    if (hatched_) svg_.hatching(patch(), kGrey);
    svg_.outline(patch(), {kGrey, 0.5, {}});
  }
  void operator()(const Contours& /*contours*/) { stroke(kContour); }
  void operator()(const Rule& rule) { stroke(stroke_of(rule)); }
  void operator()(const Intervals& /*whiskers*/) {}
  void operator()(const Note& /*note*/) {}

 private:
  [[nodiscard]] Point middle() const { return {frame_.left + frame_.width / 2.0, frame_.top + frame_.height / 2.0}; }
  [[nodiscard]] Frame patch() const {
    return {frame_.left + 4.0, frame_.top + 1.0, frame_.width - 6.0, frame_.height - 2.5};
  }
  void stroke(const Stroke& stroke) { svg_.line({frame_.left, middle().y}, {frame_.right(), middle().y}, stroke); }

  Svg& svg_;
  Frame frame_;
  bool hatched_;
};

}  // namespace

void draw_layers(Svg& svg, const Layout& layout, const std::vector<Layer>& layers) {
  Painter painter(svg, layout);
  for (const Layer& layer : layers) std::visit(painter, layer);
  painter.finish();
}

void draw_symbol(Svg& svg, const Frame& frame, const LegendEntry& entry) {
  std::visit(SymbolPainter(svg, frame, entry.hatched), *entry.layer);
}

}  // namespace lukou::figure
