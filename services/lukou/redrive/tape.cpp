#include "services/lukou/redrive/tape.hpp"

#include <algorithm>
#include <utility>

namespace lukou::redrive {
namespace {

/// The frames of one RSU.
Frames of_rsu(const Frames& frames, const std::vector<std::uint32_t>& rsus, std::uint32_t rsu) {
  Frames found;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (rsus[i] != rsu) continue;
    found.sender.push_back(frames.sender[i]);
    found.sequence.push_back(frames.sequence[i]);
    found.kind.push_back(frames.kind[i]);
    found.wire_bytes.push_back(frames.wire_bytes[i]);
    found.antenna_x_m.push_back(frames.antenna_x_m[i]);
    found.antenna_y_m.push_back(frames.antenna_y_m[i]);
    const auto payload = frames.payload_of(i);
    found.payload.insert(found.payload.end(), payload.begin(), payload.end());
    found.payload_end.push_back(static_cast<std::uint32_t>(found.payload.size()));
  }
  return found;
}

std::vector<std::optional<Answer>> answers_in(const TrafficBatch& after) {
  std::vector<std::optional<Answer>> answers(after.heard_epoch.size());
  for (std::uint32_t rsu = 0; rsu < answers.size(); ++rsu) {
    if (after.heard_epoch[rsu] != 1) continue;
    Answer& answer = answers[rsu].emplace();
    answer.frames = of_rsu(after.said, after.said_rsu, rsu);
    for (std::size_t i = 0; i < after.asked_rsu.size(); ++i) {
      if (after.asked_rsu[i] != rsu) continue;
      answer.request_lanes.push_back(after.asked_lanes[i]);
      answer.request_lifetime.push_back(after.asked_lifetime[i]);
    }
  }
  return answers;
}

/// Cars with a unit speak in the order in which they stand.
std::map<std::uint64_t, std::uint32_t> speakers(const TrafficBatch& traffic) {
  std::map<std::uint64_t, std::uint32_t> cars;
  std::size_t frame = 0;
  for (std::size_t car = 0; car < traffic.vehicle.size() && frame < traffic.air.size(); ++car) {
    if (traffic.equipped[car] != 0) cars[traffic.air.sender[frame++]] = traffic.vehicle[car];
  }
  return cars;
}

}  // namespace

Expected<Tape> Tape::open(const std::filesystem::path& folder) {
  auto log = run_log::RunLogReader::open(folder);
  if (!log) return log.error();
  const std::string where = (folder / run_log::kRunLog).string();
  if (log.value().facts().level != run_log::Level::kFull) {
    return Error{where, "was recorded with record.log=" + std::string(name(log.value().facts().level)) +
                            ", a redrive needs FULL"};
  }
  Tape tape(std::move(log).value());
  if (tape.last() < 0) return Error{where, "holds no step whose answers are known"};
  if (const auto first = tape.read(); !first) return first.error();
  return tape;
}

Expected<bool> Tape::read() {
  auto next = log_.next();
  if (!next) return next.error();
  if (next.value() == nullptr) return false;
  std::swap(logged_, *next.value());
  return true;
}

Expected<TapeStep*> Tape::next() {
  step_.step = logged_.step;
  step_.directives = std::move(logged_.directives);
  step_.signal = std::move(logged_.signal);
  step_.cars = speakers(logged_.traffic);
  step_.air.step = logged_.step;
  std::swap(step_.air.frames, logged_.traffic.air);
  std::swap(step_.air.sensed, logged_.traffic.sensed);
  const auto more = read();
  if (!more) return more.error();
  if (!more.value()) return static_cast<TapeStep*>(nullptr);
  if (logged_.step != step_.step + 1) return Error{run_log::kRunLog, "lacks step " + std::to_string(step_.step + 1)};
  step_.answers = answers_in(logged_.traffic);
  return &step_;
}

}  // namespace lukou::redrive
