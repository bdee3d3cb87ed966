#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/lockstep/messages.hpp"
#include "services/console/control_holder.hpp"
#include "services/console/history.hpp"
#include "services/console/page_messages.hpp"
#include "services/console/run_story.hpp"
#include "services/console/viewer.hpp"

namespace lukou::console {

class FromPage;
class Request;
class Statistics;
class ToPage;

/// Between the bus and the viewers: what the run says goes to all of them, what the one in control asks goes to the
/// clock. Knows neither the bus nor the net nor the time: all come as arguments.
class Hub final : public Visitors {
 public:
  /// `may_restart`: somebody listens who can start the run anew.
  explicit Hub(bool may_restart);
  ~Hub() override;

  // From the run.
  /// A run begins, or has begun: with the changes made before this console came. What was known of another one is
  /// forgotten.
  void begin(RunStory story, const std::vector<Directive>& so_far);
  [[nodiscard]] bool begun() const { return story_.has_value(); }
  /// What the clock says to all: changes, losses.
  void hear(const Control& control);
  void show(const View& view, double now_s);
  void tell(const RunState& state, double clock_silent_s, double now_s);

  // To the clock, or to what replays a recording in its place.
  /// The oldest request that has not been passed on: from then on under way until answered().
  [[nodiscard]] std::optional<std::string> take_request();
  void answered(bool ok, const std::string& text);
  /// The seed of the run that shall take this one's place, once.
  [[nodiscard]] std::optional<std::uint64_t> take_restart();
  [[nodiscard]] std::size_t viewers() const { return control_.viewers(); }

  // From and to the viewers.
  ViewerId came() override;
  bool said(ViewerId viewer, std::string_view words) override;
  void gone(ViewerId viewer) override;
  Bytes next(ViewerId viewer) override;
  [[nodiscard]] bool too_slow(ViewerId viewer) const override;

 private:
  struct Asked {
    ViewerId viewer = 0;
    std::uint32_t number = 0;
    std::string text;
  };
  /// A state that all get: its newest version.
  struct Newest {
    std::uint64_t version = 0;
    Bytes bytes;
  };

  void greet(ViewerId id, Viewer& viewer);
  void ask(ViewerId viewer, const Request& request);
  void reply(ViewerId viewer, std::uint32_t number, bool ok, const std::string& text);
  void add_event(Step step, const std::string& kind, const std::string& text);
  void add_directive(const Directive& directive);
  /// A recording goes on at another step.
  void jump(Step to);
  void publish_hands();
  void publish_figures(double now_s);
  void publish(Viewer::State state, const ToPage& message);
  [[nodiscard]] Bytes picture_for(Viewer& viewer);

  bool may_restart_;
  std::optional<RunStory> story_;
  Past past_;
  ControlHolder control_;
  std::map<ViewerId, Viewer> viewers_;
  ViewerId last_viewer_ = 0;
  Newest newest_[Viewer::kStates];
  Bytes picture_with_program_;
  std::uint64_t program_version_ = 0;
  Step program_from_ = 0;
  std::deque<Asked> requests_;
  std::optional<Asked> under_way_;
  std::optional<std::uint64_t> restart_;
  std::deque<std::string> told_;  ///< changes of viewers that are events already; their grants follow
  PaceMeter pace_;
  std::unique_ptr<Statistics> figures_;  ///< of the newest step, until they are published
  std::vector<std::uint32_t> rsus_heard_;
  RunPhase phase_ = RunPhase::kForming;
  Step step_ = -1;
  std::optional<Step> sought_;  ///< where a seek leads that has been answered, until the first view from there
  std::uint32_t seeks_ = 0;
  double statistics_s_ = -1.0;
  double status_s_ = -1.0;
  std::string status_;  ///< what decides whether it is news
};

}  // namespace lukou::console
