#pragma once

#include <string>
#include <vector>

#include "common/core/expected.hpp"
#include "common/process/run_list.hpp"

namespace lukou::launch {

/// A DDS domain id that belongs to one run on this host (network namespace): claimed by binding an abstract Unix
/// socket, so that two launchers never get the same and the kernel frees it when the launcher dies, however it dies.
class DomainClaim {
 public:
  /// The lowest free id in [0, 100]. `run` is published with it: process::list_runs(); its domain counts not.
  static Expected<DomainClaim> lowest_free(process::ListedRun run);
  DomainClaim(DomainClaim&& other) noexcept;
  DomainClaim& operator=(DomainClaim&& other) noexcept;
  ~DomainClaim();

  [[nodiscard]] int domain() const { return domain_; }

 private:
  DomainClaim(int domain, int domain_socket, int run_socket)
      : domain_(domain), domain_socket_(domain_socket), run_socket_(run_socket) {}
  int domain_ = -1;
  int domain_socket_ = -1;
  int run_socket_ = -1;
};

/// Ids in [0, 100] that no run has claimed.
std::vector<int> free_domains();

}  // namespace lukou::launch
