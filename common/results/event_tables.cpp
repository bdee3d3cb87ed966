#include "common/results/event_tables.hpp"

#include <utility>

namespace lukou::results {
namespace {

void whole_or_empty(TableWriter& table, const std::optional<Step>& step) { step ? table.whole(*step) : table.name(""); }

}  // namespace

std::string stops_columns() {
  return "step,time_s,vehicle,lane,equipped,began_step,began_s,distance_m,stood_s,cause,guidance,missed";
}
std::string guidance_columns() {
  return "step,time_s,issued_step,issued_s,rsu,sequence,vehicle,lane,commanded_mps2,fate,age_s,last_step,kind,"
         "commanded_speed_mps";
}
std::string requests_columns() { return "step,time_s,rsu,lanes,outcome,rule"; }
std::string safety_columns() {
  return "step,time_s,kind,vehicle,lane,equipped,other,other_lane,other_equipped,guided,began_step,began_s,last_step,"
         "worst_step,worst_s,value,distance_m,speed_mps";
}

std::string_view name_of(RequestOutcome outcome) {
  switch (outcome) {
    case RequestOutcome::kAccepted:
      return "accepted";
    case RequestOutcome::kMinGreen:
      return "deferred";
    case RequestOutcome::kMaxWait:
      return "overruled";
    case RequestOutcome::kConflict:
    case RequestOutcome::kMalformed:
    case RequestOutcome::kOtherRsu:
      return "refused";
    case RequestOutcome::kEnded:
      return "ended";
  }
  return "";
}

std::string_view rule_of(RequestOutcome outcome) {
  switch (outcome) {
    case RequestOutcome::kMinGreen:
      return "min_green";
    case RequestOutcome::kMaxWait:
      return "max_wait";
    case RequestOutcome::kConflict:
      return "conflict";
    case RequestOutcome::kMalformed:
      return "malformed";
    case RequestOutcome::kOtherRsu:
      return "other_rsu";
    case RequestOutcome::kAccepted:
    case RequestOutcome::kEnded:
      break;
  }
  return "";
}

Expected<EventTables> EventTables::create(const std::filesystem::path& folder, const Asked& asked) {
  EventTables tables;
  if (asked.stops) {
    auto stops = TableWriter::create(folder / kStopsTable, stops_columns());
    if (!stops) return stops.error();
    tables.stops_.emplace(std::move(stops).value());
  }
  if (asked.guidance) {
    auto guidance = TableWriter::create(folder / kGuidanceTable, guidance_columns());
    if (!guidance) return guidance.error();
    tables.guidance_.emplace(std::move(guidance).value());
  }
  if (asked.requests) {
    auto requests = TableWriter::create(folder / kRequestsTable, requests_columns());
    if (!requests) return requests.error();
    tables.requests_.emplace(std::move(requests).value());
  }
  if (asked.safety) {
    auto safety = TableWriter::create(folder / kSafetyTable, safety_columns());
    if (!safety) return safety.error();
    tables.safety_.emplace(std::move(safety).value());
  }
  return tables;
}

void EventTables::add(const FinishedStop& row) {
  if (!stops_) return;
  stops_->whole(row.ended);
  stops_->tenths(row.ended);
  stops_->count(row.vehicle);
  stops_->name(name(row.lane));
  stops_->whole(row.equipped ? 1 : 0);
  stops_->whole(row.began);
  stops_->tenths(row.began);
  stops_->real(row.distance_m);
  stops_->tenths(row.standing_steps);
  stops_->name(row.cause);
  stops_->name(row.guidance);
  stops_->name(row.missed);
  stops_->end_row();
}

void EventTables::add(const SettledAdvice& row) {
  if (!guidance_) return;
  TableWriter& table = *guidance_;
  table.whole(row.settled);
  table.tenths(row.settled);
  whole_or_empty(table, row.issued);
  row.issued ? table.tenths(*row.issued) : table.name("");
  table.count(row.rsu);
  table.count(row.sequence);
  row.vehicle ? table.count(*row.vehicle) : table.name("");
  table.name(row.lane ? name(*row.lane) : std::string_view());
  table.real(row.commanded_mps2);
  table.name(row.fate);
  // Advice that is used in step k acts from t(k-1) on.
  row.first_used&& row.issued ? table.tenths(*row.first_used - 1 - *row.issued) : table.name("");
  whole_or_empty(table, row.last_used);
  table.name(row.kind);
  row.speed_mps ? table.real(*row.speed_mps) : table.name("");
  table.end_row();
}

void EventTables::add(const RequestRow& row) {
  if (!requests_) return;
  requests_->whole(row.step);
  requests_->tenths(row.step);
  requests_->count(row.rsu);
  std::string lanes;
  for (const Lane lane : row.lanes) lanes += (lanes.empty() ? "" : " ") + std::string(name(lane));
  requests_->name(lanes);
  requests_->name(name_of(row.outcome));
  requests_->name(rule_of(row.outcome));
  requests_->end_row();
}

void EventTables::add(const MissedDeadline& row) {
  if (!guidance_) return;
  TableWriter& table = *guidance_;
  table.whole(row.known);
  table.tenths(row.known);
  table.whole(row.answered);
  table.tenths(row.answered);
  table.count(row.rsu);
  for (int empty = 0; empty < 4; ++empty) table.name("");  // no frame, no car, no command
  table.name(kDeadlineMissed);
  table.real(static_cast<double>(row.took_ms) / 1e3);
  table.name("");
  table.name("");
  table.name("");
  table.end_row();
}

void EventTables::add(const Encounter& row) {
  if (!safety_) return;
  TableWriter& table = *safety_;
  table.whole(row.ended);
  table.tenths(row.ended);
  table.name(kSafetyKindNames[static_cast<std::size_t>(row.kind)]);
  table.count(row.vehicle);
  table.name(name(row.lane));
  table.whole(row.equipped ? 1 : 0);
  row.other ? table.count(*row.other) : table.name("");
  table.name(row.other_lane ? name(*row.other_lane) : std::string_view());
  row.other_equipped ? table.whole(*row.other_equipped ? 1 : 0) : table.name("");
  table.whole(row.guided ? 1 : 0);
  table.whole(row.began);
  table.tenths(row.began);
  table.whole(row.last);
  table.whole(row.worst);
  table.tenths(row.worst);
  table.real(row.value);
  table.real(row.distance_m);
  table.real(row.speed_mps);
  table.end_row();
}

Expected<Done> EventTables::flush() {
  for (std::optional<TableWriter>* table : {&stops_, &guidance_, &requests_, &safety_}) {
    if (!*table) continue;
    if (auto flushed = (*table)->flush(); !flushed) return flushed;
  }
  return Done{};
}

Expected<Done> EventTables::sync() {
  for (std::optional<TableWriter>* table : {&stops_, &guidance_, &requests_, &safety_}) {
    if (!*table) continue;
    if (auto synced = (*table)->sync(); !synced) return synced;
  }
  return Done{};
}

std::size_t EventTables::buffered_bytes() const {
  std::size_t bytes = 0;
  for (const std::optional<TableWriter>* table : {&stops_, &guidance_, &requests_, &safety_}) {
    if (*table) bytes += (*table)->buffered_bytes();
  }
  return bytes;
}

std::vector<FileEntry> EventTables::entries() const {
  std::vector<FileEntry> entries;
  if (guidance_) entries.push_back({kGuidanceTable, guidance_->sha256(), guidance_->rows_flushed()});
  if (requests_) entries.push_back({kRequestsTable, requests_->sha256(), requests_->rows_flushed()});
  if (safety_) entries.push_back({kSafetyTable, safety_->sha256(), safety_->rows_flushed()});
  if (stops_) entries.push_back({kStopsTable, stops_->sha256(), stops_->rows_flushed()});
  return entries;
}

}  // namespace lukou::results
