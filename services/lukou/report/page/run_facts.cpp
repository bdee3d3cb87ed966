#include "services/lukou/report/page/run_facts.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "common/core/markup.hpp"
#include "common/core/step.hpp"
#include "scenario.pb.h"
#include "services/lukou/report/page/html.hpp"

namespace lukou::report {
namespace {

using html::both;
using html::element;

std::string code(std::string_view text) { return element("code", markup_text(text)); }

std::string seconds(double value) { return fixed(value, value == std::floor(value) ? 0 : 1) + " s"; }

/// "1800" or "series", "file"
std::string flow_of(const scenario::Demand& demand) {
  if (demand.has_arrivals_csv()) return both({"from a file", "来自文件"});
  if (demand.flow_series_size() > 0) return both({"series", "时间序列"});
  return fixed(demand.flow_veh_per_h(), 0);
}

std::string signals_of(const scenario::Signals& signals) {
  const std::string plan = signals.has_plan() ? both({"a plan of its own, cycle ", "自定义配时，周期 "}) +
                                                    markup_text(fixed(signals.plan().cycle_s(), 0) + " s")
                                              : code(scenario::SignalPreset_Name(signals.preset()));
  return signals.has_actuation() ? plan + both({"; RSUs may ask for greens", "；路侧可请求绿灯"}) : plan;
}

std::string rsus_of(const scenario::Scenario& scenario) {
  std::string text;
  for (const scenario::Rsu& rsu : scenario.rsus()) text += (text.empty() ? "" : ", ") + code(rsu.algorithm());
  return text;
}

class Table {
 public:
  void row(const Words& label, const std::string& value) {
    rows_ += element("tr", element("th", both(label), "scope=\"row\"") + element("td", value)) + "\n";
  }
  [[nodiscard]] std::string text() const { return "<div class=\"wide\"><table>\n" + rows_ + "</table></div>\n"; }

 private:
  std::string rows_;
};

}  // namespace

std::string facts_section(const Result& result) {
  const scenario::Scenario& scenario = result.scenario().message();
  const auto& traffic = scenario.traffic();
  Table table;
  table.row({"seed", "随机种子"}, std::to_string(scenario.run().seed()));
  table.row({"duration, warm-up", "时长，预热"},
            seconds(scenario.run().duration_s()) + ", " + seconds(scenario.run().warmup_s()));
  table.row({"flow from W, S, E, N [veh/h]", "西、南、东、北进口流量 [辆/小时]"},
            flow_of(traffic.west()) + ", " + flow_of(traffic.south()) + ", " + flow_of(traffic.east()) + ", " +
                flow_of(traffic.north()));
  table.row({"equipped ratio", "装载比例"}, fixed(scenario.vehicles().equipped_ratio(), 2));
  table.row({"signals", "信号配时"}, signals_of(scenario.signals()));
  table.row({"radio", "无线通信"}, code(scenario::RadioPreset_Name(scenario.radio().preset())) +
                                       (result.holds("radio.csv") ? "" : both({" (ideal)", "（理想）"})));
  table.row({"RSU algorithm", "路侧算法"}, rsus_of(scenario));
  table.row({"changes while it ran", "运行中的修改"}, std::to_string(result.directives().sets.size()));
  if (const auto& manifest = result.manifest()) {
    table.row({"complete to", "完整记录至"},
              seconds(time_s(manifest->complete_to_step)) + " / " + seconds(time_s(manifest->steps_planned)));
    table.row({"ended by", "结束原因"}, code(manifest->ended_by));
    table.row({"version", "版本"}, "Lukou " + markup_text(manifest->lukou_version));
    table.row({"scenario hash (SHA-256)", "场景哈希（SHA-256）"}, code(manifest->scenario_hash));
  }
  return element("section", element("h2", both({"What was run", "运行条件"})) + table.text());
}

std::string warnings_section(const Result& result) {
  std::vector<std::string> bad;
  std::vector<std::string> known;
  const auto& manifest = result.manifest();
  if (!manifest) {
    bad.push_back(both({"There is no manifest: the run has not ended, or ended without its recorder.",
                        "没有清单文件：运行尚未结束，或记录进程丢失。"}));
  } else if (manifest->ended_by != "done") {
    const std::string until = fixed(time_s(manifest->complete_to_step), 1);
    bad.push_back(both({"The run ended early; all figures are of the first " + until + " s. Ended by: ",
                        "运行提前结束，所有图表仅为前 " + until + " 秒。结束原因："}) +
                  code(manifest->ended_by) + " " + markup_text(manifest->culprit));
  }
  const nlohmann::ordered_json& summary = result.summary();
  if (summary.is_object()) {
    const auto count = [&](const char* key) { return summary.value(key, std::int64_t{0}); };
    if (count("collisions") > 0) {
      bad.push_back(both(
          {"Collisions: " + grouped(count("collisions")) + ".", "碰撞：" + grouped(count("collisions")) + " 次。"}));
    }
    if (count("reversals") > 0) {
      bad.push_back(both({"Cars moved backwards in " + grouped(count("reversals")) + " steps.",
                          "车辆倒退：" + grouped(count("reversals")) + " 步。"}));
    }
    if (count("cars_measured") == 0) {
      bad.push_back(both({"No car entered after the warm-up and crossed: there are no means.",
                          "没有车辆在预热结束后驶入并驶过停车线，因此没有均值。"}));
    }
    if (count("rsu_deadline_misses") > 0) {
      known.push_back(both({"RSUs computed longer than 0.1 s in " + grouped(count("rsu_deadline_misses")) + " steps.",
                            "路侧计算超过 0.1 秒：" + grouped(count("rsu_deadline_misses")) + " 步。"}));
    }
    if (count("vehicles_waiting") > 0) {
      known.push_back(both({"At the end " + grouped(count("vehicles_waiting")) + " cars waited before the entrances.",
                            "结束时有 " + grouped(count("vehicles_waiting")) + " 辆车在入口外等待。"}));
    }
    if (count("red_crossings") > 0) {
      known.push_back(
          both({grouped(count("red_crossings")) + " cars crossed on red: they could not stop when the green ended.",
                grouped(count("red_crossings")) + " 辆车在红灯时驶过停车线：绿灯结束时已无法停车。"}));
    }
  }
  if (!result.directives().sets.empty()) {
    known.push_back(both({"An operator changed the run while it went on; the scenario above is how it began.",
                          "运行中曾由操作员修改；上述场景为开始时的状态。"}));
  }
  for (const std::string& warning : scenario::warnings(result.scenario())) {
    known.push_back(element("span", markup_text(warning), "class=\"said\" lang=\"en\""));
  }
  const auto section = [](const Words& title, const char* kind, const std::vector<std::string>& items) {
    if (items.empty()) return std::string();
    std::string list;
    for (const std::string& item : items) list += element("li", item) + "\n";
    return element("section", element("h2", both(title)) + element("ul", list), kind);
  };
  return section({"What went wrong", "异常"}, "class=\"bad\"", bad) +
         section({"Before you believe it", "须知"}, "class=\"warnings\"", known);
}

std::string record_section(const Result& result) {
  std::string content = element("h2", both({"The record", "记录"}));
  if (const auto& manifest = result.manifest()) {
    std::string rows = "<tr><th>" + both({"file", "文件"}) + "</th><th class=\"number\">" + both({"rows", "行数"}) +
                       "</th><th>SHA-256</th></tr>\n";
    for (const results::FileEntry& file : manifest->files) {
      rows += element("tr", element("td", code(file.name)) +
                                element("td", file.rows ? grouped(*file.rows) : "", "class=\"number\"") +
                                element("td", code(file.sha256))) +
              "\n";
    }
    content += "<div class=\"wide\"><table>\n" + rows + "</table></div>\n";
  }
  if (!result.directives().sets.empty()) {
    std::string list;
    for (const Directive& directive : result.directives().sets) {
      list += element("li", fixed(time_s(directive.step), 1) + " s: " + code(directive.set)) + "\n";
    }
    content += element("h3", both({"Changes while it ran", "运行中的修改"})) + element("ul", list);
  }
  const std::string again =
      "lukou run scenario.textproto --mode in-process --replay-directives directives.textproto --out again";
  content += element("h3", both({"To have it again, in the result folder", "在结果文件夹中重现"})) +
             element("pre", markup_text(again));
  content += "<details><summary>" + both({"The scenario, every field", "场景，全部字段"}) + "</summary>\n" +
             element("pre", markup_text(scenario::text(result.scenario()))) + "</details>\n";
  return element("section", content, "class=\"long\"");
}

}  // namespace lukou::report
