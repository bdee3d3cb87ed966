#pragma once

#include <filesystem>

#include "common/core/expected.hpp"

namespace lukou::replay {

/// Computes a run once more, with the whole run log, into a temporary folder, and makes sure that it is the same run:
/// scenario and directives reproduce it byte for byte.
class ComputedAgain {
 public:
  /// Errors: a folder without scenario, a run that cannot be computed in one process, other tables than before.
  static Expected<ComputedAgain> compute(const std::filesystem::path& result);
  ComputedAgain(ComputedAgain&& other) noexcept;
  ComputedAgain& operator=(ComputedAgain&& other) noexcept;
  /// Removes the folder.
  ~ComputedAgain();
  [[nodiscard]] std::filesystem::path folder() const { return temporary_ / "run"; }

 private:
  explicit ComputedAgain(std::filesystem::path temporary) : temporary_(std::move(temporary)) {}
  std::filesystem::path temporary_;
};

}  // namespace lukou::replay
