#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/core/expected.hpp"
#include "common/core/step.hpp"
#include "common/results/manifest.hpp"
#include "common/results/table.hpp"

namespace lukou::results {

inline constexpr const char* kRadioTable = "radio.csv";

/// What the radio did in a second, for one direction and kind of frame; see docs/radio.md.
struct RadioRow {
  std::string_view direction;  ///< "uplink", "downlink" or "v2v"
  std::string_view kind;       ///< "bsm" or "rsc"
  std::uint64_t sent = 0;
  std::uint64_t heard = 0;
  std::uint64_t lost_random = 0;
  std::uint64_t lost_burst = 0;
  std::uint64_t lost_range = 0;
  std::uint64_t lost_path_loss = 0;
  std::uint64_t lost_collision = 0;
  std::uint64_t lost_half_duplex = 0;
  std::uint64_t lost_outage = 0;
  std::uint64_t duplicates = 0;
  double latency_mean_ms = 0.0;  ///< not a number: nothing was heard, as the next two
  double latency_p95_ms = 0.0;
  double latency_p99_ms = 0.0;
  double busy_ratio = 0.0;  ///< not a number: the load is not counted
};

/// The header line.
std::string radio_columns();

/// The table that a run writes whose radio is not the ideal one. The file comes with its first row.
class RadioTable {
 public:
  explicit RadioTable(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// A row for the second that ends with `step`. Steps never decrease.
  Expected<Done> add(Step step, const RadioRow& row);
  Expected<Done> flush();
  Expected<Done> sync();
  /// Name, hash and rows as flushed, for the manifest; empty while there is no file.
  [[nodiscard]] std::optional<FileEntry> entry() const;

 private:
  std::filesystem::path folder_;
  std::optional<TableWriter> table_;
};

}  // namespace lukou::results
