#include "services/console/hub.hpp"

#include <array>
#include <charconv>
#include <utility>

#include "common/scenario/scenario_steps.hpp"
#include "console.pb.h"

namespace lukou::console {
namespace {

constexpr double kStatisticsEvery_s = 0.2;
constexpr double kStatusEvery_s = 0.25;
constexpr std::size_t kRequestsMax = 64;  ///< not answered yet, of all viewers
constexpr std::size_t kRequestBytesMax = 32U << 10U;
/// What a viewer may ask of the clock; other requests of the bus are not the page's business.
constexpr std::array<std::string_view, 6> kVerbs = {"pause", "resume", "step", "pace", "stop", "set"};
/// The same of a recording.
constexpr std::array<std::string_view, 6> kReplayVerbs = {"pause", "resume", "step", "pace", "stop", "seek"};

Bytes bytes_of(const ToPage& message) { return std::make_shared<const std::string>(message.SerializeAsString()); }

std::string viewer_text(ViewerId viewer) { return "viewer " + std::to_string(viewer); }

Event event_of(Step step, const std::string& kind, const std::string& text) {
  Event event;
  event.set_step(step);
  event.set_kind(kind);
  event.set_text(text);
  return event;
}

/// The step in "... from step 51 (5.1 s)" or "at step 3000 (300.0 s)".
std::optional<Step> step_in(const std::string& text) {
  const std::size_t at = text.rfind(" step ");
  Step step = 0;
  if (at == std::string::npos ||
      std::from_chars(text.data() + at + 6, text.data() + text.size(), step).ec != std::errc()) {
    return std::nullopt;
  }
  return step;
}

/// Why the clock shall not hear this; empty: nothing is wrong.
std::string wrong_with(const std::string& text, bool recording) {
  if (text.size() > kRequestBytesMax) return "a request of more than 32 kB";
  if (text.find('\0') != std::string::npos) return "a request with a zero in it";
  const std::string verb = text.substr(0, text.find(' '));
  for (const std::string_view known : recording ? kReplayVerbs : kVerbs) {
    if (verb == known) return "";
  }
  if (recording && (verb == "set" || verb == "restart")) return "nothing can be changed in a recording";
  return "`" + verb + "` is not a request; use pause, resume, step, pace, stop" +
         (recording ? " or seek" : ", set or restart");
}

}  // namespace

Hub::Hub(bool may_restart) : may_restart_(may_restart) {}
Hub::~Hub() = default;

void Hub::begin(RunStory story, const std::vector<Directive>& so_far) {
  story_ = std::move(story);
  past_.clear();
  for (const Viewer::State state : {Viewer::kStatus, Viewer::kStatistics, Viewer::kPicture}) newest_[state].bytes = {};
  picture_with_program_.reset();
  program_version_ = 0;
  requests_.clear();
  under_way_.reset();
  told_.clear();
  rsus_heard_.clear();
  pace_ = {};
  figures_.reset();
  phase_ = RunPhase::kForming;
  step_ = -1;
  sought_.reset();
  seeks_ = 0;
  status_.clear();
  statistics_s_ = status_s_ = -1.0;
  for (auto& [id, viewer] : viewers_) viewer.forget();
  for (const Directive& directive : so_far) {
    story_->change(directive);
    past_.add(event_of(directive.step, "directive", directive.set));
  }
  for (auto& [id, viewer] : viewers_) greet(id, viewer);
}

void Hub::greet(ViewerId id, Viewer& viewer) {
  ToPage first;
  Hello& hello = *first.mutable_hello();
  hello = story_->hello();
  hello.set_viewer(id);
  hello.set_may_restart(may_restart_ && !story_->recorded_to());
  viewer.push(bytes_of(first));
  ToPage past;
  *past.mutable_history() = past_.message();
  viewer.push(bytes_of(past));
}

void Hub::hear(const Control& control) {
  if (!story_) return;
  // Of a recording all were known when it began.
  for (std::size_t i = 0; i < control.directive_step.size() && !story_->recorded_to(); ++i) {
    add_directive({control.directive_step[i], control.directive_set[i]});
  }
  if (control.kind == Control::Kind::kFence) add_event(step_, "lost", rsu_role(control.rsu));
  for (std::size_t i = 0; i < control.attach_rsu.size(); ++i) {
    add_event(control.attach_from[i], "returned", rsu_role(control.attach_rsu[i]));
  }
  if (control.kind == Control::Kind::kAbort) add_event(step_, "lost", control.culprit + " " + control.text);
}

void Hub::add_directive(const Directive& directive) {
  story_->change(directive);
  if (!told_.empty() && told_.front() == directive.set) {
    told_.pop_front();
    return;
  }
  add_event(directive.step, "directive", directive.set);
}

void Hub::jump(Step to) {
  past_.forget_from(to);
  ++seeks_;
  sought_.reset();
  pace_ = {};
  statistics_s_ = -1.0;
}

void Hub::show(const View& view, double now_s) {
  if (!story_) return;
  // Views of the place before the seek may still be under way.
  if (view.step < step_ || (sought_ && *sought_ > step_ && view.step >= *sought_)) jump(view.step);
  pace_.note(now_s, view.step);
  rsus_heard_ = view.step > 0 ? view.heard_epoch : std::vector<std::uint32_t>();
  if (view.step == step_ && newest_[Viewer::kPicture].bytes) return;
  step_ = view.step;
  ToPage message;
  Picture& picture = *message.mutable_picture();
  picture = picture_of(view);
  publish(Viewer::kPicture, message);
  const RunStory::Program program = story_->program_at(view.step);
  if (program_version_ == 0 || program.running->from != program_from_) {
    program_from_ = program.running->from;
    ++program_version_;
  }
  *picture.mutable_program() = message_of(program.running->plan, program.running->offset);
  picture.set_program_from(program.cycle_start);
  picture_with_program_ = bytes_of(message);
  figures_ = std::make_unique<Statistics>(statistics_of(view));
  publish_figures(now_s);
}

void Hub::publish_figures(double now_s) {
  if (!figures_ || now_s - statistics_s_ < kStatisticsEvery_s) return;
  statistics_s_ = now_s;
  figures_->set_pace_achieved(pace_.pace());
  figures_->set_seeks(seeks_);
  past_.add(*figures_);
  ToPage message;
  message.mutable_statistics()->Swap(figures_.get());
  figures_.reset();
  publish(Viewer::kStatistics, message);
}

void Hub::tell(const RunState& state, double clock_silent_s, double now_s) {
  if (!story_) return;
  publish_figures(now_s);  // of the last step before a pause, too
  if (state.phase != phase_) {
    phase_ = state.phase;
    add_event(state.recorded, "phase", std::string(name(phase_)));
  }
  ToPage message;
  RunStatus& status = *message.mutable_status();
  const std::uint32_t rsus = scenario::protocol(story_->scenario()).rsus;
  status = status_of(state, rsus, rsus_heard_, clock_silent_s);
  std::string news = status.phase() + status.text() + status.culprit() + std::to_string(state.pace);
  for (const Member& member : status.members()) news += member.alive() ? '1' : '0';
  if (news == status_ && now_s - status_s_ < kStatusEvery_s) return;
  status_ = news;
  status_s_ = now_s;
  status.set_pace_achieved(phase_ == RunPhase::kRunning ? pace_.pace() : 0.0);
  publish(Viewer::kStatus, message);
}

std::optional<std::string> Hub::take_request() {
  if (under_way_ || requests_.empty()) return std::nullopt;
  under_way_ = std::move(requests_.front());
  requests_.pop_front();
  return under_way_->text;
}

void Hub::answered(bool ok, const std::string& text) {
  if (!under_way_) return;
  const Asked asked = *std::exchange(under_way_, std::nullopt);
  reply(asked.viewer, asked.number, ok, text);
  if (!ok) return add_event(step_, "refused", text);
  // "seek SECONDS" is answered with "at step N (T s)".
  if (asked.text.starts_with("seek ")) sought_ = step_in(text);
  if (!asked.text.starts_with("set ")) return;
  // "set PATH=VALUE" is answered with "PATH=VALUE from step N (T s)".
  const std::string set = asked.text.substr(4);
  const Step from = step_in(text).value_or(step_ + 1);
  told_.push_back(set);
  story_->change({from, set});
  add_event(from, "directive", set);
}

std::optional<std::uint64_t> Hub::take_restart() { return std::exchange(restart_, std::nullopt); }

ViewerId Hub::came() {
  const ViewerId id = ++last_viewer_;
  Viewer& viewer = viewers_[id];
  control_.came(id);
  if (story_) greet(id, viewer);
  publish_hands();
  return id;
}

void Hub::gone(ViewerId viewer) {
  if (viewers_.erase(viewer) == 0) return;
  control_.gone(viewer);
  publish_hands();
}

bool Hub::said(ViewerId viewer, std::string_view words) {
  FromPage message;
  if (!message.ParseFromArray(words.data(), static_cast<int>(words.size()))) return false;
  const auto from = viewers_.find(viewer);
  if (from == viewers_.end()) return false;
  const ViewerId before = control_.holder();
  switch (message.what_case()) {
    case FromPage::kDrawn:
      from->second.drawn();
      break;
    case FromPage::kRequest:
      ask(viewer, message.request());
      break;
    case FromPage::kTakeControl:
      control_.take(viewer, message.take_control().from_another());
      break;
    case FromPage::kReleaseControl:
      control_.release(viewer);
      break;
    case FromPage::WHAT_NOT_SET:
      return false;
  }
  if (control_.holder() == before) return true;
  const std::string whose = before == 0 ? "" : " from " + viewer_text(before);
  const ViewerId holder = control_.holder();
  add_event(step_, "hands",
            holder == 0 ? viewer_text(viewer) + " released control" : viewer_text(holder) + " took control" + whose);
  publish_hands();
  return true;
}

void Hub::ask(ViewerId viewer, const Request& request) {
  const auto refuse = [&](const std::string& why) { reply(viewer, request.number(), false, why); };
  if (!story_) return refuse("no run is there yet");
  const ViewerId holder = control_.holder();
  if (holder != viewer) {
    return refuse(holder == 0 ? "nobody has control; take it first" : viewer_text(holder) + " has control");
  }
  const std::string& text = request.text();
  const bool recording = story_->recorded_to().has_value();
  if (text.starts_with("restart ") && !recording) {
    if (!may_restart_) return refuse("nobody is there to restart this run; `lukou run --console` would be");
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data() + 8, text.data() + text.size(), seed);
    if (error != std::errc() || end != text.data() + text.size())
      return refuse("restart: needs a seed, a whole number");
    restart_ = seed;
    add_event(step_, "phase", "restart with seed " + std::to_string(seed));
    return reply(viewer, request.number(), true, "restarts with seed " + std::to_string(seed));
  }
  if (const std::string wrong = wrong_with(text, recording); !wrong.empty()) return refuse(wrong);
  if (phase_ >= RunPhase::kEnded) return refuse("the run has ended");
  if (requests_.size() >= kRequestsMax) return refuse("too many requests wait for their answer");
  requests_.push_back({viewer, request.number(), text});
}

void Hub::reply(ViewerId viewer, std::uint32_t number, bool ok, const std::string& text) {
  const auto to = viewers_.find(viewer);
  if (to == viewers_.end()) return;
  ToPage message;
  Reply& reply = *message.mutable_reply();
  reply.set_number(number);
  reply.set_ok(ok);
  reply.set_text(text);
  to->second.push(bytes_of(message));
}

void Hub::add_event(Step step, const std::string& kind, const std::string& text) {
  ToPage message;
  *message.mutable_event() = event_of(step, kind, text);
  past_.add(message.event());
  if (!story_) return;
  const Bytes bytes = bytes_of(message);
  for (auto& [id, viewer] : viewers_) viewer.push(bytes);
}

void Hub::publish_hands() {
  ToPage message;
  message.mutable_hands()->set_holder(control_.holder());
  message.mutable_hands()->set_viewers(static_cast<std::uint32_t>(control_.viewers()));
  publish(Viewer::kHands, message);
}

void Hub::publish(Viewer::State state, const ToPage& message) {
  ++newest_[state].version;
  newest_[state].bytes = bytes_of(message);
}

Bytes Hub::picture_for(Viewer& viewer) {
  if (viewer.program() == program_version_) return newest_[Viewer::kPicture].bytes;
  viewer.knows_program(program_version_);
  return picture_with_program_;
}

Bytes Hub::next(ViewerId id) {
  const auto found = viewers_.find(id);
  if (found == viewers_.end()) return nullptr;
  Viewer& viewer = found->second;
  if (Bytes words = viewer.pop()) return words;
  if (!story_) return nullptr;  // the hello comes first
  for (const Viewer::State state : {Viewer::kHands, Viewer::kStatus, Viewer::kStatistics, Viewer::kPicture}) {
    const Newest& newest = newest_[state];
    if (!newest.bytes || !viewer.wants(state, newest.version)) continue;
    viewer.sent(state, newest.version);
    return state == Viewer::kPicture ? picture_for(viewer) : newest.bytes;
  }
  return nullptr;
}

bool Hub::too_slow(ViewerId viewer) const {
  const auto found = viewers_.find(viewer);
  return found != viewers_.end() && found->second.too_slow();
}

}  // namespace lukou::console
