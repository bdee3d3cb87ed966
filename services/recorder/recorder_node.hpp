#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/batches.hpp"
#include "common/core/expected.hpp"
#include "common/lockstep/messages.hpp"
#include "common/measures/advice_ledger.hpp"
#include "common/measures/request_ledger.hpp"
#include "common/measures/safety_measures.hpp"
#include "common/results/event_tables.hpp"
#include "common/results/radio_table.hpp"
#include "common/results/tables.hpp"
#include "common/run_log/run_log_writer.hpp"
#include "common/scenario/directive_log.hpp"
#include "services/recorder/measure_config.hpp"
#include "services/recorder/run_picture.hpp"

namespace lukou {

/// The record of a run: commits the truth step by step, keeps the tables, and closes with summary and manifest.
class RecorderNode {
 public:
  /// `folder` exists and holds scenario.textproto.
  static Expected<RecorderNode> create(const scenario::Resolved& scenario, std::filesystem::path folder);

  /// Commits the next step; the batch's storage is swapped for a used one. `new_signal` is the controller's newest
  /// batch if one came. Errors: the disk, or a gap in the promise.
  Expected<Done> step(TrafficBatch& traffic, const SignalBatch* new_signal);
  /// Directives that took effect with the step that comes next.
  void add(const std::vector<Directive>& directives);
  /// Set with the step that showed it: the run ends there.
  [[nodiscard]] const std::optional<std::string>& anomaly() const { return anomaly_; }

  /// Writes rows that are still in memory.
  Expected<Done> flush();
  [[nodiscard]] Step complete_to() const { return step_; }
  /// What observers see.
  void fill(View& view) const { picture_.fill(view); }

  /// Writes everything down and the manifest last. `ended_by` as results::Manifest says; `culprit`: for people.
  Expected<Done> close(const std::string& ended_by, const std::string& culprit);

 private:
  RecorderNode(const RecorderConfig& config, std::string scenario_hash, std::filesystem::path folder,
               results::RunTables tables, results::EventTables events);
  void add_rows();
  void add_events(const TrafficBatch& traffic);
  /// Rows of radio.csv for the second that ends now.
  Expected<Done> add_radio_rows(const std::vector<ReceptionFigures>& second);
  void note_hearing(const TrafficBatch& traffic);
  /// Measured computing times, and the deadlines that they missed.
  void note_computing(const TrafficBatch& traffic);
  void look_for_anomaly(const TrafficBatch& traffic);

  RecorderConfig config_;
  std::string scenario_hash_;
  std::filesystem::path folder_;
  results::RunTables tables_;
  results::EventTables events_;
  results::RadioTable radio_;
  RunPicture picture_;
  std::optional<SafetyMeasures> safety_;  ///< empty: not recorded
  AdviceLedger ledger_;
  RequestLedger requests_;
  Step radio_rows_to_ = 0;  ///< step of the newest rows of radio.csv
  scenario::DirectiveLog log_;
  std::optional<run_log::RunLogWriter> run_log_;  ///< empty: none is asked for
  std::vector<Directive> due_;                    ///< directives of the step that comes next
  std::uint64_t deadline_misses_ = 0;
  std::vector<std::uint32_t> heard_epoch_;  ///< per RSU, as the engine said last
  std::optional<std::string> anomaly_;
  Step step_ = -1;
};

}  // namespace lukou
