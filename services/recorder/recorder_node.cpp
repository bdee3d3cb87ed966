#include "services/recorder/recorder_node.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/core/hash.hpp"
#include "common/core/version.hpp"
#include "common/results/manifest.hpp"
#include "common/results/result_folder.hpp"
#include "services/recorder/summary.hpp"

namespace lukou {
namespace {

constexpr std::size_t kFlushBytes = 256U << 10U;

std::string_view name_of(FrameKind kind) {
  switch (kind) {
    case FrameKind::kBsm:
      return "bsm";
    case FrameKind::kMap:
      return "map";
    case FrameKind::kSpat:
      return "spat";
    case FrameKind::kRsm:
      return "rsm";
    case FrameKind::kRsc:
      return "rsc";
  }
  return "unknown";
}

results::RadioRow row_of(const ReceptionFigures& figures) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {.direction = name(figures.direction),
          .kind = name_of(figures.kind),
          .sent = figures.sent,
          .heard = figures.heard,
          .lost_random = figures.lost_random,
          .lost_burst = figures.lost_burst,
          .lost_range = figures.lost_range,
          .lost_path_loss = figures.lost_path_loss,
          .lost_collision = figures.lost_collision,
          .lost_half_duplex = figures.lost_half_duplex,
          .lost_outage = figures.lost_outage,
          .duplicates = figures.duplicates,
          .latency_mean_ms = figures.latency_mean_ms.value_or(kUnknown),
          .latency_p95_ms = figures.latency_p95_ms.value_or(kUnknown),
          .latency_p99_ms = figures.latency_p99_ms.value_or(kUnknown),
          .busy_ratio = figures.busy_ratio.value_or(kUnknown)};
}

}  // namespace

Expected<RecorderNode> RecorderNode::create(const scenario::Resolved& scenario, std::filesystem::path folder) {
  auto tables = results::RunTables::create(folder);
  if (!tables) return tables.error();
  const RecorderConfig config = recorder_config(scenario);
  auto events = results::EventTables::create(folder, {.stops = config.record_stops,
                                                      .guidance = config.record_guidance,
                                                      .requests = config.actuated,
                                                      .safety = config.record_safety});
  if (!events) return events.error();
  RecorderNode node(config, scenario::hash(scenario), std::move(folder), std::move(tables).value(),
                    std::move(events).value());
  if (config.log == run_log::Level::kNone) return node;
  auto log = run_log::RunLogWriter::create(node.folder_, {.level = config.log,
                                                          .lukou_version = std::string(version()),
                                                          .scenario = scenario::text(scenario),
                                                          .scenario_hash = node.scenario_hash_,
                                                          .steps_planned = config.end});
  if (!log) return log.error();
  node.run_log_.emplace(std::move(log).value());
  return node;
}

RecorderNode::RecorderNode(const RecorderConfig& config, std::string scenario_hash, std::filesystem::path folder,
                           results::RunTables tables, results::EventTables events)
    : config_(config),
      scenario_hash_(std::move(scenario_hash)),
      folder_(std::move(folder)),
      tables_(std::move(tables)),
      events_(std::move(events)),
      radio_(folder_),
      picture_(config_.measures) {
  if (config_.record_safety) safety_.emplace(config_.measures.road, config_.measures.vehicle_length_m);
}

void RecorderNode::add(const std::vector<Directive>& directives) {
  log_.sets.insert(log_.sets.end(), directives.begin(), directives.end());
  due_ = directives;
}

Expected<Done> RecorderNode::step(TrafficBatch& traffic, const SignalBatch* new_signal) {
  if (auto done = picture_.add(traffic, new_signal); !done) return done;
  step_ = traffic.step;
  if (run_log_) {
    if (auto done = run_log_->add(due_, new_signal, traffic); !done) return done;
    due_.clear();
  }
  if (new_signal != nullptr) {
    if (auto done = requests_.add(*new_signal); !done) return done;
    for (const RequestRow& row : requests_.rows()) events_.add(row);
  }
  requests_.add_fixed_plan(traffic.requests_refused);
  note_hearing(traffic);
  note_computing(traffic);
  for (const FinishedCar& car : picture_.measures().finished()) tables_.add_car(car);
  add_events(traffic);
  if (step_ > 0) add_rows();
  look_for_anomaly(traffic);
  if (step_ > 0 && step_ % kStepsPerSecond == 0) {
    if (auto done = add_radio_rows(picture_.last_second()); !done) return done;
  }
  picture_.keep(traffic);
  if (tables_.buffered_bytes() + events_.buffered_bytes() < kFlushBytes) return Done{};
  return flush();
}

Expected<Done> RecorderNode::flush() {
  if (auto done = radio_.flush(); !done) return done;
  if (auto done = events_.flush(); !done) return done;
  return tables_.flush();
}

void RecorderNode::add_events(const TrafficBatch& traffic) {
  for (const FinishedStop& stop : picture_.measures().finished_stops()) events_.add(stop);
  if (safety_) {
    safety_->add(traffic);
    for (const Encounter& encounter : safety_->finished()) events_.add(encounter);
  }
  if (!config_.record_guidance) return;
  ledger_.add(traffic);
  for (const SettledAdvice& advice : ledger_.settled()) events_.add(advice);
}

Expected<Done> RecorderNode::add_radio_rows(const std::vector<ReceptionFigures>& second) {
  radio_rows_to_ = step_;
  for (const ReceptionFigures& figures : second) {
    if (auto done = radio_.add(step_, row_of(figures)); !done) return done;
  }
  return Done{};
}

void RecorderNode::add_rows() {
  results::StopRow stop;
  results::RoadRow road;
  results::StopTimeRow stop_time;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const LaneTotals& totals = picture_.measures().lanes()[lane];
    stop.system_total += stop.stops[lane] = totals.stops;
    stop.standing_now += totals.standing_now;
    road.left_lanes_total += road.crossed[lane] = totals.crossed;
    stop_time.system_total_steps += stop_time.stood_steps[lane] = static_cast<std::int64_t>(totals.standing_steps);
  }
  // 0 / 0 is not a number: not known yet.
  const auto entered = static_cast<double>(picture_.measures().entered());
  stop.mean_per_vehicle = static_cast<double>(stop.system_total) / entered;
  road.mean_per_lane = static_cast<double>(road.left_lanes_total) / kLanes;
  road.left_system_total = picture_.measures().left();
  stop_time.mean_per_vehicle_s = static_cast<double>(stop_time.system_total_steps) / 10.0 / entered;
  tables_.add_step(step_, stop, road, stop_time);
}

void RecorderNode::note_hearing(const TrafficBatch& traffic) {
  // An undisturbed run hears epoch 1 from step 1 on and needs no entry.
  if (heard_epoch_.empty()) heard_epoch_.assign(traffic.heard_epoch.size(), 1);
  if (step_ == 0) return;
  for (std::uint32_t rsu = 0; rsu < traffic.heard_epoch.size(); ++rsu) {
    if (traffic.heard_epoch[rsu] == heard_epoch_[rsu]) continue;
    heard_epoch_[rsu] = traffic.heard_epoch[rsu];
    log_.hearings.push_back({rsu, step_, heard_epoch_[rsu]});
  }
}

void RecorderNode::note_computing(const TrafficBatch& traffic) {
  for (std::uint32_t rsu = 0; rsu < traffic.computing_ms.size(); ++rsu) {
    const std::uint32_t took_ms = traffic.computing_ms[rsu];
    if (took_ms == 0 || rsu >= config_.rsu_measured.size() || !config_.rsu_measured[rsu]) continue;
    const Step answered = step_ - 1;
    log_.computed.push_back({rsu, answered, took_ms});
    if (took_ms <= kStep_ms) continue;
    ++deadline_misses_;
    if (config_.record_guidance) events_.add(MissedDeadline{step_, answered, rsu, took_ms});
  }
}

void RecorderNode::look_for_anomaly(const TrafficBatch& traffic) {
  if (anomaly_) return;
  if (picture_.measures().collisions() > 0) {
    anomaly_ = "collision";
  } else if (traffic.overflow != 0 && config_.stop_on_overflow) {
    anomaly_ = "overflow";
  }
}

Expected<Done> RecorderNode::close(const std::string& ended_by, const std::string& culprit) {
  const Step complete_to = std::max<Step>(step_, 0);
  if (complete_to < config_.end && (ended_by == "stopped" || ended_by == "interrupted")) log_.stop = complete_to;
  if (complete_to > radio_rows_to_) {
    if (auto done = add_radio_rows(picture_.cut_second()); !done) return done;
  }
  // What lasts at the end ends with it.
  for (const FinishedStop& stop : picture_.measures().lasting_stops()) events_.add(stop);
  for (const SettledAdvice& advice : ledger_.close()) events_.add(advice);
  SummaryExtras extras;
  if (safety_) {
    for (const Encounter& encounter : safety_->close()) events_.add(encounter);
    extras.safety = safety_->figures();
  }
  if (auto done = radio_.sync(); !done) return done;
  if (auto done = events_.sync(); !done) return done;
  if (auto done = tables_.sync(); !done) return done;
  if (run_log_) {
    if (auto done = run_log_->close(); !done) return done;
  }
  if (config_.actuated || requests_.figures().asked > 0) extras.requests = requests_.figures();
  if (std::ranges::find(config_.rsu_measured, true) != config_.rsu_measured.end()) {
    extras.deadline_misses = deadline_misses_;
  }
  const std::string summary = summary_json(picture_.measures().figures(), complete_to, config_.measures.warmup_s,
                                           picture_.radio_modelled(), extras);
  const std::string directives = scenario::text(log_);
  if (auto done = results::write_file(folder_ / "summary.json", summary); !done) return done;
  if (auto done = results::write_file(folder_ / "directives.textproto", directives); !done) return done;
  results::Manifest manifest{.lukou_version = std::string(version()),
                             .scenario_hash = scenario_hash_,
                             .seed = config_.seed,
                             .steps_planned = config_.end,
                             .complete_to_step = complete_to,
                             .ended_by = ended_by,
                             .culprit = culprit,
                             .files = tables_.entries()};
  for (results::FileEntry& entry : events_.entries()) manifest.files.push_back(std::move(entry));
  if (auto entry = radio_.entry()) manifest.files.push_back(*entry);
  if (run_log_) manifest.files.push_back({run_log::kRunLog, run_log_->sha256(), std::nullopt});
  manifest.files.push_back({"directives.textproto", sha256_hex(directives), std::nullopt});
  manifest.files.push_back({"scenario.textproto", scenario_hash_, std::nullopt});
  manifest.files.push_back({"summary.json", sha256_hex(summary), std::nullopt});
  std::ranges::sort(manifest.files, {}, &results::FileEntry::name);
  return results::write_file(folder_ / results::kManifest, results::text(manifest));
}

}  // namespace lukou
