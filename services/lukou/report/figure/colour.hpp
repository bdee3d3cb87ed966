#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lukou::figure {

/// sRGB.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Colour&, const Colour&) = default;
};

inline constexpr Colour kInk{31, 41, 51};
inline constexpr Colour kGrey{110, 120, 130};
inline constexpr Colour kFaint{222, 227, 232};
inline constexpr Colour kWhite{255, 255, 255};
/// Lamps, as the console shows them.
inline constexpr Colour kRedLamp{216, 57, 47};
inline constexpr Colour kYellowLamp{242, 181, 29};
inline constexpr Colour kGreenLamp{42, 168, 96};

/// "#0072b2"
std::string hex(Colour colour);
/// `share` of the way from `from` to `to`; share within [0, 1].
Colour mixed(Colour from, Colour to, double share);
/// Whether white text is easier to read on it than black.
bool is_dark(Colour colour);

enum class Marker : std::uint8_t { kCircle, kSquare, kTriangle, kDiamond, kCross, kPlus };

/// How one series is told from another: colour, dashes and marker change together, so that a print without colours
/// still tells them apart.
struct Look {
  Colour colour;
  std::string_view dashes;  ///< as SVG's stroke-dasharray; empty: none
  Marker marker = Marker::kCircle;
};

/// The looks of a figure's series, numbered from 0; after the last it begins anew. Requires number >= 0.
/// Colours: Okabe and Ito, "Color Universal Design" (2008), which hold for all common kinds of colour blindness.
Look look_of(int number);

/// Values as colours.
struct ColourScale {
  enum class Kind : std::uint8_t {
    kSequential,  ///< light is low, dark is high
    kDiverging,   ///< white is 0, orange below, blue above
  };
  Kind kind = Kind::kSequential;
  double min = 0.0;
  double max = 1.0;   ///< above min
  std::string label;  ///< of the bar beside the picture: "gain [%]"

  /// Values beyond the ends have the colour of the end.
  [[nodiscard]] Colour at(double value) const;
};

}  // namespace lukou::figure
