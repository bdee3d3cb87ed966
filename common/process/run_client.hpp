#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"

namespace lukou::process {

/// An operator's way into a run: an observer that may ask the clock for things.
class RunClient {
 public:
  /// `with_view`: also takes the picture that the recorder publishes. `self`: its incarnation, 0 = a new one.
  static Expected<std::unique_ptr<RunClient>> attach(const bus::Address& address, bool with_view, Incarnation self = 0);

  /// Called with everything that the clock says to all, and with its answers to this client, in its order.
  void on_control(std::function<void(const Control&)> action) { heard_ = std::move(action); }

  /// Waits up to `timeout_s` for news and takes them.
  void poll(double timeout_s);
  [[nodiscard]] const std::optional<RunState>& state() const { return state_; }
  [[nodiscard]] const std::optional<View>& view() const { return view_; }
  /// How many pictures have been taken: more than before means a new one, perhaps of the same step.
  [[nodiscard]] std::uint64_t views() const { return views_taken_; }
  /// Wall time since the clock's last word; since attach() as long as there was none.
  [[nodiscard]] double clock_silent_s() const;
  /// What this client has ignored because it does not come from the run's clock or recorder.
  [[nodiscard]] std::uint64_t foreign_samples() const { return participant_->foreign_samples(); }
  /// True once the clock hears this client and is heard by it.
  [[nodiscard]] bool connected();

  /// Asks the clock ("pause", "set PATH=VALUE", ...) without waiting for the answer; poll() asks again until it comes.
  void ask(const std::string& request);
  /// Whether the last request is still unanswered: the next one would take its place.
  [[nodiscard]] bool asking() const { return request_.has_value(); }
  /// Asks and waits. Errors: the clock's refusal, or no answer within `limit_s`.
  Expected<std::string> request(const std::string& request, double limit_s);
  /// Tells the clock that a process of the run has ended.
  void report_lost(const std::string& role, const std::string& how);

 private:
  RunClient(std::unique_ptr<bus::Participant> participant, bool with_view, Incarnation clock);

  std::unique_ptr<bus::Participant> participant_;
  Incarnation clock_;  ///< whom it believes; 0 = nobody has spoken yet who may be it
  bus::Writer<Up> up_;
  bus::Reader<Control> control_;
  bus::Reader<RunState> states_;
  std::optional<bus::Reader<View>> views_;
  std::function<void(const Control&)> heard_;
  std::optional<RunState> state_;
  std::optional<View> view_;
  std::uint64_t views_taken_ = 0;
  double heard_s_;             ///< when the clock last spoke
  std::optional<Up> request_;  ///< not answered yet
  double asked_s_ = 0.0;
  std::uint64_t requests_ = 0;
  std::optional<Control> reply_;
};

}  // namespace lukou::process
