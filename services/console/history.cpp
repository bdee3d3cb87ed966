#include "services/console/history.hpp"

#include "console.pb.h"

namespace lukou::console {
namespace {

constexpr std::size_t kSamplesMax = 800;
constexpr std::size_t kEventsMax = 200;

}  // namespace

Past::Past() = default;
Past::~Past() = default;

void Past::clear() {
  samples_.clear();
  events_.clear();
}

void Past::add(const Statistics& sample) {
  samples_.push_back(sample);
  if (samples_.size() < kSamplesMax) return;
  // Every second of the older half: what is old has been through this more often.
  std::vector<Statistics> kept;
  kept.reserve(samples_.size());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (i >= samples_.size() / 2 || i % 2 == 0) kept.push_back(std::move(samples_[i]));
  }
  samples_ = std::move(kept);
}

void Past::add(const Event& event) {
  events_.push_back(event);
  if (events_.size() > kEventsMax) events_.erase(events_.begin());
}

void Past::forget_from(Step step) {
  std::erase_if(samples_, [step](const Statistics& sample) { return sample.step() >= step; });
}

std::size_t Past::samples() const { return samples_.size(); }

History Past::message() const {
  History history;
  for (const Statistics& sample : samples_) *history.add_samples() = sample;
  for (const Event& event : events_) *history.add_events() = event;
  return history;
}

}  // namespace lukou::console
