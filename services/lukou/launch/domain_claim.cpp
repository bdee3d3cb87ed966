#include "services/lukou/launch/domain_claim.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace lukou::launch {
namespace {

constexpr int kDomainMax = 100;
const std::string kDomainPrefix = "lukou/domain/";

/// Binds the abstract name; -1 if somebody has it.
int bind_abstract(const std::string& name) {
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t length = std::min(name.size(), sizeof address.sun_path - 1);
  std::memcpy(address.sun_path + 1, name.data(), length);  // the leading zero makes it abstract
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  if (::bind(fd, reinterpret_cast<const sockaddr*>(&address), size) == 0) return fd;
  ::close(fd);
  return -1;
}

}  // namespace

Expected<DomainClaim> DomainClaim::lowest_free(process::ListedRun run) {
  for (int domain = 0; domain <= kDomainMax; ++domain) {
    const int domain_socket = bind_abstract(kDomainPrefix + std::to_string(domain));
    if (domain_socket < 0) continue;
    run.domain = domain;
    const int run_socket = bind_abstract(process::socket_name(run));
    return DomainClaim(domain, domain_socket, run_socket);
  }
  return Error{"DDS domains", "0 to 100 are all claimed by other runs on this host; `lukou ctl list` names them"};
}

DomainClaim::DomainClaim(DomainClaim&& other) noexcept
    : domain_(other.domain_),
      domain_socket_(std::exchange(other.domain_socket_, -1)),
      run_socket_(std::exchange(other.run_socket_, -1)) {}

DomainClaim& DomainClaim::operator=(DomainClaim&& other) noexcept {
  std::swap(domain_, other.domain_);
  std::swap(domain_socket_, other.domain_socket_);
  std::swap(run_socket_, other.run_socket_);
  return *this;
}

DomainClaim::~DomainClaim() {
  if (run_socket_ >= 0) ::close(run_socket_);
  if (domain_socket_ >= 0) ::close(domain_socket_);
}

std::vector<int> free_domains() {
  const auto claimed = process::bound_names(kDomainPrefix);
  std::vector<int> free;
  for (int domain = 0; domain <= kDomainMax; ++domain) {
    if (std::ranges::find(claimed, std::to_string(domain)) == claimed.end()) free.push_back(domain);
  }
  return free;
}

}  // namespace lukou::launch
