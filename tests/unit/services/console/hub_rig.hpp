#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "console.pb.h"
#include "services/console/hub.hpp"

namespace lukou::console {

/// A hub without a bus and without a net: the test is both.
struct Rig {
  explicit Rig(bool may_restart = true) : hub(may_restart) {}
  void begin(const std::vector<Directive>& so_far = {}, std::optional<Step> recorded_to = std::nullopt) {
    auto story = RunStory::of("paper-1", "", recorded_to);
    ASSERT_TRUE(story.ok());
    hub.begin(std::move(story).value(), so_far);
  }
  /// Everything that a viewer would be sent now, if it never draws.
  std::vector<ToPage> all(ViewerId viewer) {
    std::vector<ToPage> messages;
    while (const Bytes bytes = hub.next(viewer)) {
      messages.emplace_back();
      EXPECT_TRUE(messages.back().ParseFromString(*bytes));
    }
    return messages;
  }
  std::vector<ToPage> all(ViewerId viewer, ToPage::WhatCase kind) {
    auto messages = all(viewer);
    std::erase_if(messages, [&](const ToPage& m) { return m.what_case() != kind; });
    return messages;
  }
  bool say(ViewerId viewer, const FromPage& message) { return hub.said(viewer, message.SerializeAsString()); }
  void take_control(ViewerId viewer, bool from_another = false) {
    FromPage message;
    message.mutable_take_control()->set_from_another(from_another);
    EXPECT_TRUE(say(viewer, message));
  }
  void draw(ViewerId viewer) {
    FromPage message;
    message.mutable_drawn();
    EXPECT_TRUE(say(viewer, message));
  }
  void ask(ViewerId viewer, const std::string& text, std::uint32_t number = 1) {
    FromPage message;
    message.mutable_request()->set_number(number);
    message.mutable_request()->set_text(text);
    EXPECT_TRUE(say(viewer, message));
  }
  /// What the hub itself answers at once; "" if it asks the clock.
  std::string refusal(ViewerId viewer, const std::string& text) {
    static_cast<void>(all(viewer));
    ask(viewer, text);
    for (const ToPage& message : all(viewer, ToPage::kReply)) return message.reply().text();
    return "";
  }
  void show(Step step, double now_s) {
    View view;
    view.step = step;
    FigureColumns& f = view.figures;
    for (auto* column : {&f.arrived, &f.waiting, &f.in_system, &f.left, &f.standing, &f.stops}) column->resize(3);
    for (auto* column :
         {&f.throughput_veh_per_h, &f.stops_per_vehicle, &f.stop_time_s, &f.mean_stop_time_s, &f.mean_delay_s}) {
      column->resize(3);
    }
    view.queue.resize(12);
    view.arrived.resize(4);
    view.waiting.resize(4);
    hub.show(view, now_s);
  }

  Hub hub;
};

}  // namespace lukou::console
