#pragma once

#include <vector>

#include "common/intersection/lane_set.hpp"
#include "services/rsu/sdk/rsu_answer.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// Which lanes are green together.
enum class Staging : std::uint8_t {
  kAxes,  ///< all lanes of west and east, all of south and north; left turns do not wait, as in the paper's plan
  kProtectedLefts,  ///< of each axis first centre and right, then left
};

/// The stages, in the order in which they follow each other.
std::vector<LaneSet> stages_of(Staging staging);

/// The stage that an algorithm asks for, and what the controller makes of it. A request acts a promise later, so this
/// looks at the heads as they will be then, not at what shows now.
class StageControl {
 public:
  explicit StageControl(Staging staging);

  /// Looks at the heads; call it first in each step.
  void see(const RsuView& heard);
  [[nodiscard]] const std::vector<LaneSet>& stages() const { return stages_; }
  /// The stage asked for; before the first go_to() the one that shows.
  [[nodiscard]] std::size_t current() const { return current_; }
  /// Whether all its lanes are green, and will have been for the minimum green when a request acts.
  [[nodiscard]] bool may_change() const { return may_change_; }
  /// How long all its lanes will have been green by then [s]; 0 while they are not.
  [[nodiscard]] double green_s() const { return green_s_; }
  /// How long no lane of a stage will have been green by then [s]; 0 if one is.
  [[nodiscard]] double red_s(std::size_t stage) const;
  /// From now until a request acts [s].
  [[nodiscard]] double lead_s() const { return lead_s_; }

  void go_to(std::size_t stage) { current_ = stage; }
  /// Says it to the controller, anew in each step.
  void ask(RsuAnswer& answer) const;

 private:
  std::vector<LaneSet> stages_;
  std::vector<Step> green_until_;  ///< of each stage: the last step seen with a green lane; -1: none yet
  std::size_t current_ = 0;
  bool begun_ = false;
  bool may_change_ = false;
  double green_s_ = 0.0;
  double lead_s_ = 0.0;
  Step acts_ = 0;
};

}  // namespace lukou
