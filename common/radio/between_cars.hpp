#pragma once

#include <optional>

#include "common/messages/frames.hpp"
#include "common/radio/channel_load.hpp"
#include "common/radio/modem.hpp"
#include "common/radio/reception_report.hpp"

namespace lukou {

/// Reception of the cars' frames at other cars: counted in one step of a second, used by nobody.
class BetweenCars {
 public:
  explicit BetweenCars(const RadioParameters& radio);

  void use(const RadioParameters& radio);
  [[nodiscard]] bool drawn() const { return modem_.has_value(); }
  /// Counts the frames of step `at` at every other car within the awareness distance, if it is a multiple of 10.
  void hear(const Frames& air, Step at, ChannelLoad& load);
  /// Of the last step that was heard.
  [[nodiscard]] const ReceptionTally& tally() const { return tally_; }

 private:
  void hop(const Frames& air, std::size_t from, std::size_t to, double away_m, Step at, ChannelLoad& load);

  std::uint64_t seed_;
  double awareness_m_ = 0.0;
  std::optional<Modem> modem_;
  ReceptionTally tally_;
};

}  // namespace lukou
