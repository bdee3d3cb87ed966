#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/bus/senders.hpp"
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
  Incarnation producer = 0;  ///< of the process whose writer it was: no sample can be sent in another's name
  std::uint32_t epoch = 1;
  bool alive = true;  ///< false: no sample, but the news that this producer is gone (its own good-bye included)
};

/// Whether a reader hands over what a process says on its topic.
enum class Belief : std::uint8_t {
  kYes,
  kIgnored,  ///< dropped without a word: one that was believed before, or will be
  kForeign,  ///< dropped and counted
};

/// Samples on a topic that nobody of the run has sent.
struct Foreign {
  std::uint64_t samples = 0;
  std::string first;  ///< "a sample of step 7 from 00c0ffee00c0ffee, which is no member of this run"
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
  /// Returns when some reader has had news since the last call, or after `timeout_s`, whatever is done to the host's
  /// wall clock meanwhile. Before it, take what every reader has.
  void wait(double timeout_s);
  /// By topic: what has been dropped.
  [[nodiscard]] const std::map<std::string, Foreign>& foreign() const;
  [[nodiscard]] std::uint64_t foreign_samples() const;
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

///
/// A reader hands over only what has the shape that the contract asks for (flaws.hpp) and comes from whom it believes.
template <class Batch>
class Reader {
 public:
  explicit Reader(Participant& participant);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  /// "lukou/air" and so on.
  static const char* topic();
  /// Whom it believes; without this, everybody who says with USER_DATA who it is.
  void believe(std::function<Belief(Incarnation)> question) { believes_ = std::move(question); }
  /// Called when somebody whom it believes sends what is broken, with what is wrong; that is not handed over.
  void on_flaw(std::function<void(Incarnation, const std::string&)> action) { flawed_ = std::move(action); }

  /// Hands over what has come in, in order; the batch may be moved or swapped from. A flood does not keep it for ever:
  /// what is more than 4096 samples waits for the next call.
  void take(const std::function<void(Batch&, const SampleInfo&)>& receive);
  /// Incarnations of the processes whose writers reach this reader.
  [[nodiscard]] std::set<Incarnation> matched();

 private:
  struct Landing;

  Incarnation sender_of(WriterHandle writer);
  [[nodiscard]] Belief belief_in(Incarnation writer, Incarnation producer) const;

  Participant& participant_;
  std::int32_t entity_ = 0;
  std::unique_ptr<Landing> landing_;
  Senders senders_;
  std::function<Belief(Incarnation)> believes_;
  std::function<void(Incarnation, const std::string&)> flawed_;
  Batch scratch_{};
};

/// An incarnation for people: sixteen hexadecimal digits.
std::string text_of(Incarnation incarnation);

}  // namespace lukou::bus
