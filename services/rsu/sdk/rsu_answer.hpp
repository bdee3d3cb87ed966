#pragma once

#include <optional>
#include <vector>

#include "common/messages/binding.hpp"
#include "services/rsu/sdk/rsu_view.hpp"

namespace lukou {

/// An acceleration for a car, from now on until the lifetime ends or a newer advice comes.
struct Advice {
  double acceleration_mps2 = 0.0;  ///< [-20, 20]; goes over the air in units of 0.01
  Step lifetime = 0;               ///< steps, [1, 6553]
  Binding binding = Binding::kGuard;
};

/// What an algorithm asks for in one step. The RSU sends it in the order of the calls; a car uses the newest it hears.
/// An advice that no message can carry is refused and counted, never bent.
class RsuAnswer {
 public:
  struct Item {
    TemporaryId car{};
    std::optional<Advice> advice;  ///< empty = release
  };

  void advise(TemporaryId car, const Advice& advice) { items_.push_back({car, advice}); }
  /// The car drives on its own at once, without waiting for the end of an earlier advice.
  void release(TemporaryId car) { items_.push_back({car, std::nullopt}); }

  [[nodiscard]] const std::vector<Item>& items() const { return items_; }
  void clear() { items_.clear(); }

 private:
  std::vector<Item> items_;
};

}  // namespace lukou
