#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/expected.hpp"
#include "common/lockstep/messages.hpp"

namespace lukou::bus {

/// Where a run's processes meet.
struct Address {
  int domain = 0;                  ///< DDS domain id, 0..100
  std::string run;                 ///< its id
  std::vector<std::string> peers;  ///< addresses or names of the run's hosts; none: this host's loopback alone
  std::filesystem::path identity;  ///< folder of this process's identity in a secured run; empty: an unsecured run

  /// Processes of other tags neither see nor hear this one.
  [[nodiscard]] std::string tag() const;
};

/// Name and version of the DDS implementation that this program was built with.
std::string library_version();

/// What came with a sample.
struct SampleInfo {
  Incarnation producer = 0;
  std::uint32_t epoch = 1;
  bool alive = true;  ///< false: no sample, but the news that this producer is gone (its own good-bye included)
};

/// One process on the bus: owns its DDS entities and the one place to wait at. Not thread-safe: one thread per
/// participant waits, takes and writes.
class Participant {
 public:
  /// `role`: whose identity this must be in a secured run.
  /// Errors: the identity is not fit or of another role, no way to the peers, DDS cannot start in this domain (with
  /// Cyclone's reason).
  static Expected<std::unique_ptr<Participant>> join(const Address& address, std::string_view role, Incarnation self);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  [[nodiscard]] Incarnation self() const;
  /// Returns when some reader has news, or after `timeout_s` of wall time.
  void wait(double timeout_s);
  /// What a blocked write asks every 100 ms; it gives up when the answer is false.
  void keep_writing_while(std::function<bool()> question);

  struct Entities;
  [[nodiscard]] Entities& entities() { return *entities_; }

 private:
  explicit Participant(std::unique_ptr<Entities> entities);
  std::unique_ptr<Entities> entities_;
};

/// Typed end of a topic. Batch types: AirBatch, RoadsideBatch, RequestBatch, SignalBatch, TrafficBatch; streams:
/// Control, Up, RunState, View. Lockstep topics are reliable with a writer history of 512 steps; readers keep all.
template <class Batch>
class Writer {
 public:
  explicit Writer(Participant& participant);
  /// `epoch`: of the writing process, for lockstep topics. Returns false only if the write was given up.
  bool write(const Batch& batch, std::uint32_t epoch = 1);
  /// Waits until everybody who is matched has received everything, at most `limit_s`: before a process ends, since what
  /// is still under way is lost with it.
  void finish(double limit_s) const;
  /// Incarnations of the processes whose readers this writer reaches.
  [[nodiscard]] std::set<Incarnation> matched() const;

 private:
  Participant& participant_;
  std::int32_t entity_ = 0;
};

template <class Batch>
class Reader {
 public:
  explicit Reader(Participant& participant);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  /// Hands over everything that has come in, in order; the batch may be moved or swapped from.
  void take(const std::function<void(Batch&, const SampleInfo&)>& receive);
  [[nodiscard]] std::set<Incarnation> matched() const;

 private:
  struct Landing;

  Participant& participant_;
  std::int32_t entity_ = 0;
  std::unique_ptr<Landing> landing_;
  Batch scratch_{};
};

}  // namespace lukou::bus
