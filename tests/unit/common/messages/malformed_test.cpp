#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "common/core/keyed_random.hpp"
#include "common/messages/bsm.hpp"
#include "common/messages/map.hpp"
#include "common/messages/rsc.hpp"
#include "common/messages/rsm.hpp"
#include "common/messages/spat.hpp"
#include "tests/unit/common/messages/one_frame.hpp"
#include "v2x.pb.h"

namespace lukou {
namespace {

std::uint64_t bits(std::uint64_t index) {
  return random_bits({.run_seed = 1, .purpose = Purpose::kTest, .entity = 0, .index = index});
}

/// A message's bytes as they should be, how to decode them, and what Protobuf says of them.
struct Kind {
  std::string whole;
  bool (*decodes)(std::span<const std::uint8_t>);
  bool (*parses)(const std::string&);
};

std::vector<Kind> kinds() {
  BasicSafety bsm;
  bsm.speed_mps = 10.0;
  Spat spat;
  for (auto& lane : spat.lanes) lane = {{Aspect::kGreen, 0, 10}};
  Coordination rsc;
  rsc.vehicles = {{.vehicle = 1, .path = GuidedPath{.centre = {}, .acceleration_mps2 = 1.0, .lifetime_ms = 10}}};
  Coordination path;
  path.vehicles = {{.vehicle = 1,
                    .path = GuidedPath{.acceleration_mps2 = -1.0,
                                       .lifetime_ms = 300,
                                       .later = {{.from_ms = 100, .acceleration_mps2 = 0.5},
                                                 {.from_ms = 200, .acceleration_mps2 = 1.5}}}}};
  Coordination speed;
  speed.vehicles = {{.vehicle = 1, .path = GuidedPath{.lifetime_ms = 300, .speed_mps = 9.0}}};
  Coordination lanes;
  lanes.lanes = {{.lane = Lane{5}, .speed_mps = 9.0, .lifetime_ms = 300}};
  const auto parses_as_rsc = [](const std::string& bytes) {
    return v2x::RoadsideCoordination().ParseFromString(bytes);
  };
  bsm.accuracy_m = 1.0;
  RoadsideSafety rsm;
  rsm.participants = {{.number = 1, .speed_mps = 3.0}};
  return {
      {bytes_of(one_frame(bsm)),
       [](std::span<const std::uint8_t> bytes) {  // one without an accuracy is whole, but not this one
         const auto message = decode_bsm(bytes);
         return message.ok() && message.value().accuracy_m.has_value();
       },
       [](const std::string& bytes) { return v2x::BasicSafetyMessage().ParseFromString(bytes); }},
      {bytes_of(one_frame(spat)), [](std::span<const std::uint8_t> bytes) { return decode_spat(bytes).ok(); },
       [](const std::string& bytes) { return v2x::Spat().ParseFromString(bytes); }},
      {bytes_of(one_frame(MapData{})), [](std::span<const std::uint8_t> bytes) { return decode_map(bytes).ok(); },
       [](const std::string& bytes) { return v2x::MapMessage().ParseFromString(bytes); }},
      {bytes_of(one_frame(rsm)), [](std::span<const std::uint8_t> bytes) { return decode_rsm(bytes).ok(); },
       [](const std::string& bytes) { return v2x::RoadsideSafetyMessage().ParseFromString(bytes); }},
      {bytes_of(one_frame(rsc)),
       [](std::span<const std::uint8_t> bytes) {  // one without cars is whole, but not this one
         const auto message = decode_rsc(bytes);
         return message.ok() && !message.value().vehicles.empty();
       },
       parses_as_rsc},
      {bytes_of(one_frame(path)),
       [](std::span<const std::uint8_t> bytes) {  // one with fewer points is whole, but not this one
         const auto message = decode_rsc(bytes);
         return message.ok() && !message.value().vehicles.empty() && message.value().vehicles[0].path &&
                message.value().vehicles[0].path->later.size() == 2;
       },
       parses_as_rsc},
      {bytes_of(one_frame(speed)),
       [](std::span<const std::uint8_t> bytes) {
         const auto message = decode_rsc(bytes);
         return message.ok() && !message.value().vehicles.empty() && message.value().vehicles[0].path &&
                message.value().vehicles[0].path->speed_mps.has_value();
       },
       parses_as_rsc},
      {bytes_of(one_frame(lanes)),
       [](std::span<const std::uint8_t> bytes) {
         const auto message = decode_rsc(bytes);
         return message.ok() && !message.value().lanes.empty();
       },
       parses_as_rsc},
  };
}

// Reading outside the bytes is for the sanitizers to find in all of these.

TEST(MalformedPayload, IsRefusedIfItIsNoise) {
  const std::vector<Kind> all = kinds();
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    std::string bytes;
    for (std::uint64_t j = 0; j < bits(1000 * i) % 100; ++j) bytes.push_back(static_cast<char>(bits(1000 * i + 1 + j)));
    for (const Kind& kind : all) EXPECT_FALSE(kind.decodes(as_payload(bytes)));
  }
}

TEST(MalformedPayload, IsRefusedIfItIsCutShort) {
  for (const Kind& kind : kinds()) {
    ASSERT_TRUE(kind.decodes(as_payload(kind.whole)));
    // Cut between two fields it may still parse; then a required one is missing.
    for (std::size_t length = 0; length < kind.whole.size(); ++length) {
      EXPECT_FALSE(kind.decodes(as_payload(kind.whole.substr(0, length)))) << length;
    }
  }
}

TEST(MalformedPayload, NeverDecodesToWhatProtobufWouldNotParse) {
  for (const Kind& kind : kinds()) {
    int refused = 0;
    int taken = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      std::string bytes = kind.whole;
      const std::uint64_t draw = bits(i);
      bytes[draw % bytes.size()] = static_cast<char>(draw >> 32U);
      if (!kind.decodes(as_payload(bytes))) {
        ++refused;
        continue;
      }
      ++taken;
      EXPECT_TRUE(kind.parses(bytes));
    }
    // Some bytes may change without harm and others may not: the loop has tried both.
    EXPECT_GT(refused, 1000);
    EXPECT_GT(taken, 100);
  }
}

}  // namespace
}  // namespace lukou
