#include "services/lukou/replay/replay_on_bus.hpp"

#include <map>
#include <utility>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/process/environment.hpp"
#include "services/lukou/replay/player.hpp"

namespace lukou::replay {
namespace {

constexpr double kTick_s = 0.02;
constexpr double kStateEvery_s = 0.1;
constexpr double kViewEvery_s = 0.03;
constexpr double kIdleView_s = 0.5;  ///< the same picture again, for observers that come later
constexpr double kLastWords_s = 0.5;
constexpr Step kStepsAtOnce = 200;  ///< between two looks at the viewers' requests

/// Speaks as the clock and the recorder of the run did.
class Projector {
 public:
  Projector(Recording recording, std::string run, bus::Participant& participant)
      : recording_(std::move(recording)),
        run_(std::move(run)),
        self_(participant.self()),
        player_(recording_.last(), process::wall_s()),
        up_(participant),
        control_(participant),
        states_(participant),
        views_(participant) {}

  [[nodiscard]] bool stopped() const { return player_.stopped(); }

  void hear() {
    up_.take([this](Up& message, const bus::SampleInfo& info) {
      if (info.alive && message.kind == Up::Kind::kRequest) requests_.push_back(message);
      if (!info.alive) answers_.erase(info.producer);
    });
    if (requests_.empty()) return;
    // As a clock: as soon as the answer can reach whoever asked.
    const auto reached = control_.matched();
    std::erase_if(requests_, [&](const Up& request) {
      if (!reached.contains(request.incarnation)) return false;
      answer(request);
      return true;
    });
  }

  Expected<Done> play() {
    const auto at = recording_.go_towards(player_.due(process::wall_s()), kStepsAtOnce);
    if (!at) return at.error();
    at_ = at.value();
    player_.reached(process::wall_s(), at_);
    return Done{};
  }

  void show() {
    const double now_s = process::wall_s();
    const RunState state = this->state();
    if (state.phase != told_.phase || now_s - told_s_ > kStateEvery_s) {
      states_.write(state);
      told_ = state;
      told_s_ = now_s;
    }
    if (player_.seeking() || now_s - shown_s_ < (at_ == shown_ ? kIdleView_s : kViewEvery_s)) return;
    recording_.fill(view_);
    views_.write(view_);
    shown_ = at_;
    shown_s_ = now_s;
  }

  void finish() {
    states_.write(state());
    control_.finish(kLastWords_s);
    states_.finish(kLastWords_s);
  }

 private:
  /// The pictures come from here, too.
  [[nodiscard]] RunState state() const {
    RunState state = player_.state(run_);
    state.recorder = self_;
    return state;
  }

  void answer(const Up& request) {
    Control reply{.kind = Control::Kind::kReply,
                  .clock = self_,
                  .sequence = sequence_++,
                  .to = request.incarnation,
                  .number = request.number};
    if (request.text == "scenario") {
      reply.text = recording_.scenario();
      for (const Directive& directive : recording_.directives()) {
        reply.directive_step.push_back(directive.step);
        reply.directive_set.push_back(directive.set);
      }
    } else if (request.text == "recording") {
      reply.text = std::to_string(recording_.last());
    } else {
      // Who missed the answer asks again, under the same number.
      Answer& answer = answers_[request.incarnation];
      if (answer.number != request.number) {
        const auto said = player_.request(process::wall_s(), request.text);
        answer = {request.number, said.ok(), said ? said.value() : said.error().text()};
      }
      reply.ok = answer.ok;
      reply.text = answer.text;
    }
    control_.write(reply);
  }

  struct Answer {
    std::uint64_t number = 0;
    bool ok = true;
    std::string text;
  };

  Recording recording_;
  std::string run_;
  Incarnation self_;
  Player player_;
  bus::Reader<Up> up_;
  bus::Writer<Control> control_;
  bus::Writer<RunState> states_;
  bus::Writer<View> views_;
  std::vector<Up> requests_;  ///< not answered yet
  std::map<Incarnation, Answer> answers_;
  std::uint64_t sequence_ = 0;
  RunState told_;
  double told_s_ = -1.0;
  View view_;
  Step at_ = -1;
  Step shown_ = -1;
  double shown_s_ = -1.0;
};

}  // namespace

Expected<Done> replay_on_bus(Recording recording, const bus::Address& address, launch::ConsoleProcess* console) {
  auto participant = bus::Participant::join(address, kClockRole, process::new_incarnation());
  if (!participant) return participant.error();
  participant.value()->keep_writing_while([] { return process::stop_signal() == 0; });
  Projector projector(std::move(recording), address.run, *participant.value());
  if (console != nullptr) console->show(address);
  while (process::stop_signal() == 0 && !projector.stopped()) {
    participant.value()->wait(kTick_s);
    projector.hear();
    if (auto done = projector.play(); !done) return done;
    projector.show();
    if (console == nullptr) continue;
    console->poll();
    if (!console->alive()) break;
  }
  projector.finish();
  return Done{};
}

}  // namespace lukou::replay
