#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lukou {

/// A table of fixed size of what has been computed for keys: a later key may take the place of an earlier one, whose
/// value must then be computed again. So what it holds may speed a result up and never change it.
template <class Value>
class Kept {
 public:
  /// Requires a power of two.
  explicit Kept(std::size_t places) : places_(places) {}

  /// The value of a key: as it was left, or a fresh one if it was not there.
  Value& of(std::uint64_t key) {
    Place& place = places_[static_cast<std::size_t>(key ^ (key >> 32U)) & (places_.size() - 1)];
    if (!place.used || place.key != key) place = {.used = true, .key = key, .value = {}};
    return place.value;
  }

 private:
  struct Place {
    bool used = false;
    std::uint64_t key = 0;
    Value value;
  };
  std::vector<Place> places_;
};

}  // namespace lukou
