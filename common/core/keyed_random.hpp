#pragma once

#include <cstdint>

namespace lukou {

/// What a draw is for. The value is part of the key: never renumber, only append.
enum class Purpose : std::uint16_t {
  kArrivalGap = 1,      ///< unit exponential of arrival n on an approach
  kDesiredSpeed = 2,    ///< a driver's share of the limit
  kInitialSpeed = 3,    ///< speed at the entrance
  kLane = 4,            ///< choice among the safe lanes
  kEquipped = 5,        ///< compared with the equipped ratio
  kActuationNoise = 6,  ///< noise on the acceleration, index = step
  kTemporaryId = 7,     ///< the 8-byte id in the BSM
  // The radio; all but the first two have index = the directed link's number and entity = sequence of the frame.
  kRadioLink = 8,            ///< the number of a link, from the ids of its stations
  kRadioPhase = 9,           ///< when in a step a station generates its frames, index = its id
  kRadioLatency = 10,        ///< uniform, or the first exponential of the gamma law
  kRadioLatencySecond = 11,  ///< the second exponential of the gamma law
  kRadioLoss = 12,           ///< independent loss
  kRadioBurst = 13,          ///< transition between the states of a bursty link
  kRadioDuplicate = 14,      ///< whether a frame is heard twice
  // Of a station or a pair of stations; entity and index: common/radio.
  kRadioReservation = 15,         ///< when a station reserves anew
  kRadioKeep = 16,                ///< whether it keeps its resource then
  kRadioSubframe = 17,            ///< which subframe a reservation uses
  kRadioReservedLatency = 18,     ///< latency of a reservation: uniform, or the first exponential
  kRadioReservedLatency2nd = 19,  ///< the second exponential
  kRadioShadowing = 20,           ///< a cell's share of the shadowing
  kRadioSight = 21,               ///< whether a pair of cars sees each other along a street
  kRadioBlocker = 22,             ///< what the car between two cars takes away
  kRadioCollision = 23,           ///< whether a reservation collides at a receiver
  // Roadside sensors: entity = vehicle, index = number of the sensor * 2^32 + step.
  kSensorMiss = 25,     ///< whether a step misses the car
  kSensorAlong = 26,    ///< error of the position along the lane
  kSensorAcross = 27,   ///< error of the position across the lane
  kSensorSpeed = 28,    ///< error of the speed
  kSensorTrack = 29,    ///< number under which a sensor follows a car, step = 0
  kPositionBias = 30,   ///< constant error of a unit's position, index = axis
  kPositionNoise = 31,  ///< innovation of the error that wanders, index = 2 * step + axis
  kUnitClock = 32,      ///< constant offset of a unit's clock
  kCompliance = 35,     ///< how a driver takes advice, compared with the shares; entity = vehicle
  kDriverGain = 36,     ///< how strongly a human follows a command; entity = vehicle
  kTest = 100,          ///< tests
};

/// A draw is a pure function of its key: neither order nor other draws can change it.
struct DrawKey {
  std::uint64_t run_seed = 0;
  Purpose purpose = Purpose::kTest;
  std::uint32_t entity = 0;  ///< whose draw: a vehicle, an approach, a link
  std::uint64_t index = 0;   ///< which one of the entity's draws of this purpose
};

/// 64 random bits. Philox4x32-10 (Salmon et al. 2011, through Random123).
std::uint64_t random_bits(const DrawKey& key);
/// Uniform in the open interval (0, 1), 52 bits.
double uniform01(const DrawKey& key);
/// Exponential with mean 1.
double unit_exponential(const DrawKey& key);
/// Normal with mean 0 and standard deviation 1, by inversion.
double standard_normal(const DrawKey& key);
/// Normal(mean, deviation) truncated to [low, high] by rejection; attempt n uses index + n.
/// Requires that [low, high] holds at least 1 % of the mass.
double truncated_normal(const DrawKey& key, double mean, double deviation, double low, double high);

}  // namespace lukou
