#pragma once

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/directive.hpp"
#include "common/core/expected.hpp"
#include "common/run_log/channels.hpp"
#include "common/run_log/mcap_reader.hpp"
#include "common/run_log/run_log.hpp"

namespace lukou::run_log {

/// What a run log holds of one step.
struct LoggedStep {
  Step step = -1;
  std::vector<Directive> directives;  ///< in force from this step on
  std::optional<SignalBatch> signal;  ///< that came in force with it
  TrafficBatch traffic;               ///< its cars and frames are empty if the level leaves them out
  bool cars = false;                  ///< the cars of this step are there
};

/// Reads run.mcap from a result folder, step by step, from any step on. Without its end (the recorder was killed) it is
/// read up to its last whole chunk.
class RunLogReader {
 public:
  /// Errors: no log, none of ours, or broken facts.
  static Expected<RunLogReader> open(const std::filesystem::path& folder);
  RunLogReader(RunLogReader&& other) noexcept;
  RunLogReader& operator=(RunLogReader&& other) noexcept;
  ~RunLogReader();

  [[nodiscard]] const Facts& facts() const { return facts_; }
  [[nodiscard]] const McapReader& file() const { return file_; }
  /// The last step that is there; -1: none.
  [[nodiscard]] Step last_step() const;

  /// From now on only these channels are decoded; what the others hold is missing from the steps.
  void read_only(std::initializer_list<Channel> channels);
  /// The operator's changes, all of the run: only chunks that hold some are read.
  Expected<std::vector<Directive>> directives() const;

  /// The next step that next() gives. Steps before the first come as the first, those after the last as none.
  void seek(Step step);
  /// The next step, or null at the end; it may be moved or swapped from. Errors: a chunk that is broken, with its
  /// place.
  Expected<LoggedStep*> next();

 private:
  struct Decoder;
  RunLogReader(McapReader file, Facts facts);
  Expected<Done> take(const McapReader::Message& message);
  Expected<Done> load(std::size_t chunk);

  McapReader file_;
  Facts facts_;
  std::unique_ptr<Decoder> decoder_;
  std::size_t next_chunk_ = 0;
  std::string chunk_;
  std::string_view rest_;                       ///< of the chunk
  std::optional<McapReader::Message> message_;  ///< taken off `rest_`, of a later step than the last one given
  Step next_step_ = 0;                          ///< behind the last one given
  Step from_ = 0;                               ///< steps before are passed over
  std::uint32_t channels_ = ~0U;                ///< that are decoded: bit n = channel n
  LoggedStep step_;
};

}  // namespace lukou::run_log
