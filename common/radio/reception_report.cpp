#include "common/radio/reception_report.hpp"

#include <cstddef>

namespace lukou {
namespace {

template <class Column>
void append_column(Column& to, const Column& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

void ReceptionTally::clear() {
  sent = heard = lost_random = lost_burst = lost_range = duplicates = 0;
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
  lost_range.clear(), duplicates.clear(), latency_ms.clear();
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
  append_column(latency_ms, tally.latency_ms);
}

void ReceptionReport::add(const ReceptionReport& other) {
  append_column(direction, other.direction), append_column(kind, other.kind), append_column(sent, other.sent);
  append_column(heard, other.heard), append_column(lost_random, other.lost_random);
  append_column(lost_burst, other.lost_burst), append_column(lost_range, other.lost_range);
  append_column(duplicates, other.duplicates), append_column(latency_ms, other.latency_ms);
}

bool ReceptionReport::well_formed() const {
  const std::size_t rows = size();
  for (const std::size_t length : {kind.size(), sent.size(), heard.size(), lost_random.size(), lost_burst.size(),
                                   lost_range.size(), duplicates.size()}) {
    if (length != rows) return false;
  }
  std::size_t values = 0;
  for (const std::uint32_t count : heard) values += count;
  return values == latency_ms.size();
}

}  // namespace lukou
