// What somebody who listens on the wire learns of a run: everything of an open one, nothing of a secured one.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <linux/if_packet.h>
#include <net/ethernet.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <thread>

#include "services/lukou/keys/key_folder.hpp"
#include "tests/system/program.hpp"

namespace lukou::test {
namespace {

/// A network of our own, so that nobody else's packets are heard. False without the right to.
bool enter_own_network() {
  if (unshare(CLONE_NEWNET) != 0) return false;
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  ifreq loopback{};
  std::strcpy(loopback.ifr_name, "lo");
  loopback.ifr_flags = IFF_UP | IFF_RUNNING;
  const bool up = ioctl(socket, SIOCSIFFLAGS, &loopback) == 0;
  ::close(socket);
  return up;
}

/// Every byte on the wire while it lives.
class Listener {
 public:
  Listener() : socket_(::socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP))) {
    const int room = 1 << 28;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUFFORCE, &room, sizeof room);
    thread_ = std::jthread([this] {
      std::string packet(1 << 16, '\0');
      while (!over_) {
        const auto size = recv(socket_, packet.data(), packet.size(), MSG_DONTWAIT);
        if (size > 0) heard_.append(packet.data(), static_cast<std::size_t>(size));
        if (size <= 0) usleep(200);
      }
    });
  }
  ~Listener() { stop(); }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] bool works() const { return socket_ >= 0; }
  const std::string& stop() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
    return heard_;
  }

 private:
  int socket_;
  std::atomic<bool> over_ = false;
  std::string heard_;
  std::jthread thread_;
};

/// A plain text and whether it crossed the wire.
struct Known {
  std::string what;
  std::string bytes;
};

/// What is known of the run beforehand.
std::vector<Known> known(const std::string& run) {
  std::vector<Known> all = {{"the run's id", run},
                            {"the scenario", "duration_s"},
                            {"a field of it", "traffic {"},
                            {"the RSU's algorithm", "arrive_on_green"},
                            {"a topic's name", "lukou/traffic"},
                            {"another", "lukou/control"},
                            {"a type's name", "lukou_bus"}};
  // The heads of five steps in Signal: at the beginning west and east have green (3), south and north red (1).
  std::string heads;
  for (int step = 0; step < 5; ++step) heads += "\3\3\3\1\1\1\3\3\3\1\1\1";
  all.push_back({"the lights", heads});
  return all;
}

std::string heard_of(const std::string& run, const std::filesystem::path& result, const std::string& keys) {
  Listener listener;
  std::vector<std::string> arguments = {"run",      "paper", "--duration", "60",  "--quiet",
                                        "--run-id", run,     "--out",      result};
  if (!keys.empty()) arguments.insert(arguments.end(), {"--secure", keys});
  EXPECT_EQ(lukou(arguments).code, 0);
  return listener.stop();
}

TEST(Wire, TellsNothingOfASecuredRunAndEverythingOfAnOpenOne) {
  if (!enter_own_network() || !Listener().works()) {
    GTEST_SKIP() << "NOT RUN: listening on the wire needs root (CAP_SYS_ADMIN, CAP_NET_RAW): " << std::strerror(errno);
  }
  const TemporaryFolder folder;
  const std::string keys = folder / "keys";
  ASSERT_TRUE(keys::make_keys(keys, 1, {}).ok());
  const std::string open = heard_of("wire-open-run", folder / "open", "");
  const std::string secured = heard_of("wire-secured-run", folder / "secured", keys);
  std::printf("%zu bytes of the open run, %zu of the secured one\n", open.size(), secured.size());
  EXPECT_GT(open.size(), 1'000'000U);
  EXPECT_GT(secured.size(), 1'000'000U);
  for (const Known& plain : known("wire-open-run")) {
    EXPECT_NE(open.find(plain.bytes), std::string::npos) << "the control: " << plain.what;
  }
  for (const Known& plain : known("wire-secured-run")) {
    EXPECT_EQ(secured.find(plain.bytes), std::string::npos) << plain.what;
  }
  EXPECT_EQ(differing_files(folder / "open", folder / "secured"), std::vector<std::string>{});
}

}  // namespace
}  // namespace lukou::test
