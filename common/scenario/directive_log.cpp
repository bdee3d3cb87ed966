#include "common/scenario/directive_log.hpp"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <utility>

#include "common/scenario/scenario.hpp"
#include "directives.pb.h"

namespace lukou::scenario {
namespace {

using google::protobuf::TextFormat;

class FirstError final : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, int column, const std::string& message) override {
    if (what.empty()) what = ":" + std::to_string(line + 1) + ":" + std::to_string(column + 1) + ": " + message;
  }
  std::string what;
};

}  // namespace

Expected<DirectiveLog> load_directives(const std::filesystem::path& file) {
  const auto content = read_file(file);
  if (!content) return Error{file.string(), content.error().what};
  TextFormat::Parser parser;
  FirstError error;
  parser.RecordErrorsTo(&error);
  DirectiveRecord record;
  if (!parser.ParseFromString(content.value(), &record)) return Error{"", file.string() + error.what};
  DirectiveLog log;
  for (const auto& change : record.changes()) {
    if (!log.sets.empty() && change.step() < log.sets.back().step) {
      return Error{file.string(), "changes must stand in the order of their steps; step " +
                                      std::to_string(change.step()) + " follows " +
                                      std::to_string(log.sets.back().step)};
    }
    log.sets.push_back({change.step(), change.set()});
  }
  for (const auto& hearing : record.hearings())
    log.hearings.push_back({hearing.rsu(), hearing.from_step(), hearing.epoch()});
  if (record.has_stop_step()) log.stop = record.stop_step();
  for (const auto& computed : record.computed())
    log.computed.push_back({computed.rsu(), computed.step(), computed.delay_ms()});
  return log;
}

std::string text(const DirectiveLog& log) {
  DirectiveRecord record;
  for (const Directive& directive : log.sets) {
    auto* change = record.add_changes();
    change->set_step(directive.step);
    change->set_set(directive.set);
  }
  for (const Hearing& heard : log.hearings) {
    auto* hearing = record.add_hearings();
    hearing->set_rsu(heard.rsu);
    hearing->set_from_step(heard.from);
    hearing->set_epoch(heard.epoch);
  }
  if (log.stop) record.set_stop_step(*log.stop);
  for (const ComputingDelay& delay : log.computed) {
    auto* computed = record.add_computed();
    computed->set_rsu(delay.rsu);
    computed->set_step(delay.step);
    computed->set_delay_ms(delay.delay_ms);
  }
  std::string printed;
  TextFormat::PrintToString(record, &printed);
  return printed;
}

}  // namespace lukou::scenario
