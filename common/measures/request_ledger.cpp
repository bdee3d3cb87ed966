#include "common/measures/request_ledger.hpp"

#include <string>

namespace lukou {

Expected<Done> RequestLedger::add(const SignalBatch& batch) {
  rows_.clear();
  const std::size_t count_of_all = batch.request_step.size();
  if (batch.request_asked.size() != count_of_all || batch.request_rsu.size() != count_of_all ||
      batch.request_lanes.size() != count_of_all || batch.request_outcome.size() != count_of_all) {
    return Error{"topic lukou/signal", "the columns of requests differ in length"};
  }
  for (std::size_t i = 0; i < count_of_all; ++i) {
    if (batch.request_outcome[i] >= kRequestOutcomes) {
      return Error{"topic lukou/signal",
                   "a request has the unknown outcome " + std::to_string(static_cast<int>(batch.request_outcome[i]))};
    }
    const RequestRow row{.step = batch.request_step[i],
                         .rsu = batch.request_rsu[i],
                         .lanes = LaneSet::from_bits(batch.request_lanes[i]),
                         .outcome = static_cast<RequestOutcome>(batch.request_outcome[i])};
    count(row, batch.request_asked[i]);
    auto& before = rsus_[row.rsu].row;
    if (!before || before->lanes != row.lanes || before->outcome != row.outcome) rows_.push_back(row);
    before = row;
  }
  return Done{};
}

void RequestLedger::count(const RequestRow& row, Step asked) {
  Rsu& rsu = rsus_[row.rsu];
  const bool is_new = asked > rsu.asked;
  if (is_new) {
    rsu.asked = asked;
    ++figures_.asked;
    if (is_followed(row.outcome)) ++figures_.followed;
  }
  if (row.outcome == RequestOutcome::kAccepted || row.outcome == RequestOutcome::kEnded) return;
  if (!is_new && !is_followed(row.outcome)) return;  // was followed before it was given up
  const auto outcome = static_cast<std::size_t>(row.outcome);
  if (rsu.counted_at[outcome] > asked) return;
  rsu.counted_at[outcome] = asked + 1;
  ++figures_.by_outcome[outcome];
}

void RequestLedger::add_fixed_plan(std::uint64_t requests) {
  figures_.asked += requests;
  figures_.fixed_plan += requests;
}

}  // namespace lukou
