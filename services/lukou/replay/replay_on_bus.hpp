#pragma once

#include <memory>

#include "common/core/expected.hpp"
#include "services/lukou/launch/console_process.hpp"
#include "services/lukou/replay/recording.hpp"

namespace lukou::replay {

/// Shows a recording on the bus as its run was shown: observers need not know the difference. Returns when a viewer
/// stops it, a signal comes, or the console that was started for it has gone. `console` may be null. Errors: DDS cannot
/// start, a broken log.
Expected<Done> replay_on_bus(Recording recording, const bus::Address& address, launch::ConsoleProcess* console);

}  // namespace lukou::replay
