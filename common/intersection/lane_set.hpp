#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "common/intersection/lane.hpp"

namespace lukou {

/// Some of the twelve lanes. Goes through them in the order WL ... NR.
class LaneSet {
 public:
  /// Bit n stands for the lane with index n; all twelve.
  static constexpr std::uint16_t kAllBits = (1U << kLanes) - 1U;

  constexpr LaneSet() = default;
  constexpr LaneSet(std::initializer_list<Lane> lanes) {
    for (const Lane lane : lanes) insert(lane);
  }
  /// Bits beyond the twelve are left out.
  static constexpr LaneSet from_bits(std::uint16_t bits) {
    LaneSet set;
    set.bits_ = bits & kAllBits;
    return set;
  }

  constexpr void insert(Lane lane) { bits_ = static_cast<std::uint16_t>(bits_ | bit(lane)); }
  constexpr void erase(Lane lane) { bits_ = static_cast<std::uint16_t>(bits_ & ~bit(lane)); }
  [[nodiscard]] constexpr bool contains(Lane lane) const { return (bits_ & bit(lane)) != 0; }
  [[nodiscard]] constexpr bool empty() const { return bits_ == 0; }
  [[nodiscard]] constexpr std::size_t size() const { return static_cast<std::size_t>(std::popcount(bits_)); }
  [[nodiscard]] constexpr std::uint16_t bits() const { return bits_; }

  friend constexpr LaneSet operator|(LaneSet a, LaneSet b) {
    return from_bits(static_cast<std::uint16_t>(a.bits_ | b.bits_));
  }
  friend constexpr LaneSet operator&(LaneSet a, LaneSet b) {
    return from_bits(static_cast<std::uint16_t>(a.bits_ & b.bits_));
  }
  /// The lanes of `a` that are not in `b`.
  friend constexpr LaneSet operator-(LaneSet a, LaneSet b) {
    return from_bits(static_cast<std::uint16_t>(a.bits_ & ~b.bits_));
  }
  friend constexpr bool operator==(LaneSet, LaneSet) = default;

  class Iterator {
   public:
    constexpr explicit Iterator(std::uint16_t left) : left_(left) {}
    constexpr Lane operator*() const { return static_cast<Lane>(std::countr_zero(left_)); }
    constexpr Iterator& operator++() {
      left_ = static_cast<std::uint16_t>(left_ & (left_ - 1U));
      return *this;
    }
    friend constexpr bool operator==(Iterator, Iterator) = default;

   private:
    std::uint16_t left_;
  };
  [[nodiscard]] constexpr Iterator begin() const { return Iterator(bits_); }
  [[nodiscard]] static constexpr Iterator end() { return Iterator(0); }

 private:
  static constexpr unsigned bit(Lane lane) { return 1U << index(lane); }

  std::uint16_t bits_ = 0;
};

/// Every lane.
inline constexpr LaneSet kAllLanes = LaneSet::from_bits(LaneSet::kAllBits);

}  // namespace lukou
