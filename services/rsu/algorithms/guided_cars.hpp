#pragma once

#include <vector>

#include "services/rsu/sdk/rsu_answer.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// The cars that an algorithm guides: each of its words is bound by FOLLOWING and lives as long, and a car that gets no
/// more of them is told once.
class GuidedCars {
 public:
  explicit GuidedCars(double lifetime_s);

  void advise(const HeardCar& car, double acceleration_mps2, RsuAnswer& answer);
  /// Only a car that was advised in the step before is told.
  void release(const HeardCar& car, RsuAnswer& answer) const;
  /// After the last word of a step.
  void end_step();

 private:
  Step lifetime_;
  std::vector<TemporaryId> advised_;  ///< in the step before, by id
  std::vector<TemporaryId> advised_now_;
};

}  // namespace lukou
