#include "common/results/radio_table.hpp"

#include <utility>

namespace lukou::results {

std::string radio_columns() {
  return "step,time_s,direction,kind,sent,heard,lost_random,lost_burst,lost_range,lost_path_loss,lost_collision,"
         "lost_half_duplex,lost_outage,duplicates,latency_mean_ms,latency_p95_ms,latency_p99_ms,busy_ratio";
}

Expected<Done> RadioTable::add(Step step, const RadioRow& row) {
  if (!table_) {
    auto created = TableWriter::create(folder_ / kRadioTable, radio_columns());
    if (!created) return created.error();
    table_.emplace(std::move(created).value());
  }
  table_->whole(step);
  table_->tenths(step);
  table_->name(row.direction);
  table_->name(row.kind);
  for (const std::uint64_t count :
       {row.sent, row.heard, row.lost_random, row.lost_burst, row.lost_range, row.lost_path_loss, row.lost_collision,
        row.lost_half_duplex, row.lost_outage, row.duplicates}) {
    table_->count(count);
  }
  for (const double value : {row.latency_mean_ms, row.latency_p95_ms, row.latency_p99_ms, row.busy_ratio}) {
    table_->real(value);
  }
  table_->end_row();
  return Done{};
}

Expected<Done> RadioTable::flush() { return table_ ? table_->flush() : Expected<Done>(Done{}); }

Expected<Done> RadioTable::sync() { return table_ ? table_->sync() : Expected<Done>(Done{}); }

std::optional<FileEntry> RadioTable::entry() const {
  if (!table_) return std::nullopt;
  return FileEntry{kRadioTable, table_->sha256(), table_->rows_flushed()};
}

}  // namespace lukou::results
