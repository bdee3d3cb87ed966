#include "services/lukou/report/export/sheets.hpp"

#include <array>
#include <cmath>

namespace lukou::report {
namespace {

constexpr auto kWhole = CellKind::kWhole;
constexpr auto kReal = CellKind::kReal;
constexpr auto kText = CellKind::kText;

constexpr Column kRun[] = {{"name", kText}, {"value", kReal}};
constexpr Column kCars[] = {{"vehicle", kWhole},   {"lane", kText},       {"equipped", kWhole}, {"entered_s", kReal},
                            {"entered_speed_mps"}, {"desired_speed_mps"}, {"crossed_s", kReal}, {"left_s", kReal}};
constexpr Column kTrajectories[] = {{"time_s", kReal},
                                    {"vehicle", kWhole},
                                    {"lane", kText},
                                    {"equipped", kWhole},
                                    {"past_line", kWhole},
                                    {"position_m"},
                                    {"x_m"},
                                    {"y_m"},
                                    {"heading_deg"},
                                    {"speed_mps"},
                                    {"acceleration_mps2"},
                                    {"commanded_mps2"},
                                    {"noise_mps2"},
                                    {"guidance", kText}};
constexpr Column kSignals[] = {{"lane", kText}, {"from_s"}, {"to_s"}, {"state", kText}};
constexpr Column kMessages[] = {{"sent_s"},           {"direction", kText}, {"rsu", kWhole},        {"sender", kText},
                                {"sequence", kWhole}, {"kind", kText},      {"wire_bytes", kWhole}, {"antenna_x_m"},
                                {"antenna_y_m"},      {"payload", kText}};
constexpr Column kReceptions[] = {{"sent_s"}, {"vehicle", kWhole}, {"rsu", kWhole}, {"fate", kText}, {"latency_ms"}};
constexpr Column kAdvice[] = {{"known_s"},         {"issued_s"},     {"rsu", kWhole},    {"sequence", kWhole},
                              {"vehicle", kWhole}, {"kind", kText},  {"commanded_mps2"}, {"commanded_speed_mps"},
                              {"fate", kText},     {"again", kWhole}};

constexpr std::array<Sheet, kSheets> kAll = {{{"run", kRun},
                                              {"cars", kCars},
                                              {"trajectories", kTrajectories},
                                              {"signals", kSignals},
                                              {"messages", kMessages},
                                              {"receptions", kReceptions},
                                              {"advice", kAdvice}}};

}  // namespace

const Sheet& sheet(SheetId id) { return kAll[static_cast<std::size_t>(id)]; }

Cell real(double value) {
  if (!std::isfinite(value)) return std::monostate{};
  return value;
}

}  // namespace lukou::report
