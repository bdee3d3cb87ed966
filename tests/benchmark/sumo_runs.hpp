#pragma once

#include <memory>
#include <string>

#include "tests/system/program.hpp"

namespace lukou::test {

/// SUMO on the same intersection with the same cars as a Lukou run; see sumo_peer.py and sumo_client.cpp.
class SumoPeer {
 public:
  /// What is missing on this host for the comparison, and how to get it; empty if nothing is.
  static std::string missing();

  /// Lets Lukou compute the cars of `duration_s` and writes SUMO's input. Ends this program with code 1 on failure.
  explicit SumoPeer(double duration_s);

  struct Guided {
    double steps_per_s = 0.0;
    double commands_per_step = 0.0;
    double arrived = 0.0;
  };
  /// SUMO and a client over TraCI, both on `core`.
  [[nodiscard]] Guided over_traci(int core) const;
  /// SUMO inside the client.
  [[nodiscard]] Guided in_process(int core) const;

  struct Alone {
    double steps_per_s = 0.0;
    double updates_per_s = 0.0;
  };
  /// SUMO without any client.
  [[nodiscard]] Alone alone(int core) const;

 private:
  [[nodiscard]] Guided guided(const std::string& client, int core) const;
  [[nodiscard]] std::vector<std::string> sumo_words() const;

  double duration_s_;
  TemporaryFolder folder_;
};

}  // namespace lukou::test
