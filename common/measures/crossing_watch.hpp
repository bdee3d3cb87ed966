#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/intersection/geometry.hpp"
#include "common/intersection/lane.hpp"

namespace lukou {

/// A car inside the junction, at the end of a step.
struct CrossingCar {
  std::uint32_t vehicle = 0;
  Lane lane{};
  bool equipped = false;
  bool guided = false;  ///< an advice was in force shortly before
  double position_m = 0.0;
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;  ///< of the step
};

/// Two cars went through a place that both their paths need, one after the other or together.
struct PostEncroachment {
  CrossingCar first;
  CrossingCar second;
  double entered_s = 0.0;     ///< the second's front
  double pet_s = 0.0;         ///< since the first's rear was out; 0: the first was still inside
  double past_line_m = 0.0;   ///< where the place begins on the second's path
  bool opposed_left = false;  ///< Conflict::kPermitted: a left turn and the stream that comes towards it
};

/// Watches the places where the paths of two movements cross (crossing_area()). Every two cars that use such a place
/// one directly after the other are reported once, when the second's front comes to it.
class CrossingWatch {
 public:
  CrossingWatch(const RoadLengths& road, double vehicle_length_m);

  /// Beyond this path coordinate a lane's cars have nothing more to tell.
  [[nodiscard]] double end_m(Lane lane) const { return end_m_[index(lane)]; }
  /// Where the car is after a step that ends at `now_s`. `next_mark` is the car's own, 0 when it has crossed its line.
  void move(const CrossingCar& car, double now_s, std::size_t& next_mark);
  /// Ends the step in which the cars have moved; pairs in the order of time. Valid until the next move().
  std::span<const PostEncroachment> settle();

 private:
  /// A car's front is here when its front enters a place, or when its rear leaves it.
  struct Mark {
    double front_m = 0.0;
    Lane other{};
    bool enters = false;
  };
  struct Passing {
    double at_s = 0.0;
    Mark mark;
    CrossingCar car;
  };
  /// How one of the two movements uses a place.
  struct Use {
    std::uint32_t inside = 0;           ///< cars
    std::optional<CrossingCar> newest;  ///< to have entered, while one is inside
    std::optional<CrossingCar> left;    ///< the last to have left, until the other movement has followed it
    double left_s = 0.0;
  };

  void take(const Passing& passing);

  double approach_m_;
  std::array<std::vector<Mark>, kLanes> marks_;  ///< by front_m
  std::array<double, kLanes> end_m_{};
  std::array<std::array<Use, kLanes>, kLanes> uses_;  ///< [lane][the other]
  std::vector<Passing> passings_;                     ///< of this step
  std::vector<PostEncroachment> settled_;
};

}  // namespace lukou
