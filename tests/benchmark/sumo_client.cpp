// A roadside algorithm on SUMO, in C++: over TraCI (compiled with SUMO_OVER_TRACI) or inside this process by libsumo.
//   PROGRAM DURATION_S SUMO_WORDS...          prints one JSON object: steps_per_s, commands_per_step, arrived
// In every step it reads each equipped car ("e...") and commands those that would meet red, so that they reach the line
// when the next green has begun: the least that an RSU of Lukou does, written with the fastest calls of each interface
// (a context subscription over TraCI, plain getters inside the process).

#ifdef SUMO_OVER_TRACI
#include <libsumo/libtraci.h>
namespace peer = libtraci;
#else
#include <libsumo/libsumo.h>
namespace peer = libsumo;
#endif

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unordered_set>
#include <vector>

namespace {

constexpr double kStep_s = 0.1;
constexpr double kApproach_m = 500.0;
constexpr double kCruise_mps = 15.0;
constexpr double kSlowest_mps = 3.0;
constexpr double kCycle_s = 90.0;
constexpr double kGreen_s = 45.0;
constexpr double kAfterGreen_s = 2.0;

/// Seconds from `at_s` until its axis has green, 0 in green. West and east have the first half of the cycle.
double until_green_s(double at_s, bool west_east) {
  const double phase = std::fmod(at_s + (west_east ? 0.0 : kGreen_s), kCycle_s);
  return phase < kGreen_s ? 0.0 : kCycle_s - phase;
}

class Roadside {
 public:
  /// One car on an approach, `from_start_m` behind its entrance.
  void guide(const std::string& car, const std::string& edge, double from_start_m, double now_s) {
    const double distance_m = kApproach_m - from_start_m;
    const double free_s = distance_m / kCruise_mps;
    const bool west_east = edge[0] == 'W' || edge[0] == 'E';
    const double red_s = until_green_s(now_s + free_s, west_east);
    if (red_s == 0.0) {
      release(car);
      return;
    }
    const double wait_s = free_s + red_s + kAfterGreen_s;
    peer::Vehicle::setSpeed(car, std::clamp(distance_m / wait_s, kSlowest_mps, kCruise_mps));
    commanded_.insert(car);
    ++commands_;
  }
  /// The car drives by itself again.
  void release(const std::string& car) {
    if (commanded_.erase(car) == 0) return;
    peer::Vehicle::setSpeed(car, -1.0);
    ++commands_;
  }
  [[nodiscard]] double commands() const { return commands_; }

 private:
  std::unordered_set<std::string> commanded_;
  double commands_ = 0.0;
};

bool is_approach(const std::string& edge) { return edge.size() > 3 && edge.compare(edge.size() - 3, 3, "_in") == 0; }

#ifdef SUMO_OVER_TRACI
void subscribe() {
  constexpr double kEverything_m = 1000.0;
  peer::Junction::subscribeContext("J", libsumo::CMD_GET_VEHICLE_VARIABLE, kEverything_m,
                                   {libsumo::VAR_ROAD_ID, libsumo::VAR_LANEPOSITION, libsumo::VAR_SPEED});
}

void advise(Roadside& roadside, double now_s) {
  for (const auto& [car, values] : peer::Junction::getContextSubscriptionResults("J")) {
    if (car[0] != 'e') continue;
    const std::string edge = values.at(libsumo::VAR_ROAD_ID)->getString();
    if (!is_approach(edge)) {
      roadside.release(car);
      continue;
    }
    const auto& place = static_cast<const libsumo::TraCIDouble&>(*values.at(libsumo::VAR_LANEPOSITION));
    roadside.guide(car, edge, place.value, now_s);
  }
}
#else
void subscribe() {}

void advise(Roadside& roadside, double now_s) {
  for (const std::string& car : peer::Vehicle::getIDList()) {
    if (car[0] != 'e') continue;
    const std::string edge = peer::Vehicle::getRoadID(car);
    if (is_approach(edge))
      roadside.guide(car, edge, peer::Vehicle::getLanePosition(car), now_s);
    else
      roadside.release(car);
  }
}
#endif

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "%s DURATION_S SUMO_WORDS...\n", argv[0]);
    return 2;
  }
  const long steps = std::lround(std::strtod(argv[1], nullptr) / kStep_s);
  try {
    peer::Simulation::start(std::vector<std::string>(argv + 2, argv + argc));
    subscribe();
    Roadside roadside;
    long long arrived = 0;
    const auto start = std::chrono::steady_clock::now();
    for (long k = 1; k <= steps; ++k) {
      peer::Simulation::step();
      arrived += peer::Simulation::getArrivedNumber();
      advise(roadside, static_cast<double>(k) * kStep_s);
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    const auto counted = static_cast<double>(steps);
    peer::Simulation::close();
    std::printf("{\"steps_per_s\": %.1f, \"commands_per_step\": %.2f, \"arrived\": %lld}\n", counted / took.count(),
                roadside.commands() / counted, arrived);
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "SUMO: %s\n", problem.what());
    return 1;
  }
  return 0;
}
