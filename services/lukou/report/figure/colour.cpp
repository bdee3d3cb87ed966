#include "services/lukou/report/figure/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <span>

#include "common/core/contract.hpp"

namespace lukou::figure {
namespace {

constexpr std::array<Look, 7> kLooks = {{{{0, 114, 178}, "", Marker::kCircle},
                                         {{213, 94, 0}, "5 2", Marker::kSquare},
                                         {{0, 158, 115}, "1.5 1.5", Marker::kTriangle},
                                         {{204, 121, 167}, "7 2 1.5 2", Marker::kDiamond},
                                         {{230, 159, 0}, "3 1.5", Marker::kCross},
                                         {{86, 180, 233}, "7 1.5 1.5 1.5 1.5 1.5", Marker::kPlus},
                                         {{60, 60, 60}, "9 3", Marker::kCircle}}};

/// viridis of matplotlib (CC0), from its light end.
constexpr std::array<Colour, 9> kSequential = {{{253, 231, 37},
                                                {170, 220, 50},
                                                {94, 201, 98},
                                                {39, 173, 129},
                                                {33, 145, 140},
                                                {44, 114, 142},
                                                {59, 82, 139},
                                                {71, 44, 122},
                                                {68, 1, 84}}};
constexpr std::array<Colour, 5> kDiverging = {
    {{140, 45, 4}, {240, 150, 90}, {250, 250, 250}, {110, 175, 215}, {8, 72, 143}}};

Colour along(std::span<const Colour> anchors, double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  return mixed(anchors[below], anchors[below + 1], place - static_cast<double>(below));
}

}  // namespace

std::string hex(Colour colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour.red, colour.green, colour.blue);
  return text.data();
}

Colour mixed(Colour from, Colour to, double share) {
  const auto mix = [share](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + (b - a) * share));
  };
  return {mix(from.red, to.red), mix(from.green, to.green), mix(from.blue, to.blue)};
}

bool is_dark(Colour colour) {
  // Luma of ITU-R BT.601: what the eye makes of the three.
  return 0.299 * colour.red + 0.587 * colour.green + 0.114 * colour.blue < 140.0;
}

Look look_of(int number) {
  LUKOU_EXPECT(number >= 0);
  return kLooks[static_cast<std::size_t>(number) % kLooks.size()];
}

Colour ColourScale::at(double value) const {
  LUKOU_EXPECT(min < max);
  if (kind == Kind::kSequential) return along(kSequential, (value - min) / (max - min));
  // As far to both sides, so that equal depth means equal size.
  const double reach = std::max(std::abs(min), std::abs(max));
  return along(kDiverging, 0.5 + 0.5 * value / reach);
}

}  // namespace lukou::figure
