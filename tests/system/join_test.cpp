#include <gtest/gtest.h>
#include <unistd.h>

#include "common/bus/participant.hpp"
#include "common/process/run_list.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

/// Waits until the run is listed.
Expected<bus::Address> address_of(const std::string& run) {
  for (int i = 0; i < 500; ++i) {
    if (auto found = process::find_run(run, {.domain = -1})) return found;
    usleep(20'000);
  }
  return Error{run, "is not listed"};
}

TEST(Join, IsAnsweredAlsoToWhoIsHeardLongBeforeItHears) {
  const TemporaryFolder folder;
  const std::string id = fresh_run_id();
  Program run({"run", "paper", "--duration", "10", "--quiet", "--run-id", id, "--rsu", "wait", "--out", folder / "r"});
  const auto address = address_of(id);
  ASSERT_TRUE(address.ok()) << address.error().text();
  const Incarnation self = static_cast<Incarnation>(getpid());
  auto participant = bus::Participant::join(address.value(), "rsu0", self);
  ASSERT_TRUE(participant.ok()) << participant.error().text();
  bus::Writer<Up> up(*participant.value());
  const auto ask = [&] { up.write({.kind = Up::Kind::kJoin, .incarnation = self, .role = "rsu0"}); };
  for (int i = 0; i < 500 && up.matched().empty(); ++i) usleep(20'000);
  for (int i = 0; i < 10; ++i) {
    ask();
    usleep(50'000);
  }
  bus::Reader<Control> control(*participant.value());
  bool welcome = false;
  for (int i = 0; i < 200 && !welcome; ++i) {
    ask();
    participant.value()->wait(0.05);
    control.take([&](Control& said, const bus::SampleInfo&) {
      welcome = welcome || (said.kind == Control::Kind::kWelcome && said.to == self);
    });
  }
  EXPECT_TRUE(welcome);
}

}  // namespace
}  // namespace lukou::test
