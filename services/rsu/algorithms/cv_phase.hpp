#pragma once

#include <array>
#include <vector>

#include "services/rsu/algorithms/stages.hpp"
#include "services/rsu/sdk/rsu_algorithm.hpp"

namespace lukou {

struct CvPhaseParameters {
  Staging staging = Staging::kAxes;
  double headway_s = 2.0;
  double equipped_share = 1.0;  ///< of all cars, as far as the RSU is told
  double horizon_s = 20.0;
  double decision_s = 1.0;
  double speeding_up_mps2 = 2.0;
  double target_speed_share = 0.9;
  double first_crossing_s = 1.5;
  double tail_s = 2.0;
  double gap_s = 3.0;
  double max_red_s = 60.0;
};

/// Phase allocation from the arrivals that equipped cars announce: for every time at which the green could end, up to
/// `horizon_s` from now, and every stage that could follow, it predicts when each heard car crosses, and takes the one
/// with the least delay. Each heard car stands for 1 / equipped_share cars. A stage without green for `max_red_s` comes
/// next, since cars without a unit are silent.
/// Source: phase allocation under connected vehicles as in Goodall, Smith, Park 2013, with the switch time as the only
/// decision.
class CvPhase final : public RsuAlgorithm {
 public:
  explicit CvPhase(const CvPhaseParameters& parameters);

  void on_step(const RsuView& heard, RsuAnswer& answer) override;

  /// Of every lane, front to back: times from now at which its cars would cross if nothing held them [s].
  using Arrivals = std::array<std::vector<double>, kLanes>;
  /// What it would cost if the green of stage `from` ended `end_s` from now and `to` followed until its cars have
  /// crossed, then `from` again [s of delay, of heard cars].
  [[nodiscard]] double cost_s(const Arrivals& arrivals, std::size_t from, std::size_t to, double end_s,
                              const Actuation& rules) const;

 private:
  /// A stretch of green, and whether it ends early when the cars come apart.
  struct Green {
    double first_s = 0.0;  ///< earliest crossing
    double end_s = 0.0;
    bool until_gap = false;
  };
  struct Service {
    double delay_s = 0.0;
    double last_s = 0.0;  ///< the last crossing
  };
  void predict(const RsuView& heard);
  /// Lets the cars of a lane from number `next` on cross; `next` goes on behind them.
  [[nodiscard]] Service serve(const std::vector<double>& arrivals, std::size_t& next, const Green& green) const;
  [[nodiscard]] std::size_t choice(const Actuation& rules) const;

  CvPhaseParameters parameters_;
  StageControl control_;
  Arrivals arrivals_;
};

}  // namespace lukou
