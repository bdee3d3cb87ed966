#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/expected.hpp"
#include "common/measures/rows.hpp"

namespace lukou {

/// How the requests for greens of a run fared.
struct RequestFigures {
  std::uint64_t asked = 0;  ///< each request once: followed or refused
  std::uint64_t followed = 0;
  /// Requests by RequestOutcome. Of those that were followed, kMinGreen and kMaxWait count the ones to which it ever
  /// happened; kAccepted and kEnded stay 0.
  std::array<std::uint64_t, kRequestOutcomes> by_outcome{};
  std::uint64_t fixed_plan = 0;  ///< refused, since the plan is fixed
  [[nodiscard]] std::uint64_t count(RequestOutcome outcome) const {
    return by_outcome[static_cast<std::size_t>(outcome)];
  }
  [[nodiscard]] std::uint64_t refused() const { return asked - followed; }
};

/// Keeps the book of what RSUs asked of the signal controller.
class RequestLedger {
 public:
  /// What the controller said of requests in a batch. Errors: columns of unequal length, an unknown outcome.
  Expected<Done> add(const SignalBatch& batch);
  /// Requests that no controller was to hear: the plan is fixed.
  void add_fixed_plan(std::uint64_t requests);
  /// Rows of the newest batch: what differs from the row before of the same RSU.
  [[nodiscard]] std::span<const RequestRow> rows() const { return rows_; }
  [[nodiscard]] const RequestFigures& figures() const { return figures_; }

 private:
  struct Rsu {
    std::optional<RequestRow> row;                    ///< the newest
    Step asked = -1;                                  ///< of the newest request
    std::array<Step, kRequestOutcomes> counted_at{};  ///< by RequestOutcome: the newest request counted under it, + 1
  };
  void count(const RequestRow& row, Step asked);

  std::map<std::uint32_t, Rsu> rsus_;
  std::vector<RequestRow> rows_;
  RequestFigures figures_;
};

}  // namespace lukou
