#include <cstdio>

#include "common/process/environment.hpp"
#include "common/scenario/scenario.hpp"
#include "services/lukou/verbs.hpp"
#include "services/rsu/algorithms/registry.hpp"

namespace lukou {
namespace {

/// "[1, 60]", or the words of an enum.
std::string values_of(const scenario::FieldDoc& doc) {
  if (!doc.min && !doc.max) return doc.type;
  char range[64];
  std::snprintf(range, sizeof range, "[%g, %g]", doc.min.value_or(0.0), doc.max.value_or(0.0));
  return range;
}

/// Each algorithm with its parameters, as the scenario's schema documents them.
int algorithms() {
  const auto docs = scenario::field_docs();
  for (const AlgorithmDoc& algorithm : algorithm_docs()) {
    std::printf("%s: %s\n  source: %s\n", std::string(algorithm.name).c_str(), std::string(algorithm.what).c_str(),
                std::string(algorithm.source).c_str());
    const std::string prefix = "rsus[]." + std::string(algorithm.name) + ".";
    for (const scenario::FieldDoc& doc : docs) {
      if (!doc.path.starts_with(prefix)) continue;
      const std::string unit = doc.unit.empty() ? "" : " " + doc.unit;
      std::printf("  %-24s default %s%s, %s; %s\n", doc.path.substr(prefix.size()).c_str(), doc.fallback.c_str(),
                  unit.c_str(), values_of(doc).c_str(), doc.source.c_str());
    }
  }
  return process::kExitDone;
}

}  // namespace

Action add_algorithms(CLI::App& app) {
  app.add_subcommand("algorithms", "the shipped RSU algorithms with their parameters");
  return algorithms;
}

}  // namespace lukou
