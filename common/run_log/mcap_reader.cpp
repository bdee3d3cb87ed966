#include "common/run_log/mcap_reader.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace lukou::run_log {
namespace {

constexpr std::uint64_t kFooterContent = 20;
constexpr std::uint64_t kChunkHead = 8 + 8 + 8 + 4 + (4 + 4) + 8;  ///< bytes of a chunk before its compressed messages
/// A chunk of ours is far smaller; a larger one is a broken length.
constexpr std::uint64_t kUncompressedMax = 1ULL << 30U;

}  // namespace

Expected<McapReader> McapReader::open(const std::filesystem::path& file) {
  const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (handle < 0) return Error{file.string(), std::string("cannot be read: ") + std::strerror(errno)};
  struct stat facts{};
  const bool sized = ::fstat(handle, &facts) == 0 && S_ISREG(facts.st_mode);
  McapReader reader(handle, file, sized ? static_cast<std::uint64_t>(facts.st_size) : 0);
  const auto magic = reader.bytes(0, kMcapMagic.size());
  if (!magic || *magic != kMcapMagic) return reader.wrong("is no MCAP file: it does not begin as one");
  if (!reader.read_summary()) {
    if (auto done = reader.scan(); !done) return done.error();
  }
  if (auto done = reader.note_channels(); !done) return done.error();
  return reader;
}

McapReader::McapReader(McapReader&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      size_(other.size_),
      index_(std::move(other.index_)),
      topics_(std::move(other.topics_)),
      finished_(other.finished_),
      torn_bytes_(other.torn_bytes_) {}

McapReader& McapReader::operator=(McapReader&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  std::swap(size_, other.size_);
  std::swap(index_, other.index_);
  std::swap(topics_, other.topics_);
  std::swap(finished_, other.finished_);
  std::swap(torn_bytes_, other.torn_bytes_);
  return *this;
}

McapReader::~McapReader() {
  if (file_ >= 0) ::close(file_);
}

std::optional<std::string> McapReader::bytes(std::uint64_t offset, std::uint64_t size) const {
  if (offset > size_ || size > size_ - offset) return std::nullopt;
  std::string found(size, '\0');
  std::uint64_t have = 0;
  while (have < size) {
    const ssize_t part = ::pread(file_, found.data() + have, size - have, static_cast<off_t>(offset + have));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) return std::nullopt;
    have += static_cast<std::uint64_t>(part);
  }
  return found;
}

bool McapReader::read_summary() {
  const std::uint64_t end_size = kRecordHead + kFooterContent + kMcapMagic.size();
  if (size_ < end_size) return false;
  const auto end = bytes(size_ - end_size, end_size);
  if (!end || !end->ends_with(kMcapMagic)) return false;
  FieldReader footer(*end);
  const bool is_footer = footer.u8() == static_cast<std::uint8_t>(Opcode::kFooter) && footer.u64() == kFooterContent;
  const std::uint64_t summary = footer.u64();
  footer.u64();
  const std::uint32_t crc = footer.u32();
  if (!is_footer || summary < kMcapMagic.size() || summary > size_ - end_size) return false;
  const auto records = bytes(summary, size_ - end_size - summary);
  if (!records) return false;
  const std::string_view counted = std::string_view(*end).substr(0, kRecordHead + 16);
  if (crc32_of(counted, crc32_of(*records)) != crc) return false;
  std::string_view rest = *records;
  while (const auto record = take_record(rest)) {
    FieldReader content(record->content);
    if (record->opcode == Opcode::kSchema) index_.schemas.emplace_back(record->content);
    if (record->opcode == Opcode::kChannel) index_.channels.emplace_back(record->content);
    if (record->opcode == Opcode::kChunkIndex) {
      auto chunk = chunk_index_of(record->content);
      if (!chunk) return false;
      index_.chunks.push_back(std::move(*chunk));
    }
    if (record->opcode == Opcode::kMetadataIndex) {
      const std::uint64_t offset = content.u64();
      const std::uint64_t length = content.u64();
      index_.metadata.push_back({std::string(content.text()), offset, length});
    }
    if (record->opcode == Opcode::kStatistics) {
      content.bytes(8 + 2 + 4 + 4 + 4 + 4 + 8 + 8);
      index_.messages = content.counts();
    }
  }
  index_.data_end = summary - kRecordHead - 4;  // before the end of the data
  finished_ = true;
  return true;
}

Expected<Done> McapReader::scan() {
  index_ = {};
  std::uint64_t offset = kMcapMagic.size();
  index_.data_end = offset;
  while (const auto head = bytes(offset, kRecordHead)) {
    FieldReader read(*head);
    const auto opcode = static_cast<Opcode>(read.u8());
    const std::uint64_t size = read.u64();
    if (size > size_ - offset - kRecordHead || opcode == Opcode::kDataEnd || opcode == Opcode::kFooter) break;
    note(opcode, offset, size);
    offset += kRecordHead + size;
    index_.data_end = offset;
  }
  torn_bytes_ = size_ - index_.data_end;
  if (index_.channels.empty()) return wrong("holds no channel: whoever wrote it was ended before it began");
  return Done{};
}

void McapReader::note(Opcode opcode, std::uint64_t offset, std::uint64_t size) {
  const std::uint64_t begin = offset + kRecordHead;
  if (opcode == Opcode::kChunk) {
    const auto head = bytes(begin, std::min(size, kChunkHead));
    FieldReader read(*head);
    ChunkIndex chunk{.offset = offset, .length = kRecordHead + size};
    chunk.first_ns = read.u64();
    chunk.last_ns = read.u64();
    chunk.uncompressed_size = read.u64();
    chunk.compressed_size = size - std::min(size, kChunkHead);
    index_.chunks.push_back(std::move(chunk));
    return;
  }
  const bool small = opcode == Opcode::kSchema || opcode == Opcode::kChannel || opcode == Opcode::kMetadata ||
                     opcode == Opcode::kMessageIndex;
  const auto content = small ? bytes(begin, size) : std::nullopt;
  if (!content) return;
  FieldReader read(*content);
  switch (opcode) {
    case Opcode::kSchema:
      index_.schemas.push_back(*content);
      break;
    case Opcode::kChannel:
      index_.channels.push_back(*content);
      break;
    case Opcode::kMetadata:
      index_.metadata.push_back({std::string(read.text()), offset, kRecordHead + size});
      break;
    case Opcode::kMessageIndex: {
      if (index_.chunks.empty()) break;
      const std::uint16_t channel = read.u16();
      index_.chunks.back().message_indexes[channel] = offset;
      index_.chunks.back().message_index_length += kRecordHead + size;
      index_.messages[channel] += read.text().size() / 16;
      break;
    }
    default:
      break;
  }
}

Expected<Done> McapReader::note_channels() {
  for (const std::string& content : index_.channels) {
    FieldReader read(content);
    const std::uint16_t number = read.u16();
    read.u16();
    topics_[number] = read.text();
    if (!read.ok()) return wrong("has a broken channel record");
  }
  return Done{};
}

std::optional<Metadata> McapReader::metadata(std::string_view name) const {
  for (const McapIndex::MetadataPlace& place : index_.metadata) {
    if (place.name != name) continue;
    const auto record = bytes(place.offset, place.length);
    if (!record || record->size() < kRecordHead) return std::nullopt;
    FieldReader read(std::string_view(*record).substr(kRecordHead));
    Metadata found;
    found.name = read.text();
    found.entries = read.texts();
    if (read.ok()) return found;
  }
  return std::nullopt;
}

Expected<std::string> McapReader::chunk(std::size_t number) const {
  const ChunkIndex& place = index_.chunks.at(number);
  const std::string where = "the chunk at byte " + std::to_string(place.offset);
  const auto record = bytes(place.offset, place.length);
  if (!record) return wrong(where + " cannot be read");
  std::string_view rest = *record;
  const auto taken = take_record(rest);
  if (!taken || taken->opcode != Opcode::kChunk) return wrong(where + " is not there");
  FieldReader read(taken->content);
  read.u64();
  read.u64();
  const std::uint64_t size = read.u64();
  const std::uint32_t crc = read.u32();
  const bool known = read.text() == "zstd";
  const std::string_view packed = read.bytes(read.u64());
  if (!read.ok() || !known || size > kUncompressedMax) return wrong(where + " is broken");
  std::string messages(size, '\0');
  const std::size_t got = ZSTD_decompress(messages.data(), messages.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0 || got != size) return wrong(where + " cannot be uncompressed");
  if (crc32_of(messages) != crc) return wrong(where + " has another checksum than was written");
  return messages;
}

std::optional<McapReader::Message> McapReader::take_message(std::string_view& chunk) {
  while (const auto record = take_record(chunk)) {
    if (record->opcode != Opcode::kMessage) continue;
    FieldReader read(record->content);
    Message message;
    message.channel = read.u16();
    message.sequence = read.u32();
    message.log_time_ns = read.u64();
    read.u64();
    message.data = read.rest();
    if (read.ok()) return message;
  }
  return std::nullopt;
}

}  // namespace lukou::run_log
