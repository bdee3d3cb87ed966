#include "services/lukou/launch/cores.hpp"

#include <sched.h>

namespace lukou::launch {

std::vector<int> usable_cores() {
  cpu_set_t ours;
  std::vector<int> cores;
  if (sched_getaffinity(0, sizeof ours, &ours) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(static_cast<unsigned>(core), &ours)) cores.push_back(core);
  return cores;
}

void stay_on(int core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<unsigned>(core), &one);
  sched_setaffinity(0, sizeof one, &one);
}

}  // namespace lukou::launch
