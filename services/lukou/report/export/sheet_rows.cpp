#include "services/lukou/report/export/sheet_rows.hpp"

#include <map>
#include <string>
#include <vector>

#include "common/core/math.hpp"
#include "common/measures/stop_cause.hpp"
#include "common/radio/frame_fates.hpp"
#include "services/lukou/report/export/recorded_cars.hpp"
#include "services/lukou/report/plots/series.hpp"
#include "services/lukou/report/plots/signals.hpp"
#include "services/recorder/measure_config.hpp"

namespace lukou::report {
namespace {

Cell whole(std::int64_t value) { return value; }
Cell flag(bool value) { return std::int64_t{value ? 1 : 0}; }
Cell text(std::string_view value) { return value; }

std::string_view aspect_name(Aspect aspect) {
  switch (aspect) {
    case Aspect::kRed:
      return "red";
    case Aspect::kYellow:
      return "yellow";
    case Aspect::kGreen:
      return "green";
  }
  return "";
}

std::string_view kind_name(std::uint8_t kind) {
  static constexpr std::string_view kNames[] = {"", "bsm", "map", "spat", "rsm", "rsc"};
  return kind < std::size(kNames) ? kNames[kind] : "";
}

std::string_view reception_name(std::uint8_t fate) {
  static constexpr std::string_view kNames[kFrameFates] = {
      "heard",          "lost_random",    "lost_burst",       "lost_range",
      "lost_path_loss", "lost_collision", "lost_half_duplex", "lost_outage"};
  return fate < kFrameFates ? kNames[fate] : "";
}

std::string hex(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

std::string hex(std::uint64_t number) {
  std::vector<std::uint8_t> bytes;
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  return hex(bytes);
}

/// The record step by step, as rows.
class Rows {
 public:
  Rows(const Result& result, const ExportWish& wish, Step period, SheetSink& sink)
      : result_(result), wish_(wish), period_(period), sink_(sink), facts_(road_facts(result)) {}

  Expected<Done> give() {
    if (auto given = give_parameters(); !given) return given;
    if (wish_.signals) {
      if (auto given = give_signals(); !given) return given;
    }
    return give_steps();
  }

 private:
  struct Car {
    std::uint8_t lane = 0;
    bool equipped = false;
    double entered_s = 0.0;
    double entered_speed_mps = 0.0;
    double desired_speed_mps = 0.0;
    std::optional<double> crossed_s;
    std::optional<double> left_s;
  };

  Expected<Done> row(SheetId id, std::initializer_list<Cell> cells) {
    return sink_.row(id, {cells.begin(), cells.size()});
  }

  Expected<Done> give_parameters() {
    const RecorderConfig config = recorder_config(result_.scenario());
    const MeasureParameters& of = config.measures;
    if (auto opened = sink_.open(SheetId::kRun); !opened) return opened;
    const std::pair<std::string_view, double> values[] = {
        {"seed", static_cast<double>(config.seed)},
        {"simulated_s", end_s(result_)},
        {"warmup_s", of.warmup_s},
        {"period_s", time_s(period_)},
        {"approach_length_m", of.road.approach_m},
        {"exit_length_m", of.road.exit_m},
        {"vehicle_length_m", of.vehicle_length_m},
        {"speed_limit_mps", of.speed_limit_mps},
        {"acceleration_max_mps2", of.acceleration_max_mps2},
        {"speed_relaxation_s", of.speed_relaxation_s},
        {"stop_speed_mps", of.stop_speed_mps},
        {"stop_rearm_speed_mps", of.stop_rearm_mps},
    };
    for (const auto& [name, value] : values) {
      if (auto given = row(SheetId::kRun, {text(name), real(value)}); !given) return given;
    }
    return Done{};
  }

  Expected<Done> give_signals() {
    if (auto opened = sink_.open(SheetId::kSignals); !opened) return opened;
    for (int i = 0; i < kLanes; ++i) {
      const auto lane = static_cast<Lane>(i);
      const auto spans = aspect_spans(result_, lane, {0.0, end_s(result_)});
      if (!spans) return spans.error();
      for (const AspectSpan& span : spans.value()) {
        auto given = row(SheetId::kSignals,
                         {text(name(lane)), real(span.from_s), real(span.to_s), text(aspect_name(span.aspect))});
        if (!given) return given;
      }
    }
    return Done{};
  }

  Expected<Done> give_steps();
  Expected<Done> give_cars_on_road(const TrafficBatch& batch);
  Expected<Done> give_frames(const Frames& frames, Step sent, bool up, const std::vector<std::uint32_t>& rsus);
  Expected<Done> give_receptions(const TrafficBatch& batch);
  Expected<Done> give_fates(const TrafficBatch& batch);
  void note_events(const TrafficBatch& batch);
  Expected<Done> give_cars();

  const Result& result_;
  const ExportWish& wish_;
  Step period_;
  SheetSink& sink_;
  RoadFacts facts_;
  std::vector<std::uint32_t> order_;  ///< in which cars entered
  std::map<std::uint32_t, Car> cars_;
};

Expected<Done> Rows::give_steps() {
  const std::pair<bool, SheetId> sheets[] = {{wish_.cars, SheetId::kCars},
                                             {wish_.trajectories, SheetId::kTrajectories},
                                             {wish_.messages, SheetId::kMessages},
                                             {wish_.messages, SheetId::kReceptions},
                                             {wish_.advice, SheetId::kAdvice}};
  bool any = false;
  for (const auto& [wanted, id] : sheets) {
    if (!wanted) continue;
    any = true;
    if (auto opened = sink_.open(id); !opened) return opened;
  }
  if (!any) return Done{};
  auto log = result_.run_log(wish_.messages ? run_log::Level::kFull : run_log::Level::kEvents, "this export");
  if (!log) return log.error();
  while (true) {
    const auto step = log.value().next();
    if (!step) return step.error();
    if (step.value() == nullptr) break;
    const TrafficBatch& batch = step.value()->traffic;
    if (wish_.cars) note_events(batch);
    if (wish_.trajectories && step.value()->cars && batch.step % period_ == 0) {
      if (auto given = give_cars_on_road(batch); !given) return given;
    }
    if (wish_.messages) {
      if (auto given = give_frames(batch.said, batch.step - 1, false, batch.said_rsu); !given) return given;
      if (auto given = give_frames(batch.air, batch.step, true, {}); !given) return given;
      if (auto given = give_receptions(batch); !given) return given;
    }
    if (wish_.advice) {
      if (auto given = give_fates(batch); !given) return given;
    }
  }
  return wish_.cars ? give_cars() : Expected<Done>(Done{});
}

Expected<Done> Rows::give_cars_on_road(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.vehicle.size(); ++i) {
    const RecordedCar car = recorded_car(batch, i, facts_.road);
    auto given = row(SheetId::kTrajectories,
                     {real(time_s(batch.step)), whole(car.vehicle), text(name(car.lane)), flag(car.equipped),
                      flag(batch.state[i] == static_cast<std::uint8_t>(CarState::kExit)), real(car.position_m),
                      real(car.front.x_m), real(car.front.y_m), real(car.front.heading_rad * 180.0 / math::kPi),
                      real(car.speed_mps), real(car.acceleration_mps2), real(batch.commanded_mps2[i]),
                      real(batch.noise_mps2[i]), text(name(static_cast<GuidanceState>(batch.guidance[i])))});
    if (!given) return given;
  }
  return Done{};
}

Expected<Done> Rows::give_frames(const Frames& frames, Step sent, bool up, const std::vector<std::uint32_t>& rsus) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string sender = hex(frames.sender[i]);
    const std::string payload = hex(frames.payload_of(i));
    auto given = row(SheetId::kMessages,
                     {real(time_s(sent)), text(up ? "uplink" : "downlink"), up ? Cell() : whole(rsus[i]), text(sender),
                      whole(frames.sequence[i]), text(kind_name(frames.kind[i])), whole(frames.wire_bytes[i]),
                      real(frames.antenna_x_m[i]), real(frames.antenna_y_m[i]), text(payload)});
    if (!given) return given;
  }
  return Done{};
}

Expected<Done> Rows::give_receptions(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.uplink.size(); ++i) {
    auto given = row(SheetId::kReceptions,
                     {real(time_s(batch.step - 1)), whole(batch.uplink_vehicle[i]), whole(batch.uplink_rsu[i]),
                      text(reception_name(batch.uplink.fate[i])), real(batch.uplink.latency_ms[i])});
    if (!given) return given;
  }
  return Done{};
}

Expected<Done> Rows::give_fates(const TrafficBatch& batch) {
  constexpr std::uint32_t kUnknown = 0xffffffff;
  for (std::size_t i = 0; i < batch.fate.size(); ++i) {
    const bool decoded = batch.fate_issued[i] >= 0;
    auto given =
        row(SheetId::kAdvice,
            {real(time_s(batch.step)), decoded ? real(time_s(batch.fate_issued[i])) : Cell(), whole(batch.fate_rsu[i]),
             whole(batch.fate_sequence[i]), batch.fate_vehicle[i] == kUnknown ? Cell() : whole(batch.fate_vehicle[i]),
             text(name(static_cast<AdviceKind>(batch.fate_kind[i]))), real(batch.fate_commanded_mps2[i]),
             real(batch.fate_speed_mps[i]), text(name(static_cast<AdviceFate>(batch.fate[i]))),
             flag(batch.fate_again[i] != 0)});
    if (!given) return given;
  }
  return Done{};
}

void Rows::note_events(const TrafficBatch& batch) {
  for (std::size_t i = 0; i < batch.entered_vehicle.size(); ++i) {
    order_.push_back(batch.entered_vehicle[i]);
    cars_[batch.entered_vehicle[i]] = {.lane = batch.entered_lane[i],
                                       .equipped = batch.entered_equipped[i] != 0,
                                       .entered_s = time_s(batch.step),
                                       .entered_speed_mps = batch.entered_speed_mps[i],
                                       .desired_speed_mps = batch.entered_desired_speed_mps[i]};
  }
  for (std::size_t i = 0; i < batch.crossed_vehicle.size(); ++i) {
    cars_[batch.crossed_vehicle[i]].crossed_s = batch.crossed_time_s[i];
  }
  for (std::size_t i = 0; i < batch.left_vehicle.size(); ++i) {
    cars_[batch.left_vehicle[i]].left_s = batch.left_time_s[i];
  }
}

Expected<Done> Rows::give_cars() {
  const auto known = [](const std::optional<double>& value) { return value ? real(*value) : Cell(); };
  for (const std::uint32_t vehicle : order_) {
    const Car& car = cars_[vehicle];
    auto given = row(SheetId::kCars, {whole(vehicle), text(name(static_cast<Lane>(car.lane))), flag(car.equipped),
                                      real(car.entered_s), real(car.entered_speed_mps), real(car.desired_speed_mps),
                                      known(car.crossed_s), known(car.left_s)});
    if (!given) return given;
  }
  return Done{};
}

}  // namespace

Expected<ExportWish> everything(const Result& result) {
  const auto log = result.run_log(run_log::Level::kEvents, "an export");
  if (!log) return log.error();
  const run_log::Level level = log.value().facts().level;
  return ExportWish{.cars = true,
                    .trajectories = level >= run_log::Level::kSecond,
                    .signals = true,
                    .messages = level >= run_log::Level::kFull,
                    .advice = true};
}

Expected<Step> check_wish(const Result& result, const ExportWish& wish) {
  const auto needs = [&](bool wanted, run_log::Level level, const char* what) {
    if (!wanted) return Expected<Done>(Done{});
    const auto log = result.run_log(level, what);
    return log ? Expected<Done>(Done{}) : Expected<Done>(log.error());
  };
  const bool by_log = wish.signals && !fixed_plan(result);
  for (const auto& checked : {needs(wish.cars, run_log::Level::kEvents, "an export of cars"),
                              needs(wish.advice, run_log::Level::kEvents, "an export of advice"),
                              needs(by_log, run_log::Level::kEvents, "an export of signals"),
                              needs(wish.messages, run_log::Level::kFull, "an export of messages")}) {
    if (!checked) return checked.error();
  }
  return wish.trajectories ? period_of(result, wish.period) : Expected<Step>(1);
}

Expected<Done> give_sheets(const Result& result, const ExportWish& wish, Step period, SheetSink& sink) {
  return Rows(result, wish, period, sink).give();
}

}  // namespace lukou::report
