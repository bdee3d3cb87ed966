#include "services/lukou/replay/recording.hpp"

#include <iterator>
#include <utility>

#include "common/scenario/scenario.hpp"
#include "services/recorder/measure_config.hpp"

namespace lukou::replay {
namespace {

/// From a picture kept to any step before the next one takes some 50 ms; a picture takes about 100 kB.
constexpr Step kKeepEvery = 600;

}  // namespace

Expected<Recording> Recording::open(const std::filesystem::path& folder) {
  auto log = run_log::RunLogReader::open(folder);
  if (!log) return log.error();
  const run_log::Facts& facts = log.value().facts();
  if (facts.level != run_log::Level::kFull) {
    return Error{(folder / run_log::kRunLog).string(),
                 "was recorded with record.log=" + std::string(name(facts.level)) + ", a replay needs FULL"};
  }
  if (log.value().last_step() < 0) return Error{(folder / run_log::kRunLog).string(), "holds no step"};
  const auto scenario = scenario::load_text(facts.scenario, (folder / run_log::kRunLog).string(), "/");
  if (!scenario) return scenario.error();
  auto directives = log.value().directives();
  if (!directives) return directives.error();
  const MeasureParameters parameters = recorder_config(scenario.value()).measures;
  return Recording(std::move(log).value(), parameters, std::move(directives).value());
}

Recording::Recording(run_log::RunLogReader log, const MeasureParameters& parameters, std::vector<Directive> directives)
    : log_(std::move(log)), directives_(std::move(directives)), picture_(parameters) {
  kept_.emplace(-1, picture_);
}

Expected<Step> Recording::go_towards(Step step, Step most) {
  const auto nearest = std::prev(kept_.upper_bound(step));
  if (step < at_ || nearest->first > at_) {
    picture_ = nearest->second;
    at_ = nearest->first;
    log_.seek(at_ + 1);
  }
  for (; at_ < step && most > 0; --most) {
    auto next = log_.next();
    if (!next) return next.error();
    if (next.value() == nullptr || next.value()->step != at_ + 1) {
      return Error{run_log::kRunLog, "lacks step " + std::to_string(at_ + 1)};
    }
    run_log::LoggedStep& logged = *next.value();
    if (auto done = picture_.add(logged.traffic, logged.signal ? &*logged.signal : nullptr); !done) return done.error();
    picture_.keep(logged.traffic);
    if (++at_ % kKeepEvery == 0) kept_.emplace(at_, picture_);
  }
  return at_;
}

}  // namespace lukou::replay
