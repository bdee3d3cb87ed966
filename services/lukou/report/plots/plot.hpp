#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/intersection/lane.hpp"
#include "services/lukou/report/figure/figure.hpp"
#include "services/lukou/report/result.hpp"
#include "services/lukou/report/words.hpp"

namespace lukou::report {

/// What a figure is to show; a figure takes some of it.
struct PlotOptions {
  std::optional<Lane> lane;
  std::optional<double> from_s;
  std::optional<double> to_s;  ///< above from_s
  std::optional<std::uint32_t> vehicle;
};

/// One picture: figures beside each other and below.
struct Panels {
  std::vector<figure::Figure> figures;
  int columns = 2;
};
std::string svg_of(const Panels& panels);

/// A picture with its data, to be drawn in either language.
using Drawing = std::function<Panels(Language)>;

/// A kind of picture that `lukou plot` and `lukou report` draw.
struct Plot {
  std::string_view name;  ///< as after --figure
  Words title;
  std::string_view needs;  ///< of the result folder, and how to record it
  bool takes_lane = false;
  bool takes_window = false;
  bool takes_vehicle = false;
  Expected<Drawing> (*draw)(const Result& result, const PlotOptions& options) = nullptr;
};

/// All of them, in the order of a report.
std::span<const Plot> plots();
/// Draws one. Errors: an unknown name, an option that it does not take, a record that is missing.
Expected<Drawing> draw(std::string_view name, const Result& result, const PlotOptions& options);

// One file each.
Expected<Drawing> draw_stop_time(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_cumulative(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_queue(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_delay(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_discharge(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_time_space(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_phase_plane(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_radio(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_advice(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_safety(const Result& result, const PlotOptions& options);
Expected<Drawing> draw_fuel(const Result& result, const PlotOptions& options);

}  // namespace lukou::report
