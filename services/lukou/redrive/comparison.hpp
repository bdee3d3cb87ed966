#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "services/lukou/redrive/answer.hpp"
#include "services/lukou/redrive/tape.hpp"

namespace lukou::redrive {

/// A word that one RSU said and the other did not, or said otherwise.
struct Difference {
  Step step = 0;
  std::uint32_t rsu = 0;
  Topic topic;
  std::optional<std::uint32_t> vehicle;  ///< of advice, if the car spoke in that step
  std::string recorded;                  ///< empty: was not said
  std::string now;                       ///< likewise
};

/// Words of one kind.
struct WordCounts {
  std::uint64_t same = 0;
  std::uint64_t changed = 0;
  std::uint64_t missing = 0;  ///< in the record alone
  std::uint64_t added = 0;    ///< said now alone
};

/// Compares answers step by step.
class Comparison {
 public:
  /// `tell`: is told every difference, in the order of steps, RSUs, kinds and cars.
  explicit Comparison(std::function<void(const Difference&)> tell) : tell_(std::move(tell)) {}

  /// What an RSU answers now in a step. An RSU that the engine did not hear in the record, or heard as a later start of
  /// its process, is compared no further.
  void add(const TapeStep& recorded, std::uint32_t rsu, const Answer& now);

  [[nodiscard]] bool same() const { return !first_.has_value(); }
  [[nodiscard]] const std::optional<Difference>& first() const { return first_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }  ///< compared, a step of each RSU by itself
  [[nodiscard]] std::uint64_t steps_differing() const { return steps_differing_; }
  [[nodiscard]] const std::map<Topic::Kind, WordCounts>& words() const { return words_; }
  /// The step in which the record lost each RSU.
  [[nodiscard]] const std::map<std::uint32_t, Step>& lost() const { return lost_; }

 private:
  void compare(const TapeStep& recorded, std::uint32_t rsu, const Words& before, const Words& now);
  void note(Difference difference);

  std::function<void(const Difference&)> tell_;
  std::optional<Difference> first_;
  std::uint64_t steps_ = 0;
  std::uint64_t steps_differing_ = 0;
  std::map<Topic::Kind, WordCounts> words_;
  std::map<std::uint32_t, Step> lost_;
};

}  // namespace lukou::redrive
