#include <algorithm>

#include "common/core/contract.hpp"
#include "services/lukou/report/figure/painter.hpp"

namespace lukou::figure {
namespace {

void draw_head(Svg& svg, const Layout& layout) {
  double top = kMargin_pt;
  const auto lines = [&](const std::vector<std::string>& texts, const TextStyle& style) {
    for (const std::string& line : texts) {
      const double height = style.size_pt * kLineHeight;
      svg.text({kMargin_pt, top + height / 2.0}, line, style);
      top += height;
    }
  };
  lines(layout.title, {.size_pt = kTitle_pt, .bold = true});
  lines(layout.subtitle, {.size_pt = kTick_pt, .colour = kGrey});
}

void draw_legend(Svg& svg, const Layout& layout) {
  const double height = kTick_pt * kLineHeight;
  double top = layout.legend_top;
  for (const auto& row : layout.legend) {
    double left = kMargin_pt;
    for (const LegendEntry& entry : row) {
      draw_symbol(svg, {left, top, kSymbol_pt, height}, entry);
      svg.text({left + kSymbol_pt + 4.0, top + height / 2.0}, entry.name, {});
      left += width_pt(entry);
    }
    top += height;
  }
}

/// Light lines behind the content; a map needs none.
void draw_grid(Svg& svg, const Figure& figure, const Layout& layout) {
  if (layout.scale != nullptr) return;
  const Stroke faint{kFaint, 0.5, {}};
  const Frame& plot = layout.plot;
  if (figure.y.names.empty()) {
    for (const Tick& tick : layout.y.ticks()) {
      const double y = layout.place({layout.x.min(), tick.at}).y;
      svg.line({plot.left, y}, {plot.right(), y}, faint);
    }
  }
  if (figure.x.names.empty()) {
    for (const Tick& tick : layout.x.ticks()) {
      const double x = layout.place({tick.at, layout.y.min()}).x;
      svg.line({x, plot.top}, {x, plot.bottom()}, faint);
    }
  }
}

void draw_axes(Svg& svg, const Figure& figure, const Layout& layout) {
  const Frame& plot = layout.plot;
  const Stroke thin{kInk, 0.6, {}};
  svg.outline(plot, thin);
  for (const Tick& tick : layout.x.ticks()) {
    const double x = layout.place({tick.at, layout.y.min()}).x;
    svg.line({x, plot.bottom()}, {x, plot.bottom() + kTickLength_pt}, thin);
    const double below = plot.bottom() + kTickLength_pt + kTick_pt * 0.65;
    if (layout.turned_names) {
      svg.text({x + 2.0, below}, tick.text, {.anchor = Note::Anchor::kEnd, .turn_deg = kTurn_deg});
    } else {
      svg.text({x, below}, tick.text, {.anchor = Note::Anchor::kMiddle});
    }
  }
  for (const Tick& tick : layout.y.ticks()) {
    const double y = layout.place({layout.x.min(), tick.at}).y;
    svg.line({plot.left - kTickLength_pt, y}, {plot.left, y}, thin);
    svg.text({plot.left - kTickLength_pt - 2.0, y}, tick.text, {.anchor = Note::Anchor::kEnd});
  }
  const TextStyle label{.size_pt = kLabel_pt, .anchor = Note::Anchor::kMiddle};
  svg.text({plot.left + plot.width / 2.0, layout.paper.height - kMargin_pt - kLabel_pt * 0.6}, title(figure.x), label);
  TextStyle upwards = label;
  upwards.turn_deg = -90.0;
  svg.text({kMargin_pt + kLabel_pt * 0.6, plot.top + plot.height / 2.0}, title(figure.y), upwards);
}

void draw_scale(Svg& svg, const Layout& layout) {
  if (layout.scale == nullptr) return;
  constexpr int kSlices = 64;
  const Frame bar{layout.plot.right() + 8.0, layout.plot.top, kBar_pt, layout.plot.height};
  const AxisScale scale = bar_of(*layout.scale);
  const double height = bar.height / kSlices;
  for (int i = 0; i < kSlices; ++i) {
    const double value = scale.min() + (scale.max() - scale.min()) * (i + 0.5) / kSlices;
    // A little overlap: no white lines between the slices on a screen.
    svg.rectangle({bar.left, bar.bottom() - (i + 1) * height, bar.width, height + (i > 0 ? 0.3 : 0.0)},
                  layout.scale->at(value));
  }
  const Stroke thin{kInk, 0.6, {}};
  svg.outline(bar, thin);
  for (const Tick& tick : scale.ticks()) {
    const double y = bar.bottom() - scale.share(tick.at) * bar.height;
    svg.line({bar.right(), y}, {bar.right() + kTickLength_pt, y}, thin);
    svg.text({bar.right() + kTickLength_pt + 2.0, y}, tick.text, {});
  }
  svg.text({layout.paper.width - kMargin_pt - kLabel_pt * 0.5, bar.top + bar.height / 2.0}, layout.scale->label,
           {.size_pt = kLabel_pt, .anchor = Note::Anchor::kMiddle, .turn_deg = -90.0});
}

Layout draw(Svg& svg, const Figure& figure) {
  Layout layout = layout_of(figure);
  draw_grid(svg, figure, layout);
  if (layout.clipped) svg.begin_clipped(layout.plot);
  draw_layers(svg, layout, figure.layers);
  if (layout.clipped) svg.end_clipped();
  draw_axes(svg, figure, layout);
  draw_scale(svg, layout);
  draw_head(svg, layout);
  draw_legend(svg, layout);
  return layout;
}

}  // namespace

std::vector<double> edges_of_names(std::size_t names) {
  std::vector<double> edges;
  for (std::size_t i = 0; i <= names; ++i) edges.push_back(static_cast<double>(i) - 0.5);
  return edges;
}

std::string svg_of(const Figure& figure) { return svg_of({&figure, 1}, 1); }

std::string svg_of(std::span<const Figure> panels, int columns) {
  LUKOU_EXPECT(!panels.empty() && columns >= 1);
  Svg svg;
  Frame all;
  std::string title;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t column = i % static_cast<std::size_t>(columns);
    const std::size_t row = i / static_cast<std::size_t>(columns);
    const Frame paper = layout_of(panels[i]).paper;
    const Point corner{static_cast<double>(column) * paper.width, static_cast<double>(row) * paper.height};
    svg.begin_moved(corner);
    draw(svg, panels[i]);
    svg.end_moved();
    all.width = std::max(all.width, corner.x + paper.width);
    all.height = std::max(all.height, corner.y + paper.height);
    title += (title.empty() ? "" : "; ") + panels[i].title;
  }
  return svg.document(all.width, all.height, title);
}

}  // namespace lukou::figure
