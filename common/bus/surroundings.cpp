#include "common/bus/surroundings.hpp"

#include <arpa/inet.h>
#include <dds/dds.h>
#include <dlfcn.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

namespace lukou::bus {

Expected<std::string> own_address_towards(const std::string& peer) {
  const Error unknown{"--peers", "`" + peer + "` is no address and no known name of a host"};
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  // Any port: connecting a datagram socket sends nothing, it asks for the route.
  if (getaddrinfo(peer.c_str(), "7400", &wanted, &found) != 0) return unknown;
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> keeper(found, freeaddrinfo);
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  socklen_t size = sizeof own;
  auto* const address = reinterpret_cast<sockaddr*>(&own);
  const bool routed = descriptor >= 0 && ::connect(descriptor, found->ai_addr, found->ai_addrlen) == 0 &&
                      ::getsockname(descriptor, address, &size) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!routed) return Error{"--peers", "no way to " + peer + ": " + std::strerror(reason)};
  std::array<char, INET_ADDRSTRLEN> text{};
  inet_ntop(AF_INET, &own.sin_addr, text.data(), text.size());
  return std::string(text.data());
}

Expected<std::string> security_plugins() {
  namespace fs = std::filesystem;
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&dds_create_domain), &library) == 0 || library.dli_fname == nullptr) {
    return Error{"DDS Security", "the library of Cyclone DDS cannot be found"};
  }
  const fs::path beside = fs::absolute(library.dli_fname).parent_path();
  // Debian keeps plugins in a folder that bears the library's version.
  for (const fs::path& folder : {beside / "libddsc0debian", beside}) {
    if (fs::exists(folder / "libdds_security_auth.so")) return folder.string();
  }
  return Error{"DDS Security", "its plugins (libdds_security_auth.so and two more) are not in " + beside.string() +
                                   " nor in libddsc0debian there; Debian's package libddsc0debian has them"};
}

}  // namespace lukou::bus
