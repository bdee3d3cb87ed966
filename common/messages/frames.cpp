#include "common/messages/frames.hpp"

namespace lukou {

void Frames::append(const Frames& others) {
  const auto add = [](auto& column, const auto& more) { column.insert(column.end(), more.begin(), more.end()); };
  const auto begin = static_cast<std::uint32_t>(payload.size());
  for (const std::uint32_t end : others.payload_end) payload_end.push_back(begin + end);
  add(sender, others.sender), add(sequence, others.sequence), add(kind, others.kind);
  add(wire_bytes, others.wire_bytes), add(antenna_x_m, others.antenna_x_m), add(antenna_y_m, others.antenna_y_m);
  add(payload, others.payload);
}

}  // namespace lukou
