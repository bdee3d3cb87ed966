#include "services/lukou/launch/domain_claim.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <utility>

namespace lukou::launch {
namespace {

constexpr int kDomainMax = 100;
const std::string kDomainPrefix = "lukou/domain/";
const std::string kRunPrefix = "lukou/run/";

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

/// The abstract names in this network namespace that begin with `prefix`, without it.
std::vector<std::string> bound_names(const std::string& prefix) {
  std::vector<std::string> names;
  std::ifstream sockets("/proc/net/unix");
  std::string line;
  while (std::getline(sockets, line)) {
    const auto at = line.find(" @" + prefix);
    if (at != std::string::npos) names.push_back(line.substr(at + 2 + prefix.size()));
  }
  return names;
}

}  // namespace

Expected<DomainClaim> DomainClaim::lowest_free(const std::string& run) {
  for (int domain = 0; domain <= kDomainMax; ++domain) {
    const int domain_socket = bind_abstract(kDomainPrefix + std::to_string(domain));
    if (domain_socket < 0) continue;
    const int run_socket = bind_abstract(kRunPrefix + run + "/" + std::to_string(domain));
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

std::vector<ListedRun> list_runs() {
  std::vector<ListedRun> runs;
  for (const std::string& name : bound_names(kRunPrefix)) {
    const auto slash = name.rfind('/');
    if (slash != std::string::npos) runs.push_back({name.substr(0, slash), std::atoi(name.c_str() + slash + 1)});
  }
  std::ranges::sort(runs, {}, &ListedRun::run);
  return runs;
}

std::vector<int> free_domains() {
  const auto claimed = bound_names(kDomainPrefix);
  std::vector<int> free;
  for (int domain = 0; domain <= kDomainMax; ++domain) {
    if (std::ranges::find(claimed, std::to_string(domain)) == claimed.end()) free.push_back(domain);
  }
  return free;
}

}  // namespace lukou::launch
