#include "services/lukou/redrive/answer.hpp"

#include <cstdio>

#include "common/intersection/lane_set.hpp"
#include "common/messages/map.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/rsm.hpp"
#include "common/messages/spat.hpp"

namespace lukou::redrive {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// The payload of one message, encoded anew.
template <class Message>
std::string bytes_of(const Message& message) {
  Frames frames;
  append(frames, {}, message);
  return {frames.payload.begin(), frames.payload.end()};
}

std::string text_of(const VehicleCoordination& asked) {
  if (!asked.path) return "release";
  const GuidedPath& path = *asked.path;
  std::string text = path.speed_mps ? number(*path.speed_mps) + " m/s" : number(path.acceleration_mps2) + " m/s2";
  for (const LaterAcceleration& later : path.later) {
    text += " then " + number(later.acceleration_mps2) + " from " + std::to_string(later.from_ms) + " ms";
  }
  return text + " for " + std::to_string(path.lifetime_ms) + " ms" +
         (asked.binding == Binding::kFollowing ? " FOLLOWING" : " GUARD");
}

class Reading {
 public:
  Words words;

  void read(const Frames& frames, std::size_t frame) {
    const auto payload = frames.payload_of(frame);
    switch (static_cast<FrameKind>(frames.kind[frame])) {
      case FrameKind::kRsc:
        if (auto message = decode_rsc(payload)) return read(message.value());
        break;
      case FrameKind::kSpat:
        if (auto message = decode_spat(payload)) return read(message.value(), Topic::Kind::kSpat);
        break;
      case FrameKind::kMap:
        if (auto message = decode_map(payload)) return read(message.value(), Topic::Kind::kMap);
        break;
      case FrameKind::kRsm:
        if (auto message = decode_rsm(payload)) return read(message.value(), Topic::Kind::kRsm);
        break;
      case FrameKind::kBsm:
        break;
    }
    add({Topic::Kind::kUnreadable}, {std::string(payload.begin(), payload.end()), "a frame that cannot be decoded"});
  }

  void add(Topic topic, Word word) {
    while (words.contains(topic)) ++topic.place;
    words.emplace(topic, std::move(word));
  }

 private:
  void read(const Coordination& message) {
    for (const VehicleCoordination& asked : message.vehicles) {
      const Coordination alone{.second_mark_ms = message.second_mark_ms, .vehicles = {asked}};
      add({Topic::Kind::kAdvice, asked.vehicle}, {bytes_of(alone), text_of(asked)});
    }
    for (const LaneSpeed& word : message.lanes) {
      const Coordination alone{.second_mark_ms = message.second_mark_ms, .node = message.node, .lanes = {word}};
      const std::string text = number(word.speed_mps) + " m/s for " + std::to_string(word.lifetime_ms) + " ms";
      add({Topic::Kind::kLaneSpeed, static_cast<std::uint64_t>(word.lane)}, {bytes_of(alone), text});
    }
  }

  template <class Message>
  void read(Message& message, Topic::Kind kind) {
    message.count = 0;
    add({kind}, {bytes_of(message), "a message"});
  }
};

}  // namespace

bool operator==(const Answer& a, const Answer& b) {
  return a.frames.kind == b.frames.kind && a.frames.sequence == b.frames.sequence &&
         a.frames.sender == b.frames.sender && a.frames.wire_bytes == b.frames.wire_bytes &&
         a.frames.payload_end == b.frames.payload_end && a.frames.payload == b.frames.payload &&
         a.request_lanes == b.request_lanes && a.request_lifetime == b.request_lifetime;
}

std::string_view name(Topic::Kind kind) {
  switch (kind) {
    case Topic::Kind::kAdvice:
      return "advice";
    case Topic::Kind::kLaneSpeed:
      return "lane_speed";
    case Topic::Kind::kRequest:
      return "request";
    case Topic::Kind::kSpat:
      return "spat";
    case Topic::Kind::kMap:
      return "map";
    case Topic::Kind::kRsm:
      return "rsm";
    case Topic::Kind::kUnreadable:
      break;
  }
  return "unreadable";
}

Words words_of(const Answer& answer) {
  Reading reading;
  for (std::size_t frame = 0; frame < answer.frames.size(); ++frame) reading.read(answer.frames, frame);
  for (std::size_t i = 0; i < answer.request_lanes.size(); ++i) {
    std::string text = "green for";
    for (const Lane lane : LaneSet::from_bits(answer.request_lanes[i])) text += " " + std::string(name(lane));
    const std::string life = std::to_string(answer.request_lifetime[i]);
    reading.add({Topic::Kind::kRequest}, {text + " " + life, text + " for " + life + " steps"});
  }
  return std::move(reading.words);
}

std::size_t advice_in(const Answer& answer) {
  std::size_t advice = 0;
  for (std::size_t frame = 0; frame < answer.frames.size(); ++frame) {
    if (answer.frames.kind[frame] != static_cast<std::uint8_t>(FrameKind::kRsc)) continue;
    if (const auto message = decode_rsc(answer.frames.payload_of(frame))) advice += message.value().vehicles.size();
  }
  return advice;
}

}  // namespace lukou::redrive
