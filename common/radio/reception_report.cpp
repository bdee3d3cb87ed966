#include "common/radio/reception_report.hpp"

#include <cstddef>

namespace lukou {
namespace {

template <class Column>
void append_column(Column& to, const Column& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::string_view name(Direction direction) {
  switch (direction) {
    case Direction::kUplink:
      return "uplink";
    case Direction::kDownlink:
      return "downlink";
    case Direction::kVehicleToVehicle:
      return "v2v";
  }
  return "unknown";
}

void ReceptionTally::clear() {
  sent = heard = lost_random = lost_burst = lost_range = duplicates = 0;
  lost_path_loss = lost_collision = lost_half_duplex = lost_outage = 0;
  busy_ratio = std::numeric_limits<double>::quiet_NaN();
  latency_ms.clear();
}

void ReceptionTally::count_sent(const Reception& reception) {
  ++sent;
  if (!reception.lost) return;
  switch (*reception.lost) {
    case LossCause::kRandom:
      ++lost_random;
      break;
    case LossCause::kBurst:
      ++lost_burst;
      break;
    case LossCause::kRange:
      ++lost_range;
      break;
    case LossCause::kPathLoss:
      ++lost_path_loss;
      break;
    case LossCause::kCollision:
      ++lost_collision;
      break;
    case LossCause::kHalfDuplex:
      ++lost_half_duplex;
      break;
    case LossCause::kOutage:
      ++lost_outage;
      break;
  }
}

void ReceptionTally::count_delivered(double latency, bool duplicate) {
  if (duplicate) {
    ++duplicates;
    return;
  }
  ++heard;
  latency_ms.push_back(latency);
}

void ReceptionReport::clear() {
  direction.clear(), kind.clear(), sent.clear(), heard.clear(), lost_random.clear(), lost_burst.clear();
  lost_range.clear(), duplicates.clear(), lost_path_loss.clear(), lost_collision.clear();
  lost_half_duplex.clear(), lost_outage.clear(), busy_ratio.clear(), latency_ms.clear();
}

void ReceptionReport::add(Direction way, FrameKind frames, const ReceptionTally& tally) {
  direction.push_back(static_cast<std::uint8_t>(way));
  kind.push_back(static_cast<std::uint8_t>(frames));
  sent.push_back(tally.sent);
  heard.push_back(tally.heard);
  lost_random.push_back(tally.lost_random);
  lost_burst.push_back(tally.lost_burst);
  lost_range.push_back(tally.lost_range);
  duplicates.push_back(tally.duplicates);
  lost_path_loss.push_back(tally.lost_path_loss);
  lost_collision.push_back(tally.lost_collision);
  lost_half_duplex.push_back(tally.lost_half_duplex);
  lost_outage.push_back(tally.lost_outage);
  busy_ratio.push_back(tally.busy_ratio);
  append_column(latency_ms, tally.latency_ms);
}

void ReceptionReport::add(const ReceptionReport& other) {
  append_column(direction, other.direction), append_column(kind, other.kind), append_column(sent, other.sent);
  append_column(heard, other.heard), append_column(lost_random, other.lost_random);
  append_column(lost_burst, other.lost_burst), append_column(lost_range, other.lost_range);
  append_column(lost_path_loss, other.lost_path_loss), append_column(lost_collision, other.lost_collision);
  append_column(lost_half_duplex, other.lost_half_duplex), append_column(lost_outage, other.lost_outage);
  append_column(busy_ratio, other.busy_ratio);
  append_column(duplicates, other.duplicates), append_column(latency_ms, other.latency_ms);
}

bool ReceptionReport::well_formed() const {
  const std::size_t rows = size();
  for (const std::size_t length : {kind.size(), sent.size(), heard.size(), lost_random.size(), lost_burst.size(),
                                   lost_range.size(), duplicates.size(), lost_path_loss.size(), lost_collision.size(),
                                   lost_half_duplex.size(), lost_outage.size(), busy_ratio.size()}) {
    if (length != rows) return false;
  }
  std::size_t values = 0;
  for (const std::uint32_t count : heard) values += count;
  return values == latency_ms.size();
}

}  // namespace lukou
