#include <ifaddrs.h>
#include <net/if.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "common/bus/participant.hpp"
#include "common/core/version.hpp"
#include "common/process/environment.hpp"
#include "common/scenario/scenario.hpp"
#include "services/lukou/keys/key_folder.hpp"
#include "services/lukou/launch/domain_claim.hpp"
#include "services/lukou/launch/reach.hpp"
#include "services/lukou/verbs.hpp"

namespace lukou {
namespace {

constexpr double kTalkLimit_s = 5.0;

bool say(bool good, const std::string& what) {
  std::printf("%-4s %s\n", good ? "ok" : "BAD", what.c_str());
  return good;
}

bool loopback_is_up() {
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return false;
  bool up = false;
  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next)
    up = up || ((entry->ifa_flags & IFF_LOOPBACK) != 0 && (entry->ifa_flags & IFF_UP) != 0);
  freeifaddrs(list);
  return up;
}

RunState greeting(const bus::Address& address) { return {.run = address.run}; }

/// In a process of its own: says one thing as the clock, and stays until it is ended.
[[noreturn]] void speak(bus::Address address, const launch::Reach& reach) {
  address.identity = reach.identity(std::string(kClockRole));
  auto speaker = bus::Participant::join(address, kClockRole, process::new_incarnation());
  if (!speaker) _exit(process::kExitInternal);
  bus::Writer<RunState> writer(*speaker.value());
  writer.write(greeting(address));
  process::sleep_s(kTalkLimit_s);
  _exit(process::kExitDone);
}

/// Two processes, one message: discovery, matching and delivery work in this domain. Returns how long it took [s].
Expected<double> talk(int domain, const launch::Reach& reach) {
  const bus::Address address{.domain = domain,
                             .run = "doctor-" + std::to_string(getpid()),
                             .identity = reach.identity(std::string(kObserverRole))};
  const double begin_s = process::wall_s();
  const pid_t pid = fork();
  if (pid == 0) speak(address, reach);
  bool heard = false;
  auto listener = bus::Participant::join(address, kObserverRole, process::new_incarnation());
  if (listener) {
    bus::Reader<RunState> reader(*listener.value());
    while (!heard && process::wall_s() - begin_s < kTalkLimit_s) {
      listener.value()->wait(0.01);
      reader.take([&](RunState& state, const bus::SampleInfo&) { heard = heard || state.run == address.run; });
    }
  }
  const double took_s = process::wall_s() - begin_s;
  kill(pid, SIGKILL);
  waitpid(pid, nullptr, 0);
  if (!listener) return listener.error();
  if (!heard) return Error{"DDS domain " + std::to_string(domain), "two processes do not hear each other within 5 s"};
  return took_s;
}

/// What else a secured run needs. Returns false if it is not there.
bool check_keys(const launch::Reach& reach, int domain) {
  const auto warnings = keys::check(reach.keys, 0);
  if (!warnings) return say(false, warnings.error().text());
  for (const std::string& warning : warnings.value()) say(true, "but " + warning);
  const auto talked = talk(domain, reach);
  char text[128];
  std::snprintf(text, sizeof text,
                "DDS Security talks with the keys of this folder (authenticated and delivered in %.0f ms)",
                talked ? talked.value() * 1e3 : 0.0);
  return say(talked.ok(), talked ? text : talked.error().text());
}

int doctor(const std::string& keys) {
  bool good = say(true, "lukou " + std::string(version()) + ", " + bus::library_version());
  good &= say(loopback_is_up(), "the loopback interface is up");
  const char* uri = std::getenv("CYCLONEDDS_URI");
  say(true, uri == nullptr ? "CYCLONEDDS_URI is not set: runs use loopback only"
                           : std::string("CYCLONEDDS_URI is set and wins: ") + uri);
  const auto claim = launch::DomainClaim::lowest_free({.run = "doctor"});
  const std::size_t free = launch::free_domains().size();
  good &= say(claim.ok(), std::to_string(free + (claim ? 1 : 0)) + " of the domain ids 0 to 100 are free" +
                              (claim ? ", the lowest is " + std::to_string(claim.value().domain()) : ""));
  if (claim) {
    const auto talked = talk(claim.value().domain(), {});
    char text[128];
    std::snprintf(text, sizeof text,
                  "DDS talks in domain %d between two processes (started, discovered and delivered in %.0f ms)",
                  claim.value().domain(), talked ? talked.value() * 1e3 : 0.0);
    good &= say(talked.ok(), talked ? text : talked.error().text());
    if (!keys.empty()) good &= check_keys({.keys = std::filesystem::absolute(keys)}, claim.value().domain());
  }
  const auto names = scenario::shipped_names();
  std::string list;
  for (const std::string& name : names) list += " " + name;
  good &= say(!names.empty(), names.empty() ? "no shipped scenarios found" : "shipped scenarios:" + list);
  say(true, std::to_string(sysconf(_SC_NPROCESSORS_ONLN)) + " processors");
  return good ? process::kExitDone : process::kExitInternal;
}

}  // namespace

Action add_doctor(CLI::App& app) {
  CLI::App* verb = app.add_subcommand("doctor", "can runs work here: loopback, DDS, domain ids, versions");
  auto keys = std::make_shared<std::string>();
  verb->add_option("--secure", *keys, "folder of `lukou keys init`: secured runs, too")->type_name("DIR");
  return [keys] { return doctor(*keys); };
}

}  // namespace lukou
