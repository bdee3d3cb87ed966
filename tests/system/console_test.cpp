// A console and its viewers on real processes. The page's own tests stand in tests/browser.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "console.pb.h"
#include "tests/system/page_client.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using console::ToPage;

void pause_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// The port in "http://127.0.0.1:PORT/", once the program has said it; 0 if it does not within 20 s.
std::uint16_t port_said(const std::function<std::string()>& text) {
  for (int i = 0; i < 400; ++i) {
    const std::string said = text();
    const auto at = said.find("http://127.0.0.1:");
    if (at != std::string::npos && said.find('/', at + 17) != std::string::npos) {
      return static_cast<std::uint16_t>(std::atoi(said.c_str() + at + 17));
    }
    pause_s(0.05);
  }
  return 0;
}

/// A run under a console, at a pace that leaves time to act.
struct Watched {
  explicit Watched(const TemporaryFolder& folder, std::vector<std::string> more = {})
      : run(fresh_run_id()), launcher(arguments(folder, run, std::move(more))) {
    port = port_said([this] { return launcher.err(); });
  }
  static std::vector<std::string> arguments(const TemporaryFolder& folder, const std::string& run,
                                            std::vector<std::string> more) {
    std::vector<std::string> words = {
        "run",      "paper", "--console=8123", "--set",     "run.duration_s=3000", "--quiet",
        "--run-id", run,     "--out",          folder / "r"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  std::string run;
  Program launcher;
  std::uint16_t port = 0;
};

bool is_picture(const ToPage& message) { return message.has_picture(); }

/// Waits until a run has ended and ends its console as a user does; returns the exit code.
int leave(Watched& watched) {
  for (int i = 0; i < 200 && watched.launcher.err().find("console: shows the end") == std::string::npos; ++i) {
    pause_s(0.05);
  }
  watched.launcher.signal(SIGINT);
  return watched.launcher.wait(20.0);
}

/// Stops a watched run from its page.
int stop(Watched& watched, PageClient& page) {
  page.take_control(true);
  EXPECT_TRUE(page.ask("stop").starts_with("ends at step "));
  EXPECT_TRUE(page.until([](const ToPage& m) { return m.has_status() && m.status().phase() == "ended"; }));
  return leave(watched);
}

TEST(Console, GreetsAViewerAndShowsEveryStepAtRealTime) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "1"});
  PageClient page(watched.port);
  ASSERT_EQ(page.status(), 101);
  const auto hello = page.next(20.0);
  ASSERT_TRUE(hello && hello->has_hello()) << "it comes first";
  EXPECT_EQ(hello->hello().run(), watched.run);
  EXPECT_EQ(hello->hello().lanes_size(), 12);
  EXPECT_EQ(hello->hello().conflicts().size(), 144U);
  EXPECT_TRUE(hello->hello().may_restart());
  const auto first = page.until(is_picture);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->picture().program().lanes_size(), 12) << "the first one brings the signal program";
  EXPECT_EQ(first->picture().program().cycle_steps(), 900U);
  std::int64_t step = first->picture().step();
  int missing = 0;
  for (int i = 0; i < 30; ++i) {
    const auto picture = page.until(is_picture);
    ASSERT_TRUE(picture);
    EXPECT_GT(picture->picture().step(), step);
    missing += static_cast<int>(picture->picture().step() - step - 1);
    step = picture->picture().step();
    EXPECT_FALSE(picture->picture().has_program());
    EXPECT_EQ(picture->picture().heads().size(), 12U);
  }
  // A busy machine may be late with two steps at once; the rule is one picture a step.
  EXPECT_LE(missing, 3);
  EXPECT_EQ(stop(watched, page), 0) << watched.launcher.err();
}

TEST(Console, StartsAHeldRunAndSteersIt) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "20", "--wait"});
  PageClient page(watched.port);
  page.take_control();
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_status() && m.status().phase() == "paused"; }));
  EXPECT_EQ(page.ask("set traffic.west.flow_veh_per_h=600"), "traffic.west.flow_veh_per_h=600 from step 1 (0.1 s)");
  EXPECT_EQ(page.ask("step 30"), "pauses at step 30 (3.0 s)");
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_picture() && m.picture().step() == 30; }));
  EXPECT_EQ(page.ask("resume"), "runs");
  EXPECT_EQ(page.ask("pace 50"), "pace 50");
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_picture() && m.picture().step() > 200; }));
  EXPECT_TRUE(page.ask("vanish").starts_with("refused: `vanish` is not a request"));
  EXPECT_TRUE(page.ask("interrupt").starts_with("refused: ")) << "a verb of the bus, not of the page";
  EXPECT_TRUE(page.ask("set vehicles.length_m=3").starts_with("refused: ")) << "not live";
  EXPECT_NE(page.ask("set traffic.west.flow_veh_per_h=99999").find("must be within [0, 10800] veh/h"),
            std::string::npos);
  EXPECT_EQ(stop(watched, page), 0);
  // What was done stands in the directives and replays to the same bytes.
  EXPECT_NE(content(folder / "r/directives.textproto").find("flow_veh_per_h=600"), std::string::npos);
  const Finished replay = lukou({"run", folder / "r/scenario.textproto", "--mode", "in-process", "--quiet",
                                 "--replay-directives", folder / "r/directives.textproto", "--out", folder / "replay"});
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(differing_files(folder / "r", folder / "replay"), std::vector<std::string>{});
}

TEST(Console, TakesAWholeSignalPlanAndRefusesOneThatCrosses) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "100"});
  PageClient page(watched.port);
  page.take_control();
  const std::string we = R"(["WL","WC","WR","EL","EC","ER"])";
  const std::string sn = R"(["SL","SC","SR","NL","NC","NR"])";
  const std::string first = " aspects {aspect: GREEN duration_s: 20} aspects {aspect: RED duration_s: 20}}";
  const std::string second = " aspects {aspect: RED duration_s: 20} aspects {aspect: GREEN duration_s: 20}}";
  const auto plan = [&](const std::string& of_we, const std::string& of_sn) {
    return "set signals.plan={cycle_s: 40 lane_plans {lanes: " + we + of_we + " lane_plans {lanes: " + sn + of_sn + "}";
  };
  ASSERT_TRUE(page.until(is_picture));
  EXPECT_NE(page.ask(plan(first, first)).find("lets crossing streams go together: WL and SL"), std::string::npos);
  const std::string answer = page.ask(plan(first, second));
  EXPECT_FALSE(answer.starts_with("refused")) << answer;
  const auto at = answer.rfind(" from step ");
  ASSERT_NE(at, std::string::npos);
  const long long asked = std::atoll(answer.c_str() + at + 11);
  const auto changed = page.until([](const ToPage& m) {
    return m.has_picture() && m.picture().has_program() && m.picture().program().cycle_steps() == 400;
  });
  ASSERT_TRUE(changed);
  // The paper's plan starts a cycle every 900 steps; a change is promised 10 steps ahead.
  const long long start = (asked + 10 + 899) / 900 * 900;
  EXPECT_EQ(changed->picture().program_from(), start);
  EXPECT_GE(changed->picture().step(), start);
  EXPECT_EQ(stop(watched, page), 0);
}

TEST(Console, GivesControlToOneViewerAtATime) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "20"});
  PageClient one(watched.port);
  ASSERT_TRUE(one.until(is_picture));
  EXPECT_EQ(one.ask("pause"), "refused: nobody has control; take it first");
  one.take_control();
  PageClient two(watched.port);
  ASSERT_TRUE(two.until([](const ToPage& m) { return m.has_hands() && m.hands().holder() == 1; }));
  EXPECT_EQ(two.ask("pause"), "refused: viewer 1 has control");
  two.take_control();
  EXPECT_EQ(two.ask("pause"), "refused: viewer 1 has control") << "asked for, but not from another";
  two.take_control(true);
  EXPECT_TRUE(two.ask("pause").starts_with("pauses at step "));
  ASSERT_TRUE(one.until([](const ToPage& m) { return m.has_hands() && m.hands().holder() == 2; })) << "it is told";
  EXPECT_EQ(one.ask("resume"), "refused: viewer 2 has control");
  EXPECT_EQ(stop(watched, two), 0);
}

TEST(Console, LetsOnlyItsOwnPageIn) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "20"});
  const std::uint16_t port = watched.port;
  const std::string ours = "127.0.0.1:" + std::to_string(port);
  EXPECT_EQ(PageClient(port, {.origin = "http://evil.example"}).status(), 403);
  EXPECT_EQ(PageClient(port, {.origin = ""}).status(), 403);
  EXPECT_EQ(PageClient(port, {.host = "evil.example"}).status(), 403) << "a name that was made to point here";
  EXPECT_EQ(PageClient(port, {.path = "/other"}).status(), 404);
  EXPECT_EQ(PageClient(port, {.host = "localhost:9999"}).status(), 101) << "through a tunnel";
  EXPECT_NE(http_get(port, "/../../etc/passwd").find("404"), std::string::npos);
  EXPECT_NE(http_get(port, "/", "evil.example").find("403"), std::string::npos);
  EXPECT_EQ(http_get(port, "/").find("unsafe-inline"), std::string::npos);
  PageClient page(port);
  ASSERT_TRUE(page.until(is_picture));
  EXPECT_EQ(stop(watched, page), 0);
}

TEST(Console, ClosesAConnectionThatTalksNonsenseAndNoOther) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "50"});
  PageClient page(watched.port);
  ASSERT_TRUE(page.until(is_picture));
  const auto closes = [&](const std::string& bytes, bool binary) {
    PageClient bad(watched.port);
    EXPECT_EQ(bad.status(), 101);
    bad.say_raw(bytes, binary);
    for (int i = 0; i < 2000 && bad.open(); ++i) static_cast<void>(bad.next(5.0));
    return !bad.open();
  };
  EXPECT_TRUE(closes(std::string(100'000, 'x'), true)) << "more than 64 kB";
  EXPECT_TRUE(closes("pause", false)) << "text";
  EXPECT_TRUE(closes("\xff\xff\xff", true)) << "no message";
  EXPECT_TRUE(closes("", true)) << "a message that says nothing";
  EXPECT_TRUE(page.until(is_picture)) << "the others go on";
  EXPECT_EQ(stop(watched, page), 0);
}

TEST(Console, LeavesTheRunUntouchedWhateverIsThrownAtIt) {
  const TemporaryFolder folder;
  // Held until the console is up, so that all of it is watched.
  Watched watched(folder, {"--pace", "200", "--wait", "--set", "run.duration_s=600"});
  PageClient page(watched.port);
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_hello(); }));
  page.take_control();
  ASSERT_EQ(page.ask("resume"), "runs");
  {
    PageClient sleeper(watched.port, {.draws = false});  // takes nothing any more
    std::vector<int> sockets;
    for (int i = 0; i < 1000; ++i) {
      const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      if (fd < 0) break;
      sockaddr_in address{};
      address.sin_family = AF_INET;
      address.sin_port = htons(watched.port);
      address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      static_cast<void>(::connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address));
      static_cast<void>(::send(fd, "\x16\x03\x01 GET\0/", 11, MSG_NOSIGNAL));
      sockets.push_back(fd);
    }
    ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_picture() && m.picture().step() > 4000; }));
    for (const int fd : sockets) ::close(fd);
  }
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_status() && m.status().phase() == "ended"; }));
  ASSERT_EQ(leave(watched), 0) << watched.launcher.err();
  const Finished plain = lukou(
      {"run", "paper", "--mode", "in-process", "--set", "run.duration_s=600", "--quiet", "--out", folder / "plain"});
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(differing_files(folder / "r", folder / "plain"), std::vector<std::string>{});
}

TEST(Console, MayDieWithoutHarmToTheRun) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "60", "--wait", "--quiet", "--run-id", run, "--out", folder / "r"});
  while (lukou({"ctl", run, "status"}).out.find(": paused") == std::string::npos) pause_s(0.05);
  const std::string console = std::string(LUKOU_PROGRAM) + "-console";
  Program viewer({"--attach", run, "--port", "0"}, {}, console);
  const std::uint16_t port = port_said([&] { return viewer.out(); });
  PageClient page(port);
  const auto hello = page.next(20.0);
  ASSERT_TRUE(hello && hello->has_hello());
  EXPECT_FALSE(hello->hello().may_restart()) << "nobody is there who could";
  page.take_control();
  EXPECT_TRUE(page.ask("restart 5").starts_with("refused: "));
  viewer.signal(SIGKILL);
  EXPECT_EQ(viewer.wait(5.0), 128 + SIGKILL);
  EXPECT_EQ(lukou({"ctl", run, "resume"}).code, 0);
  EXPECT_EQ(launcher.wait(60.0), 0) << launcher.err();
}

TEST(Console, WithATokenAsksForItEverywhere) {
  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  Program launcher({"run", "paper", "--duration", "60", "--wait", "--quiet", "--run-id", run, "--out", folder / "r"});
  while (lukou({"ctl", run, "status"}).out.find(": paused") == std::string::npos) pause_s(0.05);
  const std::string program = std::string(LUKOU_PROGRAM) + "-console";
  EXPECT_EQ(Program({"--attach", run, "--port", "0", "--address", "0.0.0.0"}, {}, program).wait(10.0), 2);
  const std::string token = "0123456789abcdef";
  Program viewer({"--attach", run, "--port", "0", "--token", token}, {}, program);
  const std::uint16_t port = port_said([&] { return viewer.out(); });
  EXPECT_EQ(viewer.out().find(token), std::string::npos) << "it is nobody's business";
  EXPECT_NE(http_get(port, "/").find("401"), std::string::npos);
  EXPECT_NE(http_get(port, "/?token=0123456789abcdeX").find("401"), std::string::npos);
  const std::string page = http_get(port, "/?token=" + token);
  EXPECT_EQ(page.find("401"), std::string::npos);
  EXPECT_NE(page.find("Set-Cookie: lukou_token=" + token), std::string::npos);
  EXPECT_EQ(PageClient(port).status(), 401);
  EXPECT_EQ(PageClient(port, {.path = "/ws?token=wrong"}).status(), 401);
  EXPECT_EQ(PageClient(port, {.path = "/ws?token=" + token}).status(), 101);
  EXPECT_EQ(PageClient(port, {.cookie = "a=b; lukou_token=" + token}).status(), 101);
  EXPECT_EQ(lukou({"ctl", run, "stop"}).code, 0);
  EXPECT_EQ(launcher.wait(20.0), 0);
  viewer.signal(SIGTERM);
  EXPECT_EQ(viewer.wait(5.0), 0);
}

TEST(Console, StartsTheRunAnewWithAnotherSeed) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "100"});
  PageClient page(watched.port);
  page.take_control();
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_picture() && m.picture().step() > 100; }));
  EXPECT_EQ(page.ask("restart 77"), "restarts with seed 77");
  const auto hello = page.until([](const ToPage& m) { return m.has_hello(); }, 30.0);
  ASSERT_TRUE(hello);
  EXPECT_EQ(hello->hello().seed(), "77");
  const auto picture = page.until(is_picture);
  ASSERT_TRUE(picture);
  EXPECT_TRUE(picture->picture().has_program()) << "all is told anew";
  EXPECT_EQ(stop(watched, page), 0);
  EXPECT_NE(content(folder / "r/manifest.json").find("\"ended_by\": \"stopped\""), std::string::npos);
  EXPECT_NE(content(folder / "r-2/manifest.json").find("\"seed\": 77"), std::string::npos);
}

TEST(Console, SaysThatAnRsuIsLost) {
  const TemporaryFolder folder;
  Watched watched(folder, {"--pace", "50", "--set", "run.on_rsu_loss=CONTINUE"});
  PageClient page(watched.port);
  ASSERT_TRUE(page.until([](const ToPage& m) { return m.has_picture() && m.picture().step() > 50; }));
  const auto processes = processes_of(watched.run);
  ASSERT_TRUE(processes.contains("lukou-rsu"));
  kill(processes.at("lukou-rsu"), SIGKILL);
  EXPECT_TRUE(page.until([](const ToPage& m) { return m.has_event() && m.event().kind() == "lost"; }));
  const auto status = page.until([](const ToPage& m) {
    return m.has_status() && m.status().members_size() == 5 && !m.status().members(4).alive();
  });
  ASSERT_TRUE(status);
  EXPECT_EQ(status->status().members(4).role(), "rsu0");
  EXPECT_EQ(stop(watched, page), 0);
}

TEST(Console, ServesThePagesFiles) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "page/assets");
  std::ofstream(folder / "page/index.html") << "<!doctype html>";
  std::ofstream(folder / "page/assets/a.js") << "1;";
  setenv("LUKOU_CONSOLE_PAGE", (folder / "page").c_str(), 1);
  Watched watched(folder, {"--pace", "50"});
  unsetenv("LUKOU_CONSOLE_PAGE");
  const std::string index = http_get(watched.port, "/");
  EXPECT_TRUE(index.starts_with("HTTP/1.1 200 OK\r\n")) << index;
  EXPECT_NE(index.find("Content-Type: text/html"), std::string::npos);
  EXPECT_NE(http_get(watched.port, "/assets/a.js").find("text/javascript"), std::string::npos);
  const auto tag = index.find("ETag: ");
  ASSERT_NE(tag, std::string::npos);
  const std::string value = index.substr(tag + 6, index.find("\r\n", tag) - tag - 6);
  EXPECT_TRUE(http_get(watched.port, "/", "127.0.0.1", "If-None-Match: " + value + "\r\n").starts_with("HTTP/1.1 304"));
  PageClient page(watched.port);
  ASSERT_TRUE(page.until(is_picture));
  EXPECT_EQ(stop(watched, page), 0);
}

}  // namespace
}  // namespace lukou::test
