#include "services/lukou/launch/rsu_child.hpp"

#include <cstdlib>
#include <utility>

#include "common/lockstep/roster.hpp"
#include "services/lukou/home.hpp"

namespace lukou::launch {
namespace {

/// Where Python finds the module `lukou`, before what the user has set.
std::string python_path() {
  const char* set = std::getenv("PYTHONPATH");
  const std::string ours = find_home().python.string();
  return set == nullptr || *set == '\0' ? ours : ours + ":" + set;
}

}  // namespace

ChildSpec rsu_child(std::uint32_t rsu, const std::string& command, std::vector<std::string> variables) {
  variables.push_back("LUKOU_RSU=" + std::to_string(rsu));
  variables.push_back("PYTHONPATH=" + python_path());
  return {.role = rsu_role(rsu), .command = {"/bin/sh", "-c", "exec " + command}, .environment = std::move(variables)};
}

}  // namespace lukou::launch
