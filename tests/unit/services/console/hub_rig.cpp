#include "tests/unit/services/console/hub_rig.hpp"

#include <gtest/gtest.h>

#include "console.pb.h"
#include "tests/unit/common/lockstep/empty_road.hpp"

namespace lukou::console {

void Rig::begin(const std::vector<Directive>& so_far, std::optional<Step> recorded_to) {
  auto story = RunStory::of("paper-1", "", recorded_to);
  ASSERT_TRUE(story.ok());
  hub.begin(std::move(story).value(), so_far);
}

std::vector<ToPage> Rig::all(ViewerId viewer) {
  std::vector<ToPage> messages;
  while (const Bytes bytes = hub.next(viewer)) {
    messages.emplace_back();
    EXPECT_TRUE(messages.back().ParseFromString(*bytes));
  }
  return messages;
}

std::vector<ToPage> Rig::all(ViewerId viewer, int kind) {
  auto messages = all(viewer);
  std::erase_if(messages, [&](const ToPage& m) { return m.what_case() != kind; });
  return messages;
}

bool Rig::say(ViewerId viewer, const FromPage& message) { return hub.said(viewer, message.SerializeAsString()); }

void Rig::take_control(ViewerId viewer, bool from_another) {
  FromPage message;
  message.mutable_take_control()->set_from_another(from_another);
  EXPECT_TRUE(say(viewer, message));
}

void Rig::draw(ViewerId viewer) {
  FromPage message;
  message.mutable_drawn();
  EXPECT_TRUE(say(viewer, message));
}

void Rig::ask(ViewerId viewer, const std::string& text, std::uint32_t number) {
  FromPage message;
  message.mutable_request()->set_number(number);
  message.mutable_request()->set_text(text);
  EXPECT_TRUE(say(viewer, message));
}

std::string Rig::refusal(ViewerId viewer, const std::string& text) {
  static_cast<void>(all(viewer));
  ask(viewer, text);
  for (const ToPage& message : all(viewer, ToPage::kReply)) return message.reply().text();
  return "";
}

void Rig::show(Step step, double now_s) {
  View view = empty_road();
  view.step = step;
  hub.show(view, now_s);
}

}  // namespace lukou::console
