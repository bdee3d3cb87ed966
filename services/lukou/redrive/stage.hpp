#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/participant.hpp"
#include "common/core/expected.hpp"
#include "common/lockstep/clock_core.hpp"

namespace lukou::redrive {

/// A run without traffic, for RSU programs: speaks as clock, engine, signal controller and recorder of a run do, and
/// hears what RSUs answer.
class Stage {
 public:
  /// `settings`: of the clock, as in a run, but for its incarnation. `absent`: RSUs that no program plays. Errors: DDS.
  static Expected<std::unique_ptr<Stage>> open(const bus::Address& address, ClockSettings settings, bool actuated,
                                               const std::set<std::uint32_t>& absent);

  /// Waits up to `timeout_s` for news and acts on them: the protocol goes on, answers come in.
  void serve(double timeout_s);
  /// The last step that may be played.
  [[nodiscard]] Step through() const { return through_; }
  void play(const AirBatch& air, const SignalBatch* signal);
  /// Answers in the order in which they came, taken once.
  std::vector<RoadsideBatch> take_answers();
  /// All steps up to and with this one have been compared.
  void compared(Step step);
  /// The last step has been compared: the programs may leave.
  void close(Step step);
  /// A program has ended, in the words of the launcher.
  void lost(const std::string& role, const std::string& how);

  [[nodiscard]] const std::optional<RunOutcome>& outcome() const { return core_->outcome(); }

 private:
  /// A role that is played from here.
  struct Player {
    std::string role;
    std::unique_ptr<bus::Participant> participant;
  };

  Stage() = default;
  void join(const Player& player);
  void say(const Player& player, Up message);
  [[nodiscard]] bool everybody_is_matched();
  void send();

  std::unique_ptr<bus::Participant> clock_;
  Player engine_;
  Player controller_;
  Player recorder_;
  std::vector<Player> absent_;
  std::optional<ClockCore> core_;
  std::optional<bus::Reader<Up>> up_;
  std::optional<bus::Writer<Control>> control_;
  std::optional<bus::Writer<AirBatch>> air_;
  std::optional<bus::Reader<RoadsideBatch>> roadside_;
  std::optional<bus::Writer<SignalBatch>> signal_;
  std::optional<bus::Reader<RequestBatch>> requests_;
  std::vector<Up> joining_;  ///< whom the answer does not reach yet
  std::vector<RoadsideBatch> answers_;
  std::uint32_t seen_ = 0;
  Step through_ = -1;
  Step played_ = -1;
  Step credited_ = -1;
  double told_s_ = 0.0;
};

}  // namespace lukou::redrive
