#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/intersection/actuation.hpp"
#include "common/intersection/lane_set.hpp"

namespace lukou {

/// A request for greens as an RSU sent it; anything may stand in it.
struct GreenRequest {
  std::uint32_t rsu = 0;
  Step asked = 0;           ///< the RSU's step
  std::uint16_t lanes = 0;  ///< bit n = lane n
  Step lifetime = 0;        ///< steps
};

/// What became of a request, and when.
struct RequestNews {
  Step step = 0;  ///< of the controller
  GreenRequest request;
  RequestOutcome outcome = RequestOutcome::kAccepted;
};

/// Takes or refuses the requests of the RSUs and knows the one in force: the newest one of the RSU with the lowest
/// index.
class RequestDesk {
 public:
  /// A request that reaches the controller with its step k: k = asked + 1. In force, if it is taken, for the steps
  /// asked + 1 ... asked + lifetime; an earlier one of the same RSU ends there.
  void take(const GreenRequest& request, Step k);
  /// The lanes that the request in force wants green in step k; empty if there is none. Steps never decrease.
  std::optional<LaneSet> wanted(Step k);
  /// How the request in force fared in step k.
  void tell(Step k, RequestOutcome outcome);

  /// What became of requests since clear_news(), in the order of the steps; of the one in force each change.
  [[nodiscard]] const std::vector<RequestNews>& news() const { return news_; }
  void clear_news() { news_.clear(); }

 private:
  [[nodiscard]] static std::optional<RequestOutcome> fault(const GreenRequest& request);

  std::optional<GreenRequest> in_force_;
  std::optional<RequestOutcome> told_;  ///< of the one in force
  std::vector<RequestNews> news_;
};

}  // namespace lukou
