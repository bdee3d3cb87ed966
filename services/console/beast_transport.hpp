#pragma once

#include <memory>
#include <string>

#include "common/core/expected.hpp"
#include "services/console/gate.hpp"
#include "services/console/page_folder.hpp"
#include "services/console/transport.hpp"

namespace lukou::console {

struct Listening {
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;
  int ports_to_try = 1;  ///< this one and the next ones, until one is free
};

/// HTTP and WebSocket with Boost.Beast: the page's files to whoever may have them, and the visitors' socket at /ws.
/// `visitors` outlives it. Errors: no port is free, or the address is none of this host.
Expected<std::unique_ptr<Transport>> listen(const Listening& listening, Gate gate, PageFolder folder,
                                            Visitors& visitors);

}  // namespace lukou::console
