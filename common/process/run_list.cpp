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
    const auto slash = name.rfind('/');
    if (slash != std::string::npos) runs.push_back({name.substr(0, slash), std::atoi(name.c_str() + slash + 1)});
  }
  std::ranges::sort(runs, {}, &ListedRun::run);
  return runs;
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
