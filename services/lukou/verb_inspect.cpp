#include <cstdio>
#include <memory>

#include "common/core/step.hpp"
#include "common/process/environment.hpp"
#include "common/results/inspection.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

int inspect(const std::string& folder) {
  const auto inspected = results::inspect(folder);
  if (!inspected) {
    std::fprintf(stderr, "%s\n", inspected.error().text().c_str());
    return process::kExitUsage;
  }
  const results::Inspection& inspection = inspected.value();
  for (const results::Fault& fault : inspection.faults)
    std::printf("%s%s\n", fault.text().c_str(), fault.repairable ? " (repairable)" : "");
  const auto complete = static_cast<long long>(inspection.complete_to_step);
  std::printf("complete to step %lld (%.1f s)", complete, time_s(inspection.complete_to_step));
  if (inspection.manifest) {
    std::printf(" of %lld, ended by %s", static_cast<long long>(inspection.manifest->steps_planned),
                inspection.manifest->ended_by.c_str());
    if (!inspection.manifest->culprit.empty()) std::printf(" (%s)", inspection.manifest->culprit.c_str());
  } else {
    std::printf(", no manifest: the run has not ended, or ended without its recorder and its launcher");
  }
  std::printf("\n%s: %s\n", folder.c_str(), inspection.sound() ? "sound" : "not sound");
  return inspection.sound() ? process::kExitDone : process::kExitInternal;
}

}  // namespace

Action add_inspect(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("inspect", "is a result folder whole, up to which step, ended by what");
  auto folder = std::make_shared<std::string>();
  verb->add_option("result", *folder, "result folder")->required();
  return [folder] { return inspect(*folder); };
}

}  // namespace lukou
