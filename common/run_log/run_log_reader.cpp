#include "common/run_log/run_log_reader.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "common/run_log/channels.hpp"
#include "common/run_log/messages.hpp"
#include "run_log.pb.h"

namespace lukou::run_log {
namespace {

std::optional<Level> level_of(const std::string& text) {
  for (const Level level : {Level::kEvents, Level::kSecond, Level::kFull}) {
    if (text == name(level)) return level;
  }
  return std::nullopt;
}

Expected<Facts> facts_of(const McapReader& file, const std::string& where) {
  const auto metadata = file.metadata("lukou");
  if (!metadata) return Error{where, "is no run log of Lukou: it has no metadata `lukou`"};
  const auto entry = [&](const char* key) {
    const auto found = metadata->entries.find(key);
    return found == metadata->entries.end() ? std::string() : found->second;
  };
  Facts facts;
  const auto level = level_of(entry("level"));
  if (!level) return Error{where, "has the unknown level `" + entry("level") + "`"};
  for (std::size_t i = 0; i < kChannels; ++i) {
    const auto topic = file.topics().find(static_cast<std::uint16_t>(i + 1));
    if (topic == file.topics().end() || topic->second != kTopics[i]) {
      return Error{where, "has no channel " + std::string(kTopics[i]) + " with the number " + std::to_string(i + 1)};
    }
  }
  facts.level = *level;
  facts.lukou_version = entry("version");
  facts.scenario = entry("scenario");
  facts.scenario_hash = entry("scenario_hash");
  const std::string planned = entry("steps_planned");
  std::from_chars(planned.data(), planned.data() + planned.size(), facts.steps_planned);
  return facts;
}

Step step_at(std::uint64_t log_time_ns) { return static_cast<Step>(log_time_ns / kStep_ns); }

}  // namespace

struct RunLogReader::Decoder {
  record::Directive directive;
  record::Signal signal;
  record::Events events;
  record::Cars cars;
  record::Reception reception;
  record::Air air;
  record::Roadside roadside;
};

Expected<RunLogReader> RunLogReader::open(const std::filesystem::path& folder) {
  auto file = McapReader::open(folder / kRunLog);
  if (!file) return file.error();
  auto facts = facts_of(file.value(), (folder / kRunLog).string());
  if (!facts) return facts.error();
  return RunLogReader(std::move(file).value(), std::move(facts).value());
}

RunLogReader::RunLogReader(McapReader file, Facts facts)
    : file_(std::move(file)), facts_(std::move(facts)), decoder_(std::make_unique<Decoder>()) {}

// Views into the other's chunk would dangle: the chunk is read again.
RunLogReader::RunLogReader(RunLogReader&& other) noexcept
    : file_(std::move(other.file_)),
      facts_(std::move(other.facts_)),
      decoder_(std::move(other.decoder_)),
      channels_(other.channels_) {
  seek(other.next_step_);
}

RunLogReader& RunLogReader::operator=(RunLogReader&& other) noexcept {
  file_ = std::move(other.file_);
  facts_ = std::move(other.facts_);
  decoder_ = std::move(other.decoder_);
  channels_ = other.channels_;
  seek(other.next_step_);
  return *this;
}

RunLogReader::~RunLogReader() = default;

Step RunLogReader::last_step() const {
  const auto& chunks = file_.index().chunks;
  return chunks.empty() ? -1 : step_at(chunks.back().last_ns);
}

void RunLogReader::read_only(std::initializer_list<Channel> channels) {
  channels_ = 0;
  for (const Channel channel : channels) channels_ |= 1U << static_cast<unsigned>(channel);
}

Expected<std::vector<Directive>> RunLogReader::directives() const {
  std::vector<Directive> found;
  const auto& chunks = file_.index().chunks;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    // Of a chunk whose indexes a death has torn off nothing is known.
    const auto& held = chunks[i].message_indexes;
    if (!held.empty() && !held.contains(static_cast<std::uint16_t>(Channel::kDirective))) continue;
    const auto messages = file_.chunk(i);
    if (!messages) return messages.error();
    std::string_view rest = messages.value();
    while (const auto message = McapReader::take_message(rest)) {
      if (message->channel != static_cast<std::uint16_t>(Channel::kDirective)) continue;
      record::Directive directive;
      if (!directive.ParseFromArray(message->data.data(), static_cast<int>(message->data.size()))) {
        return Error{std::string(kRunLog) + ": /directive", "a message is broken"};
      }
      found.push_back({directive.step(), directive.set()});
    }
  }
  return found;
}

void RunLogReader::seek(Step step) {
  const auto& chunks = file_.index().chunks;
  const auto holds =
      std::ranges::find_if(chunks, [&](const ChunkIndex& chunk) { return step_at(chunk.last_ns) >= step; });
  next_chunk_ = static_cast<std::size_t>(holds - chunks.begin());
  rest_ = {};
  message_.reset();
  from_ = next_step_ = step;
}

Expected<Done> RunLogReader::load(std::size_t chunk) {
  auto messages = file_.chunk(chunk);
  if (!messages) return messages.error();
  chunk_ = std::move(messages).value();
  rest_ = chunk_;
  return Done{};
}

Expected<LoggedStep*> RunLogReader::next() {
  step_.step = -1;
  step_.cars = false;
  step_.directives.clear();
  step_.signal.reset();
  step_.traffic.clear();
  while (true) {
    if (!message_) message_ = McapReader::take_message(rest_);
    if (!message_) {
      if (step_.step >= 0 || next_chunk_ >= file_.index().chunks.size()) break;  // chunks end with steps
      if (auto done = load(next_chunk_++); !done) return done.error();
      continue;
    }
    const Step step = step_at(message_->log_time_ns);
    if (step_.step >= 0 && step != step_.step) break;
    if (step >= from_) {
      step_.step = step;
      if (auto done = take(*message_); !done) return done.error();
    }
    message_.reset();
  }
  if (step_.step < 0) return static_cast<LoggedStep*>(nullptr);
  step_.traffic.step = step_.step;
  next_step_ = step_.step + 1;
  return &step_;
}

Expected<Done> RunLogReader::take(const McapReader::Message& message) {
  if (message.channel < 32 && (channels_ & (1U << message.channel)) == 0) return Done{};
  const auto parsed = [&](auto& into) {
    return into.ParseFromArray(message.data.data(), static_cast<int>(message.data.size()));
  };
  bool good = true;
  switch (static_cast<Channel>(message.channel)) {
    case Channel::kDirective:
      good = parsed(decoder_->directive);
      step_.directives.push_back({decoder_->directive.step(), decoder_->directive.set()});
      break;
    case Channel::kSignal:
      good = parsed(decoder_->signal) && run_log::take(decoder_->signal, step_.signal.emplace());
      break;
    case Channel::kEvents:
      good = parsed(decoder_->events) && run_log::take(decoder_->events, step_.traffic);
      break;
    case Channel::kCars:
      good = parsed(decoder_->cars) && run_log::take(decoder_->cars, step_.traffic);
      step_.cars = true;
      break;
    case Channel::kReception:
      good = parsed(decoder_->reception) && run_log::take(decoder_->reception, step_.traffic);
      break;
    case Channel::kAir:
      good = parsed(decoder_->air) && run_log::take(decoder_->air, step_.traffic);
      break;
    case Channel::kRoadside:
      good = parsed(decoder_->roadside) && run_log::take(decoder_->roadside, step_.traffic);
      break;
  }
  if (good) return Done{};
  const std::string topic = file_.topics().contains(message.channel) ? file_.topics().at(message.channel) : "?";
  return Error{std::string(kRunLog) + ": " + topic, "the message of step " + std::to_string(step_.step) + " is broken"};
}

}  // namespace lukou::run_log
