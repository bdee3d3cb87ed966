#include "common/process/run_list.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace lukou::process {

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
  for (const std::string& name : bound_names(kRunSocketPrefix)) {
    const auto clock = name.rfind('/');
    const auto domain = clock == std::string::npos || clock == 0 ? clock : name.rfind('/', clock - 1);
    if (domain == std::string::npos) continue;
    runs.push_back({name.substr(0, domain), std::atoi(name.c_str() + domain + 1),
                    std::strtoull(name.c_str() + clock + 1, nullptr, 16)});
  }
  std::ranges::sort(runs, {}, &ListedRun::run);
  return runs;
}

std::string run_socket_name(const std::string& run, int domain, Incarnation clock) {
  return std::string(kRunSocketPrefix) + run + "/" + std::to_string(domain) + "/" + bus::text_of(clock);
}

Incarnation clock_of(const bus::Address& address) {
  for (const ListedRun& run : list_runs())
    if (run.run == address.run && run.domain == address.domain) return run.clock;
  return 0;
}

Expected<ListedRun> find_run(const std::string& name) {
  std::vector<ListedRun> matching;
  std::string all;
  for (const ListedRun& run : list_runs()) {
    all += " " + run.run;
    if (run.run == name) return run;
    if (run.run.starts_with(name)) matching.push_back(run);
  }
  if (matching.size() == 1) return matching.front();
  if (all.empty()) return Error{name, "no run on this host"};
  return Error{name, (matching.empty() ? "no run of this name; there are:" : "several runs begin so:") + all};
}

}  // namespace lukou::process
