#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/core/step.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

namespace lukou {

/// How the air treats a frame between two stations.
enum class RadioModel : std::uint8_t {
  kIdeal = 1,  ///< every frame is heard by everybody, at the step in which it is sent
};

/// The receiving half of one station's radio: decides for each frame on the air whether the station hears it, and when.
/// Reads envelopes alone, never a payload.
class Modem {
 public:
  Modem(RadioModel model, PlanePoint antenna);

  /// The step at whose instant the station hears a frame that was sent at `sent`; empty if it is lost.
  /// Requires frame < frames.size().
  [[nodiscard]] std::optional<Step> heard_at(const Frames& frames, std::size_t frame, Step sent) const;
  [[nodiscard]] const PlanePoint& antenna() const { return antenna_; }

 private:
  RadioModel model_;
  PlanePoint antenna_;
};

}  // namespace lukou
