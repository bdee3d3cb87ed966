#pragma once

#include <CLI/CLI.hpp>

#include "common/bus/participant.hpp"

namespace lukou::process {

/// How to reach a run beyond this host's loopback: --identity and --peers, by default LUKOU_IDENTITY and LUKOU_PEERS.
void add_address_options(CLI::App& app, bus::Address& address);

}  // namespace lukou::process
