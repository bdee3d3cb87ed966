#include <utility>

#include "common/lockstep/clock_core.hpp"
#include "common/process/environment.hpp"
#include "common/process/log.hpp"
#include "common/scenario/actuation.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/lukou/launch/result_of_run.hpp"
#include "services/lukou/launch/run_request.hpp"
#include "services/recorder/recorder_node.hpp"
#include "services/rsu/process/rsu_setup.hpp"
#include "services/rsu/rsu_config.hpp"
#include "services/rsu/rsu_node.hpp"
#include "services/signal_controller/signal_controller_node.hpp"
#include "services/traffic_engine/engine_node.hpp"

namespace lukou::launch {
namespace {

/// Enough of the controller's newest batches for the first step of a returning RSU.
constexpr std::size_t kRecentSignals = 4;

/// All nodes of a run in one thread, in the order that the edges give: controller, engine, recorder, RSUs.
class InProcessRun {
 public:
  InProcessRun(const RunRequest& request, scenario::DirectiveLog log)
      : scenario_(request.scenario),
        protocol_(scenario::protocol(scenario_)),
        log_(std::move(log)),
        replays_(!request.replay.empty()),
        make_rsu_(request.make_rsu) {
    if (log_.stop) protocol_.end = std::min(protocol_.end, *log_.stop);
  }

  Expected<Done> build(const std::filesystem::path& folder) {
    auto plan = scenario::signal_plan(scenario_);
    if (!plan) return plan.error();
    actuation_ = scenario::actuation(scenario_.message());
    controller_.emplace(std::move(plan).value(), protocol_.signal_promise, actuation_);
    const auto config = engine_config(scenario_);
    if (!config) return config.error();
    engine_.emplace(config.value());
    if (replays_) engine_->replay(log_.computed);
    auto recorder = RecorderNode::create(scenario_, folder);
    if (!recorder) return recorder.error();
    recorder_.emplace(std::move(recorder).value());
    rsus_.resize(protocol_.rsus);
    heard_.resize(protocol_.rsus);
    for (std::uint32_t rsu = 0; rsu < protocol_.rsus; ++rsu)
      if (auto done = start(rsu, 1); !done) return done;
    return Done{};
  }

  [[nodiscard]] Step end() const { return protocol_.end; }
  [[nodiscard]] RecorderNode& recorder() { return *recorder_; }
  [[nodiscard]] std::size_t cars() const { return cars_; }
  /// The RSU that computes, or computed last.
  [[nodiscard]] std::uint32_t computing() const { return computing_; }

  Expected<Done> step(Step k) {
    if (auto done = follow_hearings(k); !done) return done;
    if (auto done = apply_directives(k); !done) return done;
    hand_over_requests(k);
    SignalBatch batch;
    if (controller_->step(k, batch)) {
      recent_signals_.push_back(batch);
      if (recent_signals_.size() > kRecentSignals) recent_signals_.erase(recent_signals_.begin());
      for (auto* edge : signal_edges()) {
        SignalBatch copy = batch;
        if (auto done = edge->accept(1, copy); !done) return done;
      }
    }
    for (std::uint32_t rsu = 0; rsu < protocol_.rsus; ++rsu) {
      heard_[rsu] = is_heard(rsus_[rsu], k) ? &rsus_[rsu].answer : nullptr;
    }
    if (auto done = engine_->step(k, engine_signal_.take(k), heard_, traffic_, air_); !done) return done;
    cars_ = traffic_.vehicle.size();
    for (computing_ = 0; computing_ < protocol_.rsus; ++computing_) {
      RsuLife& rsu = rsus_[computing_];
      if (rsu.node && k >= rsu.first) rsu.node->step(k, rsu.signal.take(k), air_, rsu.answer);
    }
    return recorder_->step(traffic_, recorder_signal_.take(k));
  }

 private:
  struct RsuLife {
    std::optional<RsuNode> node;
    Edge<SignalBatch> signal{EdgeTiming{}};
    RoadsideBatch answer;
    Step first = 0;          ///< its first step
    Step heard_from = 0;     ///< the engine hears it from this step on ...
    Step heard_to = kNever;  ///< ... until this one, not included
  };

  /// Whether what an RSU said in step k - 1 is heard in step k.
  static bool is_heard(const RsuLife& life, Step k) {
    return k > 0 && life.node && life.heard_from <= k && k < life.heard_to;
  }

  /// The requests of step k - 1 to the controller.
  void hand_over_requests(Step k) {
    if (!actuation_) return;
    for (const RsuLife& life : rsus_)
      if (is_heard(life, k)) controller_->hear(k, life.node->request());
  }

  Expected<std::unique_ptr<RsuAlgorithm>> algorithm_of(const RsuConfig& config) {
    const auto own = make_rsu_.find(config.rsu);
    if (own == make_rsu_.end()) return make_algorithm(config.algorithm, config.parameters);
    return own->second(setup_of(config));
  }

  Expected<Done> start(std::uint32_t rsu, std::uint32_t epoch) {
    const auto config = rsu_config(scenario_.message(), rsu);
    if (!config) return config.error();
    auto algorithm = algorithm_of(config.value());
    if (!algorithm) return algorithm.error();
    RsuLife& life = rsus_[rsu];
    life.node.emplace(config.value(), std::move(algorithm).value());
    life.node->measure_with(process::wall_s);
    life.signal = Edge<SignalBatch>(signal_timing(protocol_.signal_promise), epoch == 1);
    life.answer.epoch = epoch;
    return Done{};
  }

  /// Losses and returns of RSUs, as the record of an earlier run tells them.
  Expected<Done> follow_hearings(Step k) {
    for (const scenario::Hearing& hearing : log_.hearings) {
      if (hearing.rsu >= rsus_.size())
        return Error{"hearings", "no rsu" + std::to_string(hearing.rsu) + " in the scenario"};
      RsuLife& life = rsus_[hearing.rsu];
      if (hearing.epoch == 0 && hearing.from == k) {
        life.heard_to = k;
        life.node.reset();
      } else if (hearing.epoch != 0 && hearing.from - 1 == k) {
        // What the engine hears in step k + 1 is the first answer of a fresh RSU, of step k.
        if (auto done = start(hearing.rsu, hearing.epoch); !done) return done;
        life.first = k;
        life.heard_from = k + 1;
        life.heard_to = kNever;
        if (auto done = life.signal.begin(k); !done) return done;
        for (SignalBatch batch : recent_signals_)
          if (auto done = life.signal.accept(1, batch); !done) return done;
      }
    }
    return Done{};
  }

  Expected<Done> apply_directives(Step k) {
    std::vector<Directive> due;
    while (next_directive_ < log_.sets.size() && log_.sets[next_directive_].step <= k)
      due.push_back(log_.sets[next_directive_++]);
    if (due.empty()) return Done{};
    for (const Directive& directive : due)
      if (auto done = scenario::change(scenario_, directive.set); !done) return done;
    recorder_->add(due);
    controller_->use_plan(scenario::signal_plan(scenario_).value(), k);
    engine_->change(engine_config(scenario_).value());
    for (std::uint32_t rsu = 0; rsu < protocol_.rsus; ++rsu) {
      if (rsus_[rsu].node) rsus_[rsu].node->change(rsu_config(scenario_.message(), rsu).value());
    }
    return Done{};
  }

  std::vector<Edge<SignalBatch>*> signal_edges() {
    std::vector<Edge<SignalBatch>*> edges = {&engine_signal_, &recorder_signal_};
    for (auto& rsu : rsus_)
      if (rsu.node) edges.push_back(&rsu.signal);
    return edges;
  }

  scenario::Resolved scenario_;
  scenario::Protocol protocol_;
  scenario::DirectiveLog log_;
  bool replays_;  ///< the log is that of an earlier run
  std::map<std::uint32_t, MakeAlgorithm> make_rsu_;
  std::size_t next_directive_ = 0;
  std::optional<Actuation> actuation_;
  std::optional<SignalControllerNode> controller_;
  std::optional<EngineNode> engine_;
  std::optional<RecorderNode> recorder_;
  std::vector<RsuLife> rsus_;
  Edge<SignalBatch> engine_signal_{signal_timing(protocol_.signal_promise)};
  Edge<SignalBatch> recorder_signal_{signal_timing(protocol_.signal_promise)};
  std::vector<SignalBatch> recent_signals_;
  std::vector<const RoadsideBatch*> heard_;
  TrafficBatch traffic_;
  AirBatch air_;
  std::size_t cars_ = 0;
  std::uint32_t computing_ = 0;
};

/// A step. What an algorithm of a user throws leaves as it is, with the record closed before.
Expected<Done> step_or_close(InProcessRun& run, Step k) {
  try {
    return run.step(k);
  } catch (...) {
    static_cast<void>(run.recorder().close("lost:" + rsu_role(run.computing()), "its algorithm threw an exception"));
    throw;
  }
}

}  // namespace

RunReport run_in_process(const RunRequest& request, const Listener& listener) {
  const double begun_s = process::wall_s();
  RunReport report;
  const auto refuse = [&](int exit_code, const Error& error) {
    process::log_error(error.text());
    report.exit_code = exit_code;
    report.ended = error.text();
    return report;
  };
  scenario::DirectiveLog log;
  if (!request.replay.empty()) {
    auto loaded = scenario::load_directives(request.replay);
    if (!loaded) return refuse(process::kExitUsage, loaded.error());
    log = std::move(loaded).value();
  }
  const auto pace = pace_of(request.pace);
  if (!pace) return refuse(process::kExitUsage, pace.error());
  const bool stopped_in_log = log.stop.has_value();
  const auto folder = create_result(request);
  if (!folder) return refuse(process::kExitIo, folder.error());
  InProcessRun run(request, std::move(log));
  if (auto done = run.build(folder.value()); !done) return refuse(process::kExitUsage, done.error());

  RunEnd end;
  const double start_s = process::wall_s();
  end.start_up_s = start_s - begun_s;
  double told_s = start_s;
  bool early = false;
  for (Step k = 0; k <= run.end() && !early; ++k) {
    if (auto done = step_or_close(run, k); !done) {
      static_cast<void>(run.recorder().close("disk", done.error().text()));
      end.io_failed = true;
      process::log_error(done.error().text());
      break;
    }
    const double now_s = process::wall_s();
    if (pace.value() > 0.0) process::sleep_s(std::max(0.0, start_s + time_s(k) / pace.value() - now_s));
    if (listener && now_s - told_s > 0.1) {
      told_s = now_s;
      listener({.run = "in-process",
                .phase = "running",
                .step = k,
                .end = run.end(),
                .wall_s = now_s - start_s,
                .cars_in_system = static_cast<long long>(run.cars()),
                .pace = pace.value()});
    }
    early = run.recorder().anomaly().has_value() || process::stop_signal() != 0;
  }
  if (!end.io_failed) {
    const auto& anomaly = run.recorder().anomaly();
    end.anomaly = anomaly.has_value();
    end.interrupted_by = anomaly ? 0 : process::stop_signal();
    std::string by = stopped_in_log ? "stopped" : "done";
    if (end.interrupted_by != 0) by = "interrupted";
    if (anomaly) {
      by = "anomaly:" + *anomaly;
      end.text = *anomaly + " at step " + std::to_string(run.recorder().complete_to());
    }
    if (auto done = run.recorder().close(by, end.text); !done) {
      end.io_failed = true;
      process::log_error(done.error().text());
    }
  }
  end.wall_s = process::wall_s() - start_s;
  return finish_result(request, folder.value(), end);
}

}  // namespace lukou::launch
