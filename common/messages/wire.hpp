#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/math.hpp"
#include "common/messages/frames.hpp"
#include "common/messages/plane.hpp"

// The Protobuf wire format, written and read directly: a step holds a hundred small payloads, and this costs a tenth of
// building message objects for them. idl/v2x.proto stays the contract; the tests hold both against each other.
// Private to this room.

namespace lukou::wire {

/// Appends fields to `out`, whose size is right only after finish(): meanwhile it holds room for what comes next.
class Writer {
 public:
  explicit Writer(std::vector<std::uint8_t>& out) : out_(out) { make_room(out.size()); }

  void unsigned_field(std::uint32_t field, std::uint64_t value) {
    if (end_ - next_ < kFieldMax) make_room(size());
    varint(field << 3U);
    varint(value);
  }
  /// A field of type sint32.
  void signed_field(std::uint32_t field, std::int64_t value) {
    unsigned_field(field, (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63));
  }
  void fixed64_field(std::uint32_t field, std::uint64_t value) {
    if (end_ - next_ < kFieldMax) make_room(size());
    varint((field << 3U) | 1U);
    for (unsigned shift = 0; shift < 64; shift += 8) *next_++ = static_cast<std::uint8_t>(value >> shift);
  }
  /// Begins a message in a field; returns what `close` needs.
  [[nodiscard]] std::size_t open(std::uint32_t field) {
    if (end_ - next_ < kFieldMax) make_room(size());
    varint((field << 3U) | 2U);
    *next_++ = 0;  // the length: one byte is nearly always enough
    return size();
  }
  void close(std::size_t begin) {
    const std::size_t length = size() - begin;
    if (length >= 0x80U) return close_long(begin, length);
    out_[begin - 1] = static_cast<std::uint8_t>(length);
  }
  /// Cuts `out` to what has been written. Nothing may follow.
  void finish() { out_.resize(size()); }

 private:
  static constexpr std::ptrdiff_t kFieldMax = 16;  ///< bytes of a field's key and its value
  static constexpr std::size_t kRoom = 256;

  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(next_ - out_.data()); }
  void make_room(std::size_t size) {
    out_.resize(size + kRoom);
    next_ = out_.data() + size;
    end_ = out_.data() + out_.size();
  }
  void close_long(std::size_t begin, std::size_t length);
  void varint(std::uint64_t value) {
    while (value >= 0x80U) {
      *next_++ = static_cast<std::uint8_t>(value | 0x80U);
      value >>= 7U;
    }
    *next_++ = static_cast<std::uint8_t>(value);
  }

  std::vector<std::uint8_t>& out_;
  std::uint8_t* next_ = nullptr;
  std::uint8_t* end_ = nullptr;
};

/// Walks over the fields of a message. Never reads outside its bytes, whatever they hold.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  /// Steps to the next field; false at the end, and at the first field that cannot be decoded.
  bool next() {
    // Nearly every field is a small number, or has a key of one byte: the rest is elsewhere.
    if (end_ - next_ >= 2 && next_[0] < 0x80U && (next_[0] & 7U) == 0 && next_[0] >= 8U && next_[1] < 0x80U &&
        !broken_) {
      key_ = next_[0];
      value_ = next_[1];
      next_ += 2;
      return true;
    }
    return next_of_any_kind();
  }
  [[nodiscard]] bool broken() const { return broken_; }
  /// Number and wire type of the field: what `key` gives. A field of another type than expected is an unknown one.
  [[nodiscard]] std::uint64_t field() const { return key_; }
  /// Value of a varint or fixed64 field.
  [[nodiscard]] std::uint64_t bits() const { return value_; }
  /// Value of an unsigned field; what no int64 holds becomes the largest.
  [[nodiscard]] std::int64_t value() const {
    constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
    return value_ > static_cast<std::uint64_t>(kMost) ? kMost : static_cast<std::int64_t>(value_);
  }
  /// Value of a field of type sint32.
  [[nodiscard]] std::int64_t signed_value() const {
    return static_cast<std::int64_t>((value_ >> 1U) ^ (~(value_ & 1U) + 1U));
  }
  /// Content of a field that holds a message.
  [[nodiscard]] std::span<const std::uint8_t> message() const { return message_; }

 private:
  bool next_of_any_kind();
  bool varint(std::uint64_t& value) {
    if (next_ == end_) return false;
    value = *next_++;
    return value < 0x80U || rest_of_varint(value);
  }
  bool rest_of_varint(std::uint64_t& value);
  bool fail() {
    broken_ = true;
    return false;
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  std::uint64_t key_ = 0;
  std::uint64_t value_ = 0;
  std::span<const std::uint8_t> message_;
  bool broken_ = false;
};

/// Takes the fields of a message in the order in which our own writer puts them, several times faster than Reader finds
/// them in any order. Once a field is not the expected one it says no to all that follows: then Reader decides.
class InOrder {
 public:
  explicit InOrder(std::span<const std::uint8_t> bytes) : next_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  bool unsigned_field(std::uint32_t field, std::int64_t& value) {
    std::uint64_t bits = 0;
    if (!key(field << 3U) || !varint(bits)) return false;
    value = static_cast<std::int64_t>(bits);
    return true;
  }
  bool signed_field(std::uint32_t field, std::int64_t& value) {
    std::uint64_t bits = 0;
    if (!key(field << 3U) || !varint(bits)) return false;
    value = static_cast<std::int64_t>((bits >> 1U) ^ (~(bits & 1U) + 1U));
    return true;
  }
  bool fixed64_field(std::uint32_t field, std::uint64_t& value) {
    if (!key((field << 3U) | 1U) || end_ - next_ < 8) return false;
    value = 0;
    for (unsigned i = 0; i < 8; ++i) value |= static_cast<std::uint64_t>(next_[i]) << (8 * i);
    next_ += 8;
    return true;
  }
  /// Enters a message of less than 128 bytes.
  bool open(std::uint32_t field) {
    if (!key((field << 3U) | 2U) || next_ == end_ || *next_ >= 0x80U) return false;
    const std::ptrdiff_t length = *next_++;
    inner_end_ = next_ + length;
    return length <= end_ - next_;
  }
  /// Whether the message has been read to its end.
  [[nodiscard]] bool close() const { return next_ == inner_end_; }
  [[nodiscard]] bool at_end() const { return next_ == end_; }

 private:
  /// A key of one byte: a field below 16.
  bool key(std::uint32_t expected) {
    if (next_ == end_ || *next_ != expected) return false;
    ++next_;
    return true;
  }
  /// Of at most five bytes.
  bool varint(std::uint64_t& bits) {
    for (unsigned shift = 0; shift < 35 && next_ != end_; shift += 7) {
      const std::uint8_t byte = *next_++;
      bits |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if (byte < 0x80U) return true;
    }
    return false;
  }

  const std::uint8_t* next_;
  const std::uint8_t* end_;
  const std::uint8_t* inner_end_ = nullptr;
};

constexpr std::uint64_t varint_key(std::uint32_t field) { return std::uint64_t{field} << 3U; }
constexpr std::uint64_t fixed64_key(std::uint32_t field) { return (std::uint64_t{field} << 3U) | 1U; }
constexpr std::uint64_t message_key(std::uint32_t field) { return (std::uint64_t{field} << 3U) | 2U; }

/// Stands for a field that did not come: below every range.
inline constexpr std::int64_t kAbsent = std::numeric_limits<std::int64_t>::min();

/// Holds fields against their ranges and remembers the first that fails.
class Check {
 public:
  /// A required field; `low` is above kAbsent.
  void required(const char* name, std::int64_t value, std::int64_t low, std::int64_t high) {
    if ((value < low || value > high) && wrong_ == nullptr) wrong_ = name;
  }
  void optional(const char* name, std::int64_t value, std::int64_t low, std::int64_t high) {
    if (value != kAbsent) required(name, value, low, high);
  }
  void that(const char* name, bool holds) {
    if (!holds && wrong_ == nullptr) wrong_ = name;
  }
  [[nodiscard]] bool ok() const { return wrong_ == nullptr; }
  /// Requires !ok().
  [[nodiscard]] Error error(const char* message) const {
    return {message, std::string(wrong_) + " is missing or out of its range"};
  }

 private:
  const char* wrong_ = nullptr;
};

/// The integer nearest to `value` * `units_per_si`, saturated to [low, high]; `if_nan` if there is none.
inline std::int64_t to_units(double value, double units_per_si, std::int64_t low, std::int64_t high,
                             std::int64_t if_nan) {
  const double scaled = value * units_per_si;
  if (!(scaled > static_cast<double>(low))) return scaled <= static_cast<double>(low) ? low : if_nan;
  if (scaled >= static_cast<double>(high)) return high;
  return static_cast<std::int64_t>(scaled < 0.0 ? scaled - 0.5 : scaled + 0.5);
}

inline constexpr std::int64_t kCountMax = 127;
inline constexpr std::int64_t kSecondMarkMax = 59'999;
inline constexpr std::int64_t kMinuteMax = 527'039;
inline constexpr std::int64_t kSpeedMax = 8190;
inline constexpr double kSpeedUnitsPerMps = 50.0;
inline constexpr std::int64_t kSpeedUnavailable = 8191;
inline constexpr std::int64_t kHeadingUnavailable = 28'800;
inline constexpr std::int64_t kAccelerationMax = 2000;
inline constexpr std::int64_t kOffsetMax = 8'388'607;

inline constexpr double kHeadingUnitsPerRad = 80.0 * 180.0 / math::kPi;

/// The field's integer: saturated to [0, 8190], 8191 for nothing and for what is not a number.
inline std::int64_t speed_units(const std::optional<double>& speed_mps) {
  return speed_mps ? to_units(*speed_mps, kSpeedUnitsPerMps, 0, kSpeedMax, kSpeedUnavailable) : kSpeedUnavailable;
}
/// Empty for 8191. Requires [0, 8191].
inline std::optional<double> speed_mps(std::int64_t units) {
  if (units == kSpeedUnavailable) return std::nullopt;
  return static_cast<double>(units) / kSpeedUnitsPerMps;
}
/// The field's integer in [0, 28799], a full turn is north again; 28800 for nothing and for what is beyond a turn.
inline std::int64_t heading_units(const std::optional<double>& heading_rad) {
  if (!heading_rad) return kHeadingUnavailable;
  const std::int64_t units = to_units(*heading_rad, kHeadingUnitsPerRad, 0, kHeadingUnavailable, kHeadingUnavailable);
  return units == kHeadingUnavailable && *heading_rad <= 2 * math::kPi ? 0 : units;
}
/// Empty for 28800. Requires [0, 28800].
inline std::optional<double> heading_rad(std::int64_t units) {
  if (units == kHeadingUnavailable) return std::nullopt;
  return static_cast<double>(units) / kHeadingUnitsPerRad;
}

/// A Position3D or PositionOffset as it came.
struct RawPosition {
  std::int64_t latitude_e7 = kAbsent;
  std::int64_t longitude_e7 = kAbsent;
  bool broken = false;
};
void write_position(Writer& writer, std::uint32_t field, std::int64_t latitude_e7, std::int64_t longitude_e7);
/// Writes `point` as an offset from the reference, saturated.
void write_offset(Writer& writer, std::uint32_t field, const PlanePoint& point);
void read_position(std::span<const std::uint8_t> bytes, RawPosition& position);
/// Checks an absolute position (a sentinel is in range) or an offset.
void check_position(Check& check, const char* name, const RawPosition& position);
void check_offset(Check& check, const char* name, const RawPosition& offset);
/// The point of a checked offset from a checked reference; empty if that is unavailable or the sum leaves the globe.
std::optional<PlanePoint> point_at(const RawPosition& reference, const RawPosition& offset);

/// Longitudinal acceleration of an AccelerationSet [cm/s2], kAbsent if it is not there or the bytes are broken.
std::int64_t read_acceleration(std::span<const std::uint8_t> bytes);
void write_acceleration(Writer& writer, std::uint32_t field, std::int64_t longitudinal_cmps2);

inline constexpr std::uint64_t kPassengerCar = 10;  ///< vehicle class
inline constexpr std::int64_t kWidthMax_cm = 1023;
inline constexpr std::int64_t kLengthMax_cm = 4095;

/// A VehicleSize as it came.
struct RawSize {
  std::int64_t width_cm = kAbsent;
  std::int64_t length_cm = kAbsent;
  bool broken = false;
};
/// Saturated; 0, unavailable, for what is not a number.
void write_size(Writer& writer, std::uint32_t field, double width_m, double length_m);
void read_size(std::span<const std::uint8_t> bytes, RawSize& size);

/// Closes a frame whose payload `writer` has appended.
void finish_frame(Writer& writer, Frames& frames, const Envelope& envelope, FrameKind kind, std::uint32_t wire_bytes);

}  // namespace lukou::wire
