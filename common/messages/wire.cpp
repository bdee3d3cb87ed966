#include "common/messages/wire.hpp"

#include <array>
#include <cstring>

namespace lukou::wire {

void Writer::close_long(std::size_t begin, std::size_t length) {
  std::array<std::uint8_t, 10> bytes{};
  std::size_t count = 0;
  for (; length >= 0x80U; length >>= 7U) bytes[count++] = static_cast<std::uint8_t>(length | 0x80U);
  bytes[count++] = static_cast<std::uint8_t>(length);
  // The message moves back to make room for more than one byte of length.
  const std::size_t more = count - 1;
  if (end_ - next_ < kFieldMax) make_room(size());
  std::memmove(out_.data() + begin + more, out_.data() + begin, size() - begin);
  std::memcpy(out_.data() + begin - 1, bytes.data(), count);
  next_ += more;
}

bool Reader::rest_of_varint(std::uint64_t& value) {
  value &= 0x7FU;
  for (unsigned shift = 7; shift < 64 && next_ != end_; shift += 7) {
    const std::uint8_t byte = *next_++;
    value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
    if (byte < 0x80U) return true;
  }
  return false;
}

bool Reader::next_of_any_kind() {
  if (broken_ || next_ == end_) return false;
  if (!varint(key_) || (key_ >> 3U) == 0) return fail();
  const auto left = static_cast<std::size_t>(end_ - next_);
  switch (key_ & 7U) {
    case 0:
      return varint(value_) ? true : fail();
    case 1:
      if (left < 8) return fail();
      value_ = 0;
      for (unsigned i = 0; i < 8; ++i) value_ |= static_cast<std::uint64_t>(next_[i]) << (8 * i);
      next_ += 8;
      return true;
    case 2: {
      std::uint64_t length = 0;
      if (!varint(length) || length > static_cast<std::uint64_t>(end_ - next_)) return fail();
      message_ = {next_, static_cast<std::size_t>(length)};
      next_ += length;
      return true;
    }
    case 5:  // no field of ours: stepped over
      if (left < 4) return fail();
      next_ += 4;
      return true;
    default:
      return fail();
  }
}

void write_position(Writer& writer, std::uint32_t field, std::int64_t latitude_e7, std::int64_t longitude_e7) {
  const std::size_t begin = writer.open(field);
  writer.signed_field(1, latitude_e7);
  writer.signed_field(2, longitude_e7);
  writer.close(begin);
}

void write_offset(Writer& writer, std::uint32_t field, const PlanePoint& point) {
  const GeoPoint geo = to_geo(point);
  const auto offset = [](std::int64_t value, std::int64_t reference) {
    const std::int64_t difference = value - reference;
    if (difference > kOffsetMax) return kOffsetMax;
    return difference < -kOffsetMax - 1 ? -kOffsetMax - 1 : difference;
  };
  write_position(writer, field, offset(geo.latitude_e7, kGeoReference.latitude_e7),
                 offset(geo.longitude_e7, kGeoReference.longitude_e7));
}

void read_position(std::span<const std::uint8_t> bytes, RawPosition& position) {
  Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) position.latitude_e7 = reader.signed_value();
    if (reader.field() == varint_key(2)) position.longitude_e7 = reader.signed_value();
  }
  position.broken = position.broken || reader.broken();
}

void check_position(Check& check, const char* name, const RawPosition& position) {
  check.that(name, !position.broken);
  check.required(name, position.latitude_e7, -900'000'000, kGeoUnavailable.latitude_e7);
  check.required(name, position.longitude_e7, -1'799'999'999, kGeoUnavailable.longitude_e7);
}

void check_offset(Check& check, const char* name, const RawPosition& offset) {
  check.that(name, !offset.broken);
  check.required(name, offset.latitude_e7, -kOffsetMax - 1, kOffsetMax);
  check.required(name, offset.longitude_e7, -kOffsetMax - 1, kOffsetMax);
}

std::optional<PlanePoint> point_at(const RawPosition& reference, const RawPosition& offset) {
  const GeoPoint base = {static_cast<std::int32_t>(reference.latitude_e7),
                         static_cast<std::int32_t>(reference.longitude_e7)};
  if (!to_plane(base)) return std::nullopt;
  // Both summands are checked: the sums fit 32 bits.
  return to_plane({base.latitude_e7 + static_cast<std::int32_t>(offset.latitude_e7),
                   base.longitude_e7 + static_cast<std::int32_t>(offset.longitude_e7)});
}

std::int64_t read_acceleration(std::span<const std::uint8_t> bytes) {
  std::int64_t longitudinal = kAbsent;
  Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) longitudinal = reader.signed_value();
  }
  return reader.broken() ? kAbsent : longitudinal;
}

void write_acceleration(Writer& writer, std::uint32_t field, std::int64_t longitudinal_cmps2) {
  const std::size_t begin = writer.open(field);
  writer.signed_field(1, longitudinal_cmps2);
  writer.close(begin);
}

void write_size(Writer& writer, std::uint32_t field, double width_m, double length_m) {
  const auto units = [](double metres, std::int64_t most_cm) {
    return static_cast<std::uint64_t>(to_units(metres, 100.0, 0, most_cm, 0));
  };
  const std::size_t begin = writer.open(field);
  writer.unsigned_field(1, units(width_m, kWidthMax_cm));
  writer.unsigned_field(2, units(length_m, kLengthMax_cm));
  writer.close(begin);
}

void read_size(std::span<const std::uint8_t> bytes, RawSize& size) {
  Reader reader(bytes);
  while (reader.next()) {
    if (reader.field() == varint_key(1)) size.width_cm = reader.value();
    if (reader.field() == varint_key(2)) size.length_cm = reader.value();
  }
  size.broken = size.broken || reader.broken();
}

void finish_frame(Writer& writer, Frames& frames, const Envelope& envelope, FrameKind kind, std::uint32_t wire_bytes) {
  writer.finish();
  frames.sender.push_back(envelope.sender);
  frames.sequence.push_back(envelope.sequence);
  frames.kind.push_back(static_cast<std::uint8_t>(kind));
  frames.wire_bytes.push_back(wire_bytes);
  frames.antenna_x_m.push_back(envelope.antenna_x_m);
  frames.antenna_y_m.push_back(envelope.antenna_y_m);
  frames.payload_end.push_back(static_cast<std::uint32_t>(frames.payload.size()));
}

}  // namespace lukou::wire
