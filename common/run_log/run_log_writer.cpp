#include "common/run_log/run_log_writer.hpp"

#include <google/protobuf/descriptor.pb.h>

#include <utility>

#include "common/core/contract.hpp"
#include "common/run_log/channels.hpp"
#include "common/run_log/messages.hpp"
#include "run_log.pb.h"

namespace lukou::run_log {
namespace {

std::string descriptors() {
  google::protobuf::FileDescriptorSet set;
  record::Cars::descriptor()->file()->CopyTo(set.add_file());
  return set.SerializeAsString();
}

template <class Message>
constexpr Channel kChannelOf = Channel::kDirective;
template <>
constexpr Channel kChannelOf<record::Signal> = Channel::kSignal;
template <>
constexpr Channel kChannelOf<record::Events> = Channel::kEvents;
template <>
constexpr Channel kChannelOf<record::Cars> = Channel::kCars;
template <>
constexpr Channel kChannelOf<record::Reception> = Channel::kReception;
template <>
constexpr Channel kChannelOf<record::Air> = Channel::kAir;
template <>
constexpr Channel kChannelOf<record::Roadside> = Channel::kRoadside;

}  // namespace

std::string_view name(Level level) {
  switch (level) {
    case Level::kNone:
      return "NONE";
    case Level::kEvents:
      return "EVENTS";
    case Level::kSecond:
      return "SECOND";
    case Level::kFull:
      return "FULL";
  }
  return "";
}

struct RunLogWriter::Messages {
  record::Directive directive;
  record::Signal signal;
  record::Events events;
  record::Cars cars;
  record::Reception reception;
  record::Air air;
  record::Roadside roadside;
  std::string bytes;
};

Expected<RunLogWriter> RunLogWriter::create(const std::filesystem::path& folder, const Facts& facts) {
  LUKOU_EXPECT(facts.level != Level::kNone);
  auto file = McapWriter::create(folder / kRunLog, "lukou " + facts.lukou_version);
  if (!file) return file.error();
  const std::string schema = descriptors();
  for (std::size_t i = 0; i < kChannels; ++i) {
    file.value().add_channel(std::string(kTopics[i]), std::string(kTypes[i]), schema);
  }
  file.value().add_metadata({.name = "lukou",
                             .entries = {{"level", std::string(name(facts.level))},
                                         {"version", facts.lukou_version},
                                         {"scenario", facts.scenario},
                                         {"scenario_hash", facts.scenario_hash},
                                         {"steps_planned", std::to_string(facts.steps_planned)}}});
  if (auto done = file.value().end_chunk(); !done) return done.error();
  return RunLogWriter(std::move(file).value(), facts.level);
}

RunLogWriter::RunLogWriter(McapWriter file, Level level)
    : file_(std::move(file)), level_(level), messages_(std::make_unique<Messages>()) {}
RunLogWriter::RunLogWriter(RunLogWriter&& other) noexcept = default;
RunLogWriter& RunLogWriter::operator=(RunLogWriter&& other) noexcept = default;
RunLogWriter::~RunLogWriter() = default;

template <class Message>
void RunLogWriter::add(const Message& message) {
  std::string& bytes = messages_->bytes;
  bytes.clear();
  LUKOU_EXPECT(message.AppendToString(&bytes));
  file_.add(static_cast<std::uint16_t>(kChannelOf<Message>), static_cast<std::uint64_t>(step_) * kStep_ns,
            static_cast<std::uint32_t>(step_), bytes);
}

Expected<Done> RunLogWriter::add(const std::vector<Directive>& directives, const SignalBatch* signal,
                                 const TrafficBatch& traffic) {
  step_ = traffic.step;
  if (step_ > 0 && step_ % kChunkSteps == 0) {
    if (auto done = file_.end_chunk(); !done) return done;
  }
  for (const Directive& directive : directives) {
    messages_->directive.set_step(directive.step);
    messages_->directive.set_set(directive.set);
    add(messages_->directive);
  }
  if (signal != nullptr) {
    fill(messages_->signal, *signal, step_);
    add(messages_->signal);
  }
  fill(messages_->events, traffic);
  add(messages_->events);
  const bool full = level_ == Level::kFull;
  if (full || (level_ == Level::kSecond && step_ % kStepsPerSecond == 0)) {
    fill(messages_->cars, traffic);
    add(messages_->cars);
  }
  if (!full) return Done{};
  if (traffic.reception.size() > 0) {
    fill(messages_->reception, traffic);
    add(messages_->reception);
  }
  fill(messages_->air, traffic);
  add(messages_->air);
  fill(messages_->roadside, traffic);
  add(messages_->roadside);
  return Done{};
}

Expected<Done> RunLogWriter::close() { return file_.close(); }

}  // namespace lukou::run_log
