#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/core/step.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"
#include "common/radio/link_model.hpp"

namespace lukou {

/// Reach of the bins on each side of the junction [m] for roads of these lengths.
double load_reach_m(double approach_m, double exit_m);

/// How full the channel is, and how likely two stations use the same resource. Stations are counted by bins along the
/// two streets, once a second: the cars by their frames of the instant, the RSUs, which stand on the mast at the
/// centre, by their frames of the second before. Formulas and sources: docs/radio.md.
class ChannelLoad {
 public:
  /// `reach_m` is the reach of the bins on each side of the junction; what lies beyond counts in the last one. Requires
  /// that a model that counts has a path loss.
  ChannelLoad(const LoadModel& model, double reach_m);

  /// From now on. A changed model begins to count with the frames of step `from`.
  void use(const LoadModel& model, Step from);
  [[nodiscard]] bool counted() const { return model_.counted; }
  /// Frames of RSUs in step `at`: they count towards the second that ends with the next multiple of 10 after it.
  void add_roadside(const Frames& frames, Step at);
  /// Ends a second if `at` is a multiple of 10 steps, with the cars' frames of that instant. The figures below speak of
  /// it until the next one; before the first they are 0.
  void add_air(const Frames& frames, Step at);

  /// Share of the resources that a station there hears in use, [0, 1].
  [[nodiscard]] double busy_ratio_at_mast() const { return busy_.empty() ? 0.0 : busy_.back(); }
  [[nodiscard]] double busy_ratio(const PlanePoint& car) const;
  /// Mean over the cars' frames; 0 if there are none.
  [[nodiscard]] double busy_ratio_of_cars() const { return busy_of_cars_; }
  /// Sub-channels that a frame of so many wire bytes takes.
  [[nodiscard]] std::uint32_t width(std::uint32_t wire_bytes) const;
  /// That a frame of `width` sub-channels finds another station's in its resource that is too strong at the receiver.
  [[nodiscard]] double collision_to_mast(const PlanePoint& car, std::uint32_t width);
  [[nodiscard]] double collision_from_mast(const PlanePoint& car, std::uint32_t width);
  [[nodiscard]] double collision_between(const PlanePoint& sender, const PlanePoint& receiver, std::uint32_t width);

 private:
  /// Probability that a frame meets no collider.
  struct Survival {
    std::uint32_t update = 0;   ///< to which the figures belong
    double of_one = 1.0;        ///< in one sub-channel
    double of_a_further = 1.0;  ///< in each further one
  };

  void build();
  void update();
  [[nodiscard]] std::size_t mast() const { return 2 * per_street_; }
  [[nodiscard]] std::size_t bin_of(const PlanePoint& at) const;
  [[nodiscard]] PlanePoint centre_of(std::size_t bin) const;
  [[nodiscard]] std::size_t pair(std::size_t a, std::size_t b) const { return a * bins_ + b; }
  [[nodiscard]] double too_strong(double advantage_db) const;
  double collision(std::size_t sender, std::size_t receiver, std::uint32_t width);

  LoadModel model_;
  double bin_m_ = 0.0;
  std::size_t per_street_ = 0;
  std::size_t bins_ = 0;  ///< both streets and the mast
  Step from_ = 0;

  // Of each pair of bins: mean power [dBm], probability that one hears the other, share of what they hear in common.
  std::vector<double> power_dbm_;
  std::vector<double> sensed_;
  std::vector<double> common_;
  std::vector<double> too_strong_;  ///< by steps of the advantage

  // Of the second that is counted and of the one before it, by bin.
  double roadside_frames_ = 0.0;
  double roadside_sub_channels_ = 0.0;
  std::vector<double> frames_;        ///< in 100 ms
  std::vector<double> sub_channels_;  ///< in 100 ms
  std::vector<double> busy_;          ///< busy ratio
  std::vector<double> free_;          ///< resources to choose from, of a station there
  std::vector<std::size_t> used_;     ///< bins with a station
  double busy_of_cars_ = 0.0;
  std::uint32_t update_ = 0;
  std::vector<Survival> survival_;  ///< of a pair, computed when it is asked for
};

}  // namespace lukou
