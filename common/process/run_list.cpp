#include "common/process/run_list.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace lukou::process {
namespace {

constexpr std::string_view kSocketPrefix = "lukou/run/";
constexpr std::string_view kSecured = "secured";
constexpr std::string_view kHosts = "hosts";

/// "<run>/<domain>/<clock>", then "/secured" and "/hosts" if it is so.
ListedRun parsed(const std::string& name) {
  std::stringstream parts(name);
  ListedRun run;
  std::string part;
  std::getline(parts, run.run, '/');
  if (std::getline(parts, part, '/')) run.domain = std::atoi(part.c_str());
  if (std::getline(parts, part, '/')) run.clock = std::strtoull(part.c_str(), nullptr, 16);
  while (std::getline(parts, part, '/')) {
    run.secured = run.secured || part == kSecured;
    run.hosts = run.hosts || part == kHosts;
  }
  return run;
}

Expected<bus::Address> address_of(const ListedRun& listed, const bus::Address& given) {
  if (listed.secured && given.identity.empty()) {
    return Error{listed.run, "is secured: --identity KEYS/observer, or LUKOU_IDENTITY"};
  }
  if (!listed.secured && !given.identity.empty()) return Error{listed.run, "is not secured: give no --identity"};
  if (listed.hosts && given.peers.empty()) {
    return Error{listed.run, "is spread over several hosts: --peers, or LUKOU_PEERS, with their addresses"};
  }
  bus::Address address = given;
  address.domain = listed.domain;
  address.run = listed.run;
  return address;
}

}  // namespace

std::string socket_name(const ListedRun& run) {
  std::string name =
      std::string(kSocketPrefix) + run.run + "/" + std::to_string(run.domain) + "/" + bus::text_of(run.clock);
  if (run.secured) name.append("/").append(kSecured);
  if (run.hosts) name.append("/").append(kHosts);
  return name;
}

std::vector<std::string> bound_names(std::string_view prefix) {
  const std::string wanted = " @" + std::string(prefix);
  std::vector<std::string> names;
  std::ifstream sockets("/proc/net/unix");
  std::string line;
  while (std::getline(sockets, line)) {
    const auto at = line.find(wanted);
    if (at != std::string::npos) names.push_back(line.substr(at + wanted.size()));
  }
  return names;
}

std::vector<ListedRun> list_runs() {
  std::vector<ListedRun> runs;
  for (const std::string& name : bound_names(kSocketPrefix)) {
    if (const ListedRun run = parsed(name); run.domain >= 0) runs.push_back(run);
  }
  std::ranges::sort(runs, {}, &ListedRun::run);
  return runs;
}

Incarnation clock_of(const bus::Address& address) {
  for (const ListedRun& run : list_runs())
    if (run.run == address.run && run.domain == address.domain) return run.clock;
  return 0;
}

Expected<bus::Address> find_run(const std::string& name, const bus::Address& given) {
  std::vector<ListedRun> matching;
  std::string all;
  for (const ListedRun& run : list_runs()) {
    all += " " + run.run;
    if (run.run == name) return address_of(run, given);
    if (run.run.starts_with(name)) matching.push_back(run);
  }
  if (matching.size() == 1) return address_of(matching.front(), given);
  if (matching.size() > 1) return Error{name, "several runs begin so:" + all};
  if (given.domain >= 0) {
    bus::Address elsewhere = given;
    elsewhere.run = name;
    return elsewhere;
  }
  if (all.empty()) return Error{name, "no run on this host; one of another host needs --domain, too"};
  return Error{name, "no run of this name; there are:" + all};
}

}  // namespace lukou::process
