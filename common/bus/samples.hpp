#pragma once

#include <dds/dds.h>

#include "bus.h"
#include "common/bus/batches.hpp"
#include "common/lockstep/messages.hpp"

// Between the plain batches and the structs that idlc generates. Writing lends the batch's own storage to Cyclone;
// reading copies out of the sample that Cyclone filled.

namespace lukou::bus {

/// How a topic is carried.
enum class Service : std::uint8_t {
  kLockstep,  ///< reliable, writer keep-last 512, reader keep-all
  kStream,    ///< reliable, writer keep-last 4096, reader keep-all, writer liveliness 2 s
  kState,     ///< reliable, keep-last 1, transient-local
  kPicture,   ///< best effort, keep-last 1
};

template <class Batch>
struct TopicOf;

#define LUKOU_TOPIC(batch, sample, topic_name, topic_service)                                \
  template <>                                                                                \
  struct TopicOf<batch> {                                                                    \
    using Sample = lukou_bus_##sample;                                                       \
    static constexpr const char* kName = topic_name;                                         \
    static constexpr Service kService = Service::topic_service;                              \
    static const dds_topic_descriptor_t* descriptor() { return &lukou_bus_##sample##_desc; } \
  };

LUKOU_TOPIC(AirBatch, Air, "lukou/air", kLockstep)
LUKOU_TOPIC(RoadsideBatch, Roadside, "lukou/roadside", kLockstep)
LUKOU_TOPIC(RequestBatch, Request, "lukou/request", kLockstep)
LUKOU_TOPIC(SignalBatch, Signal, "lukou/signal", kLockstep)
LUKOU_TOPIC(TrafficBatch, Traffic, "lukou/traffic", kLockstep)
LUKOU_TOPIC(Control, Control, "lukou/control", kStream)
LUKOU_TOPIC(Up, Up, "lukou/up", kStream)
LUKOU_TOPIC(RunState, RunState, "lukou/run_state", kState)
LUKOU_TOPIC(View, View, "lukou/view", kPicture)
#undef LUKOU_TOPIC

/// Fills a sample whose sequences and strings point into `batch`; `scratch` holds what has no storage there.
struct Scratch {
  std::vector<char*> strings_a;
  std::vector<char*> strings_b;
};
void lend(const AirBatch& batch, lukou_bus_Air& sample, Scratch& scratch);
void lend(const RoadsideBatch& batch, lukou_bus_Roadside& sample, Scratch& scratch);
void lend(const RequestBatch& batch, lukou_bus_Request& sample, Scratch& scratch);
void lend(const SignalBatch& batch, lukou_bus_Signal& sample, Scratch& scratch);
void lend(const TrafficBatch& batch, lukou_bus_Traffic& sample, Scratch& scratch);
void lend(const Control& message, lukou_bus_Control& sample, Scratch& scratch);
void lend(const Up& message, lukou_bus_Up& sample, Scratch& scratch);
void lend(const RunState& message, lukou_bus_RunState& sample, Scratch& scratch);
void lend(const View& message, lukou_bus_View& sample, Scratch& scratch);

void copy(const lukou_bus_Air& sample, AirBatch& batch);
void copy(const lukou_bus_Roadside& sample, RoadsideBatch& batch);
void copy(const lukou_bus_Request& sample, RequestBatch& batch);
void copy(const lukou_bus_Signal& sample, SignalBatch& batch);
void copy(const lukou_bus_Traffic& sample, TrafficBatch& batch);
void copy(const lukou_bus_Control& sample, Control& message);
void copy(const lukou_bus_Up& sample, Up& message);
void copy(const lukou_bus_RunState& sample, RunState& message);
void copy(const lukou_bus_View& sample, View& message);

}  // namespace lukou::bus
