#pragma once

#include <vector>

#include "common/core/step.hpp"

namespace lukou::console {

class Event;
class History;
class Statistics;

/// What a viewer who comes later needs of the time before. Bounded: with age its samples are thinned out.
class Past {
 public:
  Past();
  ~Past();
  Past(const Past&) = delete;
  Past& operator=(const Past&) = delete;
  /// Another run has begun.
  void clear();

  void add(const Statistics& sample);
  void add(const Event& event);
  /// Time has gone back to before `step`: samples from there on will come again.
  void forget_from(Step step);
  [[nodiscard]] History message() const;
  [[nodiscard]] std::size_t samples() const;

 private:
  std::vector<Statistics> samples_;
  std::vector<Event> events_;
};

}  // namespace lukou::console
