#include "services/lukou/report/figure/layout.hpp"

#include <algorithm>
#include <cmath>

namespace lukou::figure {
namespace {

constexpr double kPtPerMm = 72.0 / 25.4;
constexpr double kTickEvery_pt = 42.0;    ///< along x, for numbers
constexpr double kTickEveryUp_pt = 24.0;  ///< along y
constexpr double kPi = 3.14159265358979323846;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};

struct Content {
  Extent x;
  Extent y;

  void take(const Point& point) {
    // A gap in a line says nothing about either axis.
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return;
    x.take(point.x);
    y.take(point.y);
  }
};

Content content_of(const std::vector<Layer>& layers) {
  Content content;
  const Overloaded take{
      [&](const Line& line) { std::ranges::for_each(line.points, [&](const Point& point) { content.take(point); }); },
      [&](const Band& band) {
        for (const double x : band.x) content.x.take(x);
        for (const double y : band.low) content.y.take(y);
        for (const double y : band.high) content.y.take(y);
      },
      [&](const Scatter& scatter) {
        std::ranges::for_each(scatter.points, [&](const Point& point) { content.take(point); });
      },
      [&](const Intervals& whiskers) {
        for (const Interval& interval : whiskers.intervals) {
          content.take({interval.at.x, interval.low});
          content.take({interval.at.x, interval.high});
        }
      },
      [&](const Bars& bars) {
        for (const Bar& bar : bars.bars) {
          Extent& along = bars.horizontal ? content.x : content.y;
          Extent& across = bars.horizontal ? content.y : content.x;
          along.take(bar.from);
          along.take(bar.to);
          across.take(bar.at - bars.width / 2.0);
          across.take(bar.at + bars.width / 2.0);
        }
      },
      [&](const Boxes& boxes) {
        for (const Box& box : boxes.boxes) {
          content.take({box.x_min, box.y_min});
          content.take({box.x_max, box.y_max});
        }
      },
      [&](const Cells& cells) {
        for (const double x : cells.x_edges) content.x.take(x);
        for (const double y : cells.y_edges) content.y.take(y);
      },
      [&](const Contours& contours) {
        for (const double x : contours.x) content.x.take(x);
        for (const double y : contours.y) content.y.take(y);
      },
      [&](const Rule& rule) { (rule.vertical ? content.x : content.y).take(rule.at); },
      [&](const Note& note) { content.take(note.at); }};
  for (const Layer& layer : layers) std::visit(take, layer);
  return content;
}

std::vector<LegendEntry> entries_of(const std::vector<Layer>& layers) {
  std::vector<LegendEntry> entries;
  for (const Layer& layer : layers) {
    const std::string name = std::visit(
        [](const auto& content) {
          if constexpr (requires { content.name; }) return content.name;
          return std::string();
        },
        layer);
    if (!name.empty()) entries.push_back({name, &layer});
    const Cells* cells = std::get_if<Cells>(&layer);
    if (cells == nullptr || cells->hatched_name.empty()) continue;
    if (std::ranges::find(cells->hatched, true) == cells->hatched.end()) continue;
    entries.push_back({cells->hatched_name, &layer, true});
  }
  return entries;
}

const ColourScale* scale_of(const std::vector<Layer>& layers) {
  for (const Layer& layer : layers)
    if (const Cells* cells = std::get_if<Cells>(&layer)) return &cells->scale;
  return nullptr;
}

double widest_pt(const std::vector<Tick>& ticks) {
  double widest = 0.0;
  for (const Tick& tick : ticks) widest = std::max(widest, text_width_pt(tick.text, kTick_pt));
  return widest;
}

std::vector<std::vector<LegendEntry>> in_rows(std::vector<LegendEntry> entries, double width) {
  std::vector<std::vector<LegendEntry>> rows;
  double used = width;
  for (LegendEntry& entry : entries) {
    const double needs = width_pt(entry);
    if (rows.empty() || used + needs > width) {
      rows.emplace_back();
      used = 0.0;
    }
    used += needs;
    rows.back().push_back(std::move(entry));
  }
  return rows;
}

int ticks_over(double length_pt, double every_pt) { return std::max(2, static_cast<int>(length_pt / every_pt)); }

bool reaches_out(const Extent& content, const AxisScale& scale) {
  const double slack = (scale.max() - scale.min()) * 1e-9;
  return content.min && (*content.min < scale.min() - slack || *content.max > scale.max() + slack);
}

}  // namespace

double width_pt(const LegendEntry& entry) { return kSymbol_pt + 4.0 + text_width_pt(entry.name, kTick_pt) + 10.0; }

AxisScale bar_of(const ColourScale& scale) {
  // The bar ends where the colours do, not at a tick.
  return {Axis{.label = {}, .unit = {}, .logarithmic = false, .min = scale.min, .max = scale.max, .names = {}}, {}, 5};
}

Layout layout_of(const Figure& figure) {
  const Frame paper{0.0, 0.0, figure.size.width_mm * kPtPerMm, figure.size.height_mm * kPtPerMm};
  const double inner_pt = paper.width - 2.0 * kMargin_pt;
  const Content content = content_of(figure.layers);
  std::vector<std::string> head = wrapped(figure.title, kTitle_pt * kBold, inner_pt);
  std::vector<std::string> below = wrapped(figure.subtitle, kTick_pt, inner_pt);
  auto legend = in_rows(entries_of(figure.layers), inner_pt);

  double top = kMargin_pt + static_cast<double>(head.size()) * kTitle_pt * kLineHeight +
               static_cast<double>(below.size()) * kTick_pt * kLineHeight;
  const double legend_top = top + (legend.empty() ? 0.0 : 2.0);
  top = legend_top + static_cast<double>(legend.size()) * kTick_pt * kLineHeight + 6.0;

  const double label_pt = kLabel_pt * kLineHeight;
  double bottom = kMargin_pt + (figure.x.label.empty() ? 0.0 : label_pt) + kTick_pt * kLineHeight + kTickLength_pt;
  AxisScale y(figure.y, content.y, ticks_over(paper.height - top - bottom, kTickEveryUp_pt));
  const double left =
      kMargin_pt + (figure.y.label.empty() ? 0.0 : label_pt) + widest_pt(y.ticks()) + kTickLength_pt + 3.0;
  const ColourScale* scale = scale_of(figure.layers);
  double right = kMargin_pt + 6.0;
  if (scale != nullptr) {
    right = kMargin_pt + 8.0 + kBar_pt + kTickLength_pt + 2.0 + widest_pt(bar_of(*scale).ticks()) +
            (scale->label.empty() ? 0.0 : label_pt);
  }
  const auto x_ticks = [&] { return ticks_over(paper.width - left - right, kTickEvery_pt); };
  // The last number may reach beyond the plot by half its width.
  const AxisScale first_try(figure.x, content.x, x_ticks());
  if (figure.x.names.empty() && !first_try.ticks().empty()) {
    right = std::max(right, kMargin_pt + text_width_pt(first_try.ticks().back().text, kTick_pt) / 2.0);
  }
  const double width = paper.width - left - right;
  AxisScale x(figure.x, content.x, x_ticks());
  const double widest = widest_pt(x.ticks());
  const bool turned = !figure.x.names.empty() && widest + 4.0 > width / static_cast<double>(figure.x.names.size());
  if (turned) bottom += widest * std::sin(-kTurn_deg * kPi / 180.0);
  const Frame plot{left, top, width, std::max(20.0, paper.height - top - bottom)};
  const bool clipped = reaches_out(content.x, x) || reaches_out(content.y, y);
  return {paper,  plot,         std::move(head), std::move(below), std::move(legend), legend_top, scale,
          turned, std::move(x), std::move(y),    clipped};
}

}  // namespace lukou::figure
