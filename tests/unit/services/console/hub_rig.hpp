#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/console/hub.hpp"

namespace lukou::console {

class FromPage;
class ToPage;

/// A hub without a bus and without a net: the test is both.
struct Rig {
  explicit Rig(bool may_restart = true) : hub(may_restart) {}
  void begin(const std::vector<Directive>& so_far = {}, std::optional<Step> recorded_to = std::nullopt);
  /// Everything that a viewer would be sent now, if it never draws.
  std::vector<ToPage> all(ViewerId viewer);
  /// What there is of one kind among it: a ToPage::WhatCase.
  std::vector<ToPage> all(ViewerId viewer, int kind);
  bool say(ViewerId viewer, const FromPage& message);
  void take_control(ViewerId viewer, bool from_another = false);
  void draw(ViewerId viewer);
  void ask(ViewerId viewer, const std::string& text, std::uint32_t number = 1);
  /// What the hub itself answers at once; "" if it asks the clock.
  std::string refusal(ViewerId viewer, const std::string& text);
  /// A view of an empty road.
  void show(Step step, double now_s);

  Hub hub;
};

}  // namespace lukou::console
