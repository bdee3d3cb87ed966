#include "common/process/options.hpp"
#include "common/process/stepping.hpp"
#include "common/scenario/scenario_steps.hpp"
#include "services/recorder/recorder_node.hpp"

using namespace lukou;

namespace {

constexpr Step kCreditEvery = 50;       ///< steps; a credit means written: a kill does not take it back
constexpr double kViewEvery_s = 0.05;   ///< wall time between two pictures
constexpr double kIdleView_s = 0.5;     ///< the same picture again, for observers that come later
constexpr double kCreditEvery_s = 0.5;  ///< wall time, for slow paces

/// How the manifest says that a run ended.
std::string ended_by(const process::Member& member) {
  using Kind = process::MemberEnd::Kind;
  const process::MemberEnd& end = member.end();
  if (end.kind == Kind::kEnded) return member.stopped().empty() ? "done" : member.stopped();
  // With its launcher everybody ends, and so does everybody where Ctrl-C cannot end the run in its own way: whom that
  // hit first says nothing.
  if (process::stop_signal() == process::launcher_died_signal()) return "lost:lukou";
  if (end.kind == Kind::kAborted) {
    return (end.text.starts_with("has not finished") ? "stalled:" : "lost:") + end.culprit;
  }
  if (process::terminated_by_launcher()) return "interrupted";
  return end.kind == Kind::kClockLost ? "lost:clock" : "lost:" + std::string(kRecorderRole);
}

/// The recorder's part in a run.
class Recorder {
 public:
  Recorder(process::Member& member, RecorderNode node, Step promise)
      : member_(member), node_(std::move(node)), signal_(signal_timing(promise)), views_(member.participant()) {}

  Expected<Done> hear(TrafficBatch& batch, std::uint32_t epoch) { return traffic_.accept(epoch, batch); }
  Expected<Done> hear(SignalBatch& batch, std::uint32_t epoch) { return signal_.accept(epoch, batch); }

  [[nodiscard]] std::string waiting_for(Step k) {
    if (closed_) return "clock";
    if (!traffic_.ready(k)) return std::string(kEngineRole);
    return signal_.ready(k) ? std::string() : std::string(kControllerRole);
  }

  void execute(Step k) {
    node_.add(member_.due(k));
    const SignalBatch* signal = signal_.take(k);
    if (auto done = node_.step(*traffic_.take(k), signal); !done) return fail(done.error());
    show(kViewEvery_s);
    const bool last = member_.last_step() && k == *member_.last_step();
    if (node_.anomaly() || last) return close(node_.anomaly() ? "anomaly:" + *node_.anomaly() : "");
    const double now_s = process::wall_s();
    if (k < credited_ + kCreditEvery && now_s - credited_s_ < kCreditEvery_s) return;
    credited_ = k;
    credited_s_ = now_s;
    if (auto done = node_.flush(); !done) return fail(done.error());
    member_.send({.kind = Up::Kind::kCredit, .step = k});
  }

  /// Between the steps: what the last ones left unshown, or the same once more.
  void show_if_idle() { show(node_.complete_to() > shown_ ? kViewEvery_s : kIdleView_s); }

  /// Publishes the picture, unless the last one is younger.
  void show(double every_s) {
    const double now_s = process::wall_s();
    if (now_s - shown_s_ < every_s || node_.complete_to() < 0) return;
    shown_s_ = now_s;
    shown_ = node_.complete_to();
    node_.fill(view_);
    views_.write(view_);
  }

  /// The grant of the last step may say so after the step was committed.
  void close_if_last(Step next) {
    if (!closed_ && member_.last_step() && next > *member_.last_step()) close("");
  }

  /// Returns the exit code.
  int finish() {
    if (io_failed_) return process::kExitIo;
    if (!closed_) {
      const auto done = node_.close(ended_by(member_), member_.end().text);
      if (!done) process::log_error(done.error().text());
      if (!done) return process::kExitIo;
    }
    if (node_.anomaly()) return process::kExitAnomaly;
    return process::report_end(member_.end());
  }

 private:
  void close(const std::string& anomaly) {
    const std::string by = !anomaly.empty() ? anomaly : member_.stopped().empty() ? "done" : member_.stopped();
    const std::string text =
        node_.anomaly() ? *node_.anomaly() + " at step " + std::to_string(node_.complete_to()) : "";
    if (auto done = node_.close(by, text); !done) return fail(done.error());
    closed_ = true;
    show(0.0);
    member_.send({.kind = Up::Kind::kClosed, .step = node_.complete_to(), .text = text});
  }

  /// The disk: what is written stays, the manifest says how far, as far as it can still be written.
  void fail(const Error& error) {
    process::log_error(error.text());
    io_failed_ = true;
    static_cast<void>(node_.close("disk", error.text()));
    member_.finish({process::MemberEnd::Kind::kAborted, std::string(kRecorderRole), error.text()});
  }

  process::Member& member_;
  RecorderNode node_;
  Edge<TrafficBatch> traffic_{kSameStep};
  Edge<SignalBatch> signal_;
  bus::Writer<View> views_;
  View view_;
  double shown_s_ = 0.0;
  Step shown_ = -1;
  Step credited_ = -1;
  double credited_s_ = process::wall_s();
  bool closed_ = false;
  bool io_failed_ = false;
};

int run(int argc, char** argv) {
  const auto options = process::member_options(
      argc, argv, "The record of a run.", {process::kNoWatchdog, {"--out", "result folder, made by the launcher"}});
  if (!options) return std::stoi(options.error().what);
  process::catch_terminate_signal();
  const std::string role(kRecorderRole);
  auto created = process::Member::create(
      {.role = role, .address = options.value().address, .watchdog = !options.value().has("--no-watchdog")});
  if (!created) return process::report_start(created.error(), process::kExitAborted);
  process::Member& member = *created.value();
  bus::Reader<TrafficBatch> traffic_in(member.participant());
  bus::Reader<SignalBatch> signal_in(member.participant());
  member.faces(Topic::kTraffic, traffic_in);
  member.faces(Topic::kSignal, signal_in);

  const auto welcome = member.join();
  if (!welcome) return process::report_start(welcome.error(), process::kExitUsage);
  auto scenario = scenario::load_text(welcome.value(), "welcome", "/");
  if (!scenario) return process::report_start(scenario.error(), process::kExitUsage);
  auto node = RecorderNode::create(scenario.value(), options.value().value("--out"));
  if (!node) return process::report_start(node.error(), process::kExitIo);

  Recorder recorder(member, std::move(node).value(), scenario::signal_promise(scenario.value()));
  Step next = 0;
  process::run_steps(
      member,
      [&] {
        const auto accept = [&](auto& batch, const bus::SampleInfo& info) { return recorder.hear(batch, info.epoch); };
        process::hear(member, traffic_in, accept);
        process::hear(member, signal_in, accept);
        recorder.close_if_last(next);
        recorder.show_if_idle();
      },
      [&](Step k) { return recorder.waiting_for(k); },
      [&](Step k) {
        recorder.execute(k);
        next = k + 1;
      });
  return recorder.finish();
}

}  // namespace

int main(int argc, char** argv) {
  return process::guarded("recorder", [&] { return run(argc, argv); });
}
