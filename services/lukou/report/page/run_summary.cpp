#include <nlohmann/json.hpp>

#include "services/lukou/report/page/html.hpp"
#include "services/lukou/report/page/run_facts.hpp"

namespace lukou::report {
namespace {

using html::both;
using html::element;
using Json = nlohmann::ordered_json;

/// A figure of summary.json for the three groups; `object` holds it and the objects of the two groups.
struct Row {
  const char* object;  ///< null: the summary itself
  const char* key;
  Words label;
  int decimals;  ///< -1: a count
};

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows = {
      {nullptr, "vehicles_entered", {"vehicles entered", "驶入车辆"}, -1},
      {nullptr, "vehicles_left", {"vehicles left", "驶离车辆"}, -1},
      {nullptr, "cars_measured", {"cars that the means are over", "计入均值的车辆"}, -1},
      {nullptr, "throughput_veh_per_h", {"throughput per approach [veh/h]", "每进口道通行量 [辆/小时]"}, 1},
      {nullptr, "mean_delay_s", {"mean delay [s]", "平均延误 [s]"}, 2},
      {nullptr,
       "mean_delay_all_s",
       {"mean delay, those still under way included [s]", "平均延误，含尚未驶离的车辆 [s]"},
       2},
      {nullptr, "mean_delta_s", {"mean delta at the stop line [s]", "停车线处平均 delta [s]"}, 2},
      {nullptr, "mean_stop_time_s", {"mean stop time [s]", "平均停车时间 [s]"}, 2},
      {nullptr, "stops_per_vehicle", {"stops per vehicle", "平均停车次数"}, 3},
      {nullptr, "mean_queue_veh", {"mean queue per lane [veh]", "每车道平均排队 [辆]"}, 3},
      {nullptr, "mean_abs_acceleration_mps2", {"mean size of the acceleration [m/s²]", "加速度绝对值均值 [m/s²]"}, 3},
      {"fuel", "mean_fuel_ml", {"fuel per vehicle [mL]", "每车燃油 [mL]"}, 2},
      {"fuel", "fuel_l", {"fuel in all [L]", "燃油总量 [L]"}, 2},
      {"fuel", "co2_kg", {"CO₂ in all [kg]", "CO₂ 总量 [kg]"}, 2},
      {"safety", "ttc", {"encounters with TTC < 3 s", "TTC < 3 s 的交会"}, -1},
      {"safety", "ttc_critical", {"of these TTC < 1.5 s", "其中 TTC < 1.5 s"}, -1},
      {"safety", "drac", {"encounters with DRAC ≥ 3 m/s²", "DRAC ≥ 3 m/s² 的交会"}, -1},
      {"safety", "hard_braking", {"hard brakings", "急刹车"}, -1},
      {"safety", "pet", {"encounters with PET < 2 s", "PET < 2 s 的交会"}, -1},
  };
  return kRows;
}

struct Cause {
  const char* key;
  Words name;
};
const std::vector<Cause>& causes() {
  static const std::vector<Cause> kCauses = {
      {"unequipped", {"no on-board unit", "无车载单元"}},
      {"queue_ahead", {"a queue ahead", "前方排队"}},
      {"not_complied", {"driver did not follow", "驾驶员不遵从"}},
      {"advised", {"the advice itself", "建议本身"}},
      {"overridden_red", {"overridden by the light", "被红灯制动取代"}},
      {"overridden_following", {"overridden by the car ahead", "被跟驰规律取代"}},
      {"overridden_guard", {"overridden by the guard", "被安全防护取代"}},
      {"overridden_limit", {"cut by a limit", "被限值截断"}},
      {"lost_random", {"advice lost: random", "建议丢失：随机"}},
      {"lost_burst", {"advice lost: burst", "建议丢失：突发"}},
      {"lost_range", {"advice lost: out of range", "建议丢失：超出距离"}},
      {"lost_path_loss", {"advice lost: too weak", "建议丢失：信号太弱"}},
      {"lost_collision", {"advice lost: collision", "建议丢失：碰撞"}},
      {"lost_half_duplex", {"advice lost: half duplex", "建议丢失：半双工"}},
      {"lost_outage", {"advice lost: outage", "建议丢失：中断"}},
      {"late", {"advice late", "建议迟到"}},
      {"expired", {"advice expired", "建议过期"}},
      {"rsu_unheard", {"RSU not heard", "收不到路侧单元"}},
      {"red_without_advice", {"the light, without advice", "红灯，无建议"}}};
  return kCauses;
}

std::string cell(const Json& object, const Row& row) {
  if (!object.is_object() || !object.contains(row.key)) return "";
  const Json& value = object[row.key];
  if (!value.is_number()) return "–";
  return row.decimals < 0 ? grouped(value.get<std::int64_t>()) : fixed(value.get<double>(), row.decimals);
}

std::string number(const std::string& text, const char* tag = "td") { return element(tag, text, "class=\"number\""); }

std::string groups_table(const Json& summary) {
  std::string text =
      element("tr", "<td></td>" + number(both({"all", "全部"}), "th") + number(both({"equipped", "装载"}), "th") +
                        number(both({"unequipped", "未装载"}), "th")) +
      "\n";
  for (const Row& row : rows()) {
    if (row.object != nullptr && !summary.contains(row.object)) continue;
    const Json& of = row.object == nullptr ? summary : summary[row.object];
    if (!of.contains(row.key)) continue;
    text += element("tr", element("th", both(row.label), "scope=\"row\"") + number(cell(of, row)) +
                              number(cell(of["equipped"], row)) + number(cell(of["unequipped"], row))) +
            "\n";
  }
  return "<div class=\"wide\"><table>\n" + text + "</table></div>\n";
}

std::string causes_table(const Json& summary) {
  if (!summary.contains("stops_by_cause")) return "";
  const auto total = summary.value("stops_total", std::int64_t{0});
  std::string text;
  for (const Cause& cause : causes()) {
    const auto count = summary["stops_by_cause"].value(cause.key, std::int64_t{0});
    if (count == 0) continue;
    const double share = 100.0 * static_cast<double>(count) / static_cast<double>(total);
    text += element("tr", element("th", both(cause.name), "scope=\"row\"") + element("td", element("code", cause.key)) +
                              number(grouped(count)) + number(fixed(share, 1) + " %")) +
            "\n";
  }
  return element("h3", both({"Stops since the start, by cause: ", "自仿真开始的停车，按原因："}) + grouped(total)) +
         "<div class=\"wide\"><table>\n" + text + "</table></div>\n";
}

}  // namespace

std::string summary_section(const Result& result) {
  std::string content = element("h2", both({"Summary", "汇总"}));
  const Json& summary = result.summary();
  if (!summary.is_object()) {
    content += element("p", both({"The run has left no summary.json.", "本次运行没有 summary.json。"}));
    return element("section", content);
  }
  content += groups_table(summary) +
             element("p",
                     both({"Means and throughput are over the time after the warm-up, counts are since the start.",
                           "均值与通行量取预热结束之后，计数自仿真开始。"}),
                     "class=\"muted\"") +
             causes_table(summary);
  return element("section", content);
}

}  // namespace lukou::report
