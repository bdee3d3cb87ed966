#include "services/lukou/report/plots/plot.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace lukou::report {
namespace {

const std::array<Plot, 11>& all_plots() {
  static const std::array<Plot, 11> kPlots = {{
      {"stop-time",
       {"Mean stop time and when it settles (the paper's figure 6)", "平均停车时间及其进入稳态的过程（论文图 6）"},
       "stop_time.csv",
       false,
       true,
       false,
       draw_stop_time},
      {"cumulative",
       {"Cumulative arrivals and departures", "累计到达与驶离"},
       "car.csv, road.csv",
       true,
       true,
       false,
       draw_cumulative},
      {"queue", {"Queue profile", "排队过程"}, "stop_time.csv", true, true, false, draw_queue},
      {"delay", {"Delay distribution", "延误分布"}, "car.csv", true, true, false, draw_delay},
      {"discharge",
       {"Discharge headways by place in the queue", "按排队位置的消散车头时距"},
       "car.csv; run.mcap (record.log=EVENTS) if the signal plan was changed or actuated",
       true,
       true,
       false,
       draw_discharge},
      {"time-space",
       {"Time-space diagram", "时空图"},
       "run.mcap (record.log=SECOND or FULL)",
       true,
       true,
       false,
       draw_time_space},
      {"phase-plane",
       {"A car's way in the plane of the following law (the paper's figure 5)", "车辆在跟驰相平面中的轨迹（论文图 5）"},
       "run.mcap (record.log=SECOND or FULL)",
       false,
       true,
       true,
       draw_phase_plane},
      {"radio",
       {"Radio: delivery, latency, losses", "无线通信：送达、时延、丢失"},
       "radio.csv (a modelled radio, for example radio.preset=PC5_MODE4)",
       false,
       true,
       false,
       draw_radio},
      {"advice",
       {"What became of advice", "建议的去向"},
       "summary.json; its age from guidance.csv (record.guidance=true)",
       false,
       false,
       false,
       draw_advice},
      {"safety",
       {"Dangerous encounters", "危险交会"},
       "summary.json, safety.csv (record.safety)",
       false,
       false,
       false,
       draw_safety},
      {"fuel", {"Fuel", "燃油消耗"}, "summary.json, car.csv", false, false, false, draw_fuel},
  }};
  return kPlots;
}

Expected<Done> check_options(const Plot& plot, const PlotOptions& options) {
  const std::string figure = "--figure " + std::string(plot.name);
  if (options.lane && !plot.takes_lane) return Error{figure, "takes no --lane"};
  if ((options.from_s || options.to_s) && !plot.takes_window) return Error{figure, "takes no --from and --to"};
  if (options.vehicle && !plot.takes_vehicle) return Error{figure, "takes no --vehicle"};
  if (options.from_s && options.to_s && *options.from_s >= *options.to_s) {
    return Error{"--from " + fixed(*options.from_s, 1), "must lie before --to " + fixed(*options.to_s, 1)};
  }
  return Done{};
}

}  // namespace

std::string svg_of(const Panels& panels) {
  return figure::svg_of(panels.figures, std::min(panels.columns, static_cast<int>(panels.figures.size())));
}

std::span<const Plot> plots() { return all_plots(); }

Expected<Drawing> draw(std::string_view name, const Result& result, const PlotOptions& options) {
  const auto plot = std::ranges::find(all_plots(), name, &Plot::name);
  if (plot != all_plots().end()) {
    if (const auto taken = check_options(*plot, options); !taken) return taken.error();
    return plot->draw(result, options);
  }
  std::string names;
  for (const Plot& known : all_plots()) names += (names.empty() ? "" : ", ") + std::string(known.name);
  return Error{"--figure " + std::string(name), "is not known; there are: " + names};
}

}  // namespace lukou::report
