#include "services/lukou/redrive/comparison.hpp"

#include <set>
#include <utility>

namespace lukou::redrive {

void Comparison::add(const TapeStep& recorded, std::uint32_t rsu, const Answer& now) {
  if (lost_.contains(rsu)) return;
  const std::optional<Answer>& before = recorded.answers.at(rsu);
  if (!before) {
    lost_[rsu] = recorded.step;
    return;
  }
  ++steps_;
  if (*before == now) {
    words_[Topic::Kind::kAdvice].same += advice_in(now);
    return;
  }
  compare(recorded, rsu, words_of(*before), words_of(now));
}

void Comparison::compare(const TapeStep& recorded, std::uint32_t rsu, const Words& before, const Words& now) {
  std::set<Topic> topics;
  for (const auto& [topic, word] : before) topics.insert(topic);
  for (const auto& [topic, word] : now) topics.insert(topic);
  bool differs = false;
  for (const Topic& topic : topics) {
    const auto old_word = before.find(topic);
    const auto new_word = now.find(topic);
    WordCounts& counts = words_[topic.kind];
    if (old_word != before.end() && new_word != now.end() && old_word->second == new_word->second) {
      ++counts.same;
      continue;
    }
    differs = true;
    Difference difference{.step = recorded.step, .rsu = rsu, .topic = topic};
    if (old_word != before.end()) difference.recorded = old_word->second.text;
    if (new_word != now.end()) difference.now = new_word->second.text;
    ++(new_word == now.end() ? counts.missing : old_word == before.end() ? counts.added : counts.changed);
    const auto car = recorded.cars.find(topic.id);
    if (topic.kind == Topic::Kind::kAdvice && car != recorded.cars.end()) difference.vehicle = car->second;
    note(std::move(difference));
  }
  if (differs) ++steps_differing_;
}

void Comparison::note(Difference difference) {
  if (!first_) first_ = difference;
  tell_(difference);
}

}  // namespace lukou::redrive
