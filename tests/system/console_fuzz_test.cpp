// Thousands of connections that break every rule of HTTP, WebSocket and the page's contract, against a real console of
// a real run. Every draw hangs on one seed, which is printed: LUKOU_FUZZ_SEED repeats it, LUKOU_FUZZ_SECONDS lasts
// longer.

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "common/core/keyed_random.hpp"
#include "console.pb.h"
#include "tests/system/page_client.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint32_t connection) : seed_(seed), connection_(connection) {}
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform01({seed_, Purpose::kTest, connection_, drawn_++}) *
                                      static_cast<double>(n));
  }
  bool one_in(std::uint64_t n) { return below(n) == 0; }
  std::string bytes(std::size_t n) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += static_cast<char>(below(256));
    return text;
  }

 private:
  std::uint64_t seed_;
  std::uint32_t connection_;
  std::uint64_t drawn_ = 0;
};

/// A connection that says what it likes.
class Stranger {
 public:
  explicit Stranger(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    static_cast<void>(::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address));
    const int on = 1;
    static_cast<void>(::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on));
    static_cast<void>(ready(POLLOUT, 200));
  }
  ~Stranger() { ::close(fd_); }
  Stranger(const Stranger&) = delete;
  Stranger& operator=(const Stranger&) = delete;

  /// In pieces of up to `piece` bytes; as much as is taken.
  void say(const std::string& bytes, std::size_t piece) {
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t length = std::min(piece, bytes.size() - at);
      const ssize_t sent = ::send(fd_, bytes.data() + at, length, MSG_NOSIGNAL);
      if (sent > 0) {
        at += static_cast<std::size_t>(sent);
      } else if (!ready(POLLOUT, 20)) {
        return;
      }
    }
  }
  /// What has come; waits a little for the first of it.
  std::string hear(int wait_ms) {
    std::string heard;
    char buffer[4096];
    while (ready(POLLIN, wait_ms)) {
      const ssize_t got = ::recv(fd_, buffer, sizeof buffer, 0);
      if (got <= 0) break;
      heard.append(buffer, static_cast<std::size_t>(got));
      wait_ms = 0;
      if (heard.size() > 100'000) break;
    }
    return heard;
  }
  /// Ends with a reset, not with a good-bye.
  void break_off() const {
    const linger hard{1, 0};
    static_cast<void>(::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &hard, sizeof hard));
  }

 private:
  [[nodiscard]] bool ready(short what, int limit_ms) const {
    pollfd waits{fd_, what, 0};
    return ::poll(&waits, 1, limit_ms) > 0 && (waits.revents & (POLLERR | POLLHUP | POLLNVAL)) == 0;
  }
  int fd_;
};

std::string upgrade(std::uint16_t port) {
  const std::string host = "127.0.0.1:" + std::to_string(port);
  return "GET /ws HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
         "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
}

/// A handshake with something wrong in it, mostly.
std::string strange_opening(Draws& draw, std::uint16_t port) {
  std::string text = upgrade(port);
  switch (draw.below(6)) {
    case 0:
      return draw.bytes(draw.below(400));
    case 1:
      return text.substr(0, draw.below(text.size()));
    case 2:
      return "GET /" + std::string(draw.below(20'000), 'a') + " HTTP/1.1\r\n\r\n";
    case 3:
      return "POST /ws HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 18446744073709551615\r\n\r\n" + draw.bytes(50);
    case 4:
      return text + draw.bytes(draw.below(300));  // frames before the answer
    default:
      for (std::uint64_t n = 1 + draw.below(8); n > 0; --n)
        text[draw.below(text.size())] = static_cast<char>(draw.below(256));
      return text;
  }
}

/// A frame: header as drawn, payload masked if the header says so. `length`: what the header claims.
std::string frame(Draws& draw, unsigned first, std::string payload, std::uint64_t length, bool masked) {
  std::string bytes(1, static_cast<char>(first));
  const unsigned mask_bit = masked ? 0x80 : 0;
  int wide = length < 126 ? 0 : length < 65'536 ? 2 : 8;
  if (draw.one_in(20)) wide = draw.one_in(2) ? 2 : 8;  // longer than it need be: not allowed
  bytes += static_cast<char>(mask_bit | (wide == 0 ? static_cast<unsigned>(length & 127) : wide == 2 ? 126 : 127));
  for (int i = wide - 1; i >= 0; --i) bytes += static_cast<char>(length >> (8 * i));
  if (!masked) return bytes + payload;
  const std::string key = draw.bytes(4);
  for (std::size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(payload[i] ^ key[i % 4]);
  return bytes + key + payload;
}

/// A message of the page, or nearly. None of them could change the run: that is what is tested.
std::string message(Draws& draw) {
  console::FromPage said;
  switch (draw.below(6)) {
    case 0:
      said.mutable_drawn()->set_step(static_cast<std::int64_t>(draw.below(1'000'000)));
      break;
    case 1:
      said.mutable_take_control()->set_from_another(draw.one_in(2));
      break;
    case 2:
      said.mutable_release_control();
      break;
    case 3:
      said.mutable_request()->set_text("set " + std::string(draw.below(300), 'x') + "=1");
      break;
    case 4:
      said.mutable_request()->set_text(draw.one_in(2) ? "resume" : "vanish");
      break;
    default:
      return draw.bytes(draw.below(120));
  }
  std::string bytes = said.SerializeAsString();
  if (draw.one_in(3) && !bytes.empty()) bytes[draw.below(bytes.size())] = static_cast<char>(draw.below(256));
  // One flipped byte must not make a word that changes the run.
  for (const char* word : {"stop", "pause", "pace", "step", "restart"}) {
    if (bytes.find(word) != std::string::npos) return {};
  }
  return bytes;
}

std::string strange_frame(Draws& draw) {
  const bool masked = !draw.one_in(8);
  switch (draw.below(9)) {
    case 0: {  // whatever
      const std::string payload = draw.bytes(draw.below(200));
      return frame(draw, static_cast<unsigned>(draw.below(256)), payload, payload.size(), masked);
    }
    case 1:  // a length that never comes
      return frame(draw, 0x82, draw.bytes(20), std::uint64_t{1} << draw.below(64), masked);
    case 2: {  // more than a message may have
      const std::string payload = draw.bytes(1000);
      std::string large;
      while (large.size() < 70'000) large += payload;
      return frame(draw, 0x82, large, large.size(), masked);
    }
    case 3: {  // a message in fragments, control frames between them, the end missing sometimes
      std::string bytes;
      const std::string whole = message(draw);
      std::size_t at = 0;
      unsigned opcode = 0x02;
      for (int i = 0; i < 8 && at < whole.size(); ++i) {
        const std::size_t length = draw.below(whole.size() - at + 1);
        bytes += frame(draw, opcode, whole.substr(at, length), length, masked);
        at += length;
        opcode = 0x00;
        if (draw.one_in(3)) bytes += frame(draw, 0x89, "ping", 4, true);
      }
      if (!draw.one_in(4)) bytes += frame(draw, opcode | 0x80, whole.substr(at), whole.size() - at, masked);
      return bytes;
    }
    case 4: {  // pings, too long ones among them, and answers to nothing
      const std::size_t length = draw.below(200);
      return frame(draw, draw.one_in(2) ? 0x89 : 0x8a, draw.bytes(length), length, masked);
    }
    case 5: {  // good-byes with codes that may not be
      const std::string payload = draw.bytes(draw.below(8));
      return frame(draw, 0x88, payload, payload.size(), masked);
    }
    case 6:  // text that is none
      return frame(draw, 0x81, "\xc3\x28 pause", 8, masked);
    default: {
      const std::string payload = message(draw);
      return frame(draw, 0x82, payload, payload.size(), masked);
    }
  }
}

/// Returns whether it got as far as a socket.
bool visit(Draws& draw, std::uint16_t port) {
  Stranger stranger(port);
  bool opened = false;
  const std::size_t piece = draw.one_in(3) ? 1 + draw.below(7) : 1 + draw.below(3000);
  if (draw.one_in(5)) {
    stranger.say(strange_opening(draw, port), piece);
  } else {
    stranger.say(upgrade(port), piece);
    opened = stranger.hear(200).find("101") != std::string::npos;
    if (opened) {
      for (std::uint64_t n = 1 + draw.below(20); n > 0; --n) {
        stranger.say(strange_frame(draw), piece);
        if (draw.one_in(4)) static_cast<void>(stranger.hear(1));
      }
    }
  }
  if (!draw.one_in(3)) static_cast<void>(stranger.hear(2));
  if (draw.one_in(2)) stranger.break_off();
  return opened;
}

/// The console that a launcher has started; 0: there is none.
pid_t console_of(pid_t launcher) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    pid_t pid = 0;
    pid_t parent = 0;
    std::string name;
    char state = 0;
    if (stat >> pid >> name >> state >> parent && parent == launcher && name == "(lukou-console)") return pid;
  }
  return 0;
}

double resident_mb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == "VmRSS:" && status >> kilobytes) return kilobytes / 1000.0;
  }
  return -1.0;
}

TEST(ConsoleUnderFuzz, StaysAliveAndLeavesTheRunAlone) {
  const char* seconds_said = std::getenv("LUKOU_FUZZ_SECONDS");
  const double seconds = seconds_said == nullptr ? 5.0 : std::atof(seconds_said);
  const char* seed_said = std::getenv("LUKOU_FUZZ_SEED");
  const std::uint64_t seed = seed_said != nullptr ? std::strtoull(seed_said, nullptr, 10)
                             : seconds_said == nullptr
                                 ? 1
                                 : static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
  std::printf("LUKOU_FUZZ_SEED=%llu, %.0f s\n", static_cast<unsigned long long>(seed), seconds);

  const TemporaryFolder folder;
  const std::string run = fresh_run_id();
  // Long enough at this pace for the whole attack.
  const std::string pace = std::to_string(static_cast<int>(600.0 / (seconds + 10.0)));
  Program launcher({"run", "paper", "--console=8300", "--duration", "600", "--pace", pace, "--quiet", "--run-id", run,
                    "--out", folder / "r"});
  std::uint16_t port = 0;
  for (int i = 0; i < 400 && port == 0; ++i) {
    const std::string said = launcher.err();
    const auto at = said.find("http://127.0.0.1:");
    if (at != std::string::npos && said.find('/', at + 17) != std::string::npos)
      port = static_cast<std::uint16_t>(std::atoi(said.c_str() + at + 17));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ASSERT_NE(port, 0) << launcher.err();
  PageClient page(port);
  const auto is_picture = [](const console::ToPage& m) { return m.has_picture(); };
  ASSERT_TRUE(page.until(is_picture));
  const pid_t console = console_of(launcher.pid());
  ASSERT_GT(console, 0);

  std::uint32_t connections = 0;
  std::uint32_t opened = 0;
  double first_mb = 0.0;
  double most_mb = 0.0;
  for (const auto begin = Clock::now(); seconds_since(begin) < seconds; ++connections) {
    Draws draw(seed, connections);
    opened += visit(draw, port) ? 1U : 0U;
    if (connections % 50 != 49) continue;
    ASSERT_TRUE(page.until(is_picture)) << "the page is served on; after connection " << connections;
    const double now_mb = resident_mb(console);
    ASSERT_GT(now_mb, 0.0) << "the console lives; after connection " << connections;
    if (first_mb == 0.0) first_mb = now_mb;
    most_mb = std::max(most_mb, now_mb);
  }
  std::printf("%u connections, %u sockets, console %.1f MB after the first 50, at most %.1f MB\n", connections, opened,
              first_mb, most_mb);
  EXPECT_GT(opened, 100U) << "most got as far as a socket";
  // 64 connections hold at most 64 kB of a message and 4 MB of words each; in truth hardly anything stays.
  EXPECT_LT(most_mb, first_mb + 30.0);
  EXPECT_EQ(console_of(launcher.pid()), console) << "still the first one";

  // Whoever had control of the strangers is gone, and the rest of the run is quick.
  page.take_control(true);
  EXPECT_EQ(page.ask("pace max"), "pace max");
  ASSERT_TRUE(
      page.until([](const console::ToPage& m) { return m.has_status() && m.status().phase() == "ended"; }, 60.0));
  for (int i = 0; i < 200 && launcher.err().find("console: shows the end") == std::string::npos; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  launcher.signal(SIGINT);
  ASSERT_EQ(launcher.wait(20.0), 0) << launcher.err();
  const Finished plain =
      lukou({"run", "paper", "--mode", "in-process", "--duration", "600", "--quiet", "--out", folder / "plain"});
  ASSERT_EQ(plain.code, 0) << plain.err;
  EXPECT_EQ(differing_files(folder / "r", folder / "plain"), std::vector<std::string>{});
}

}  // namespace
}  // namespace lukou::test
