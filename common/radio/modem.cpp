#include "common/radio/modem.hpp"

#include "common/core/contract.hpp"

namespace lukou {

Modem::Modem(RadioModel model, PlanePoint antenna) : model_(model), antenna_(antenna) {}

std::optional<Step> Modem::heard_at(const Frames& frames, std::size_t frame, Step sent) const {
  LUKOU_EXPECT(frame < frames.size());
  switch (model_) {
    case RadioModel::kIdeal:
      return sent;
  }
  return std::nullopt;
}

}  // namespace lukou
