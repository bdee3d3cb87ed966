#pragma once

#include <set>

#include "services/console/transport.hpp"

namespace lukou::console {

/// Who may act on the run: one viewer at a time, or nobody.
class ControlHolder {
 public:
  void came(ViewerId viewer) { viewers_.insert(viewer); }
  /// A holder who goes leaves the control to whoever asks next.
  void gone(ViewerId viewer) {
    viewers_.erase(viewer);
    release(viewer);
  }
  /// Returns whether the viewer has it now. `from_another`: also if somebody else holds it.
  bool take(ViewerId viewer, bool from_another) {
    if (!viewers_.contains(viewer) || (holder_ != 0 && holder_ != viewer && !from_another)) return false;
    holder_ = viewer;
    return true;
  }
  void release(ViewerId viewer) {
    if (holder_ == viewer) holder_ = 0;
  }
  /// 0 = nobody.
  [[nodiscard]] ViewerId holder() const { return holder_; }
  [[nodiscard]] std::size_t viewers() const { return viewers_.size(); }

 private:
  std::set<ViewerId> viewers_;
  ViewerId holder_ = 0;
};

}  // namespace lukou::console
