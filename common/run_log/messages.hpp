#pragma once

#include "common/bus/batches.hpp"

// Between the batches of the bus and the messages of idl/run_log.proto. Reading checks what the bus would: columns of
// one group have one length.

namespace lukou {

namespace record {
class Air;
class Cars;
class Events;
class Reception;
class Roadside;
class Signal;
}  // namespace record

namespace run_log {

void fill(record::Cars& message, const TrafficBatch& batch);
void fill(record::Events& message, const TrafficBatch& batch);
void fill(record::Reception& message, const TrafficBatch& batch);
void fill(record::Air& message, const TrafficBatch& batch);
void fill(record::Roadside& message, const TrafficBatch& batch);
/// `step`: in which the batch came in force.
void fill(record::Signal& message, const SignalBatch& batch, Step step);

/// Each overwrites the columns that its message carries. Returns false if they do not fit together.
[[nodiscard]] bool take(const record::Cars& message, TrafficBatch& batch);
[[nodiscard]] bool take(const record::Events& message, TrafficBatch& batch);
[[nodiscard]] bool take(const record::Reception& message, TrafficBatch& batch);
[[nodiscard]] bool take(const record::Air& message, TrafficBatch& batch);
[[nodiscard]] bool take(const record::Roadside& message, TrafficBatch& batch);
[[nodiscard]] bool take(const record::Signal& message, SignalBatch& batch);

}  // namespace run_log
}  // namespace lukou
