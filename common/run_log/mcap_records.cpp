#include "common/run_log/mcap_records.hpp"

#include <zlib.h>

namespace lukou::run_log {
namespace {

constexpr std::string_view kCompression = "zstd";

}  // namespace

void FieldWriter::number(std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i, value >>= 8U) bytes_ += static_cast<char>(value & 0xffU);
}

void FieldWriter::text(std::string_view value) {
  u32(static_cast<std::uint32_t>(value.size()));
  bytes_ += value;
}

void FieldWriter::texts(const std::map<std::string, std::string>& values) {
  std::string pairs;
  FieldWriter inner(pairs);
  for (const auto& [key, value] : values) {
    inner.text(key);
    inner.text(value);
  }
  text(pairs);
}

void FieldWriter::counts(const std::map<std::uint16_t, std::uint64_t>& values) {
  std::string pairs;
  FieldWriter inner(pairs);
  for (const auto& [key, value] : values) {
    inner.u16(key);
    inner.u64(value);
  }
  text(pairs);
}

std::string_view FieldReader::bytes(std::uint64_t size) {
  if (!ok_ || size > rest_.size()) {
    ok_ = false;
    rest_ = {};
    return {};
  }
  const std::string_view taken = rest_.substr(0, size);
  rest_.remove_prefix(size);
  return taken;
}

std::uint64_t FieldReader::number(std::size_t size) {
  std::uint64_t value = 0;
  const std::string_view taken = bytes(size);
  for (std::size_t i = taken.size(); i-- > 0;) value = (value << 8U) | static_cast<std::uint8_t>(taken[i]);
  return value;
}

std::map<std::string, std::string> FieldReader::texts() {
  std::map<std::string, std::string> values;
  FieldReader inner(text());
  while (inner.ok() && !inner.rest().empty()) {
    const std::string key(inner.text());
    values[key] = inner.text();
  }
  ok_ = ok_ && inner.ok();
  return values;
}

std::map<std::uint16_t, std::uint64_t> FieldReader::counts() {
  std::map<std::uint16_t, std::uint64_t> values;
  FieldReader inner(text());
  while (inner.ok() && !inner.rest().empty()) {
    const std::uint16_t key = inner.u16();
    values[key] = inner.u64();
  }
  ok_ = ok_ && inner.ok();
  return values;
}

std::optional<Record> take_record(std::string_view& bytes) {
  FieldReader head(bytes);
  const auto opcode = static_cast<Opcode>(head.u8());
  const std::uint64_t size = head.u64();
  if (!head.ok() || size > head.rest().size()) return std::nullopt;
  const Record record{opcode, head.bytes(size)};
  bytes.remove_prefix(kRecordHead + size);
  return record;
}

void put_record(std::string& bytes, Opcode opcode, std::string_view content) {
  FieldWriter head(bytes);
  head.u8(static_cast<std::uint8_t>(opcode));
  head.u64(content.size());
  bytes += content;
}

std::string content_of(const ChunkIndex& index) {
  std::string content;
  FieldWriter write(content);
  write.u64(index.first_ns);
  write.u64(index.last_ns);
  write.u64(index.offset);
  write.u64(index.length);
  write.counts(index.message_indexes);
  write.u64(index.message_index_length);
  write.text(kCompression);
  write.u64(index.compressed_size);
  write.u64(index.uncompressed_size);
  return content;
}

std::optional<ChunkIndex> chunk_index_of(std::string_view content) {
  FieldReader read(content);
  ChunkIndex index;
  index.first_ns = read.u64();
  index.last_ns = read.u64();
  index.offset = read.u64();
  index.length = read.u64();
  index.message_indexes = read.counts();
  index.message_index_length = read.u64();
  const bool known = read.text() == kCompression;
  index.compressed_size = read.u64();
  index.uncompressed_size = read.u64();
  if (!read.ok() || !known) return std::nullopt;
  return index;
}

namespace {

std::string content_of(const McapIndex::MetadataPlace& place) {
  std::string content;
  FieldWriter write(content);
  write.u64(place.offset);
  write.u64(place.length);
  write.text(place.name);
  return content;
}

std::string statistics_of(const McapIndex& index) {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : index.messages) messages += count;
  std::string content;
  FieldWriter write(content);
  write.u64(messages);
  write.u16(static_cast<std::uint16_t>(index.schemas.size()));
  write.u32(static_cast<std::uint32_t>(index.channels.size()));
  write.u32(0);  // attachments
  write.u32(static_cast<std::uint32_t>(index.metadata.size()));
  write.u32(static_cast<std::uint32_t>(index.chunks.size()));
  write.u64(index.chunks.empty() ? 0 : index.chunks.front().first_ns);
  write.u64(index.chunks.empty() ? 0 : index.chunks.back().last_ns);
  write.counts(index.messages);
  return content;
}

}  // namespace

std::string tail_of(const McapIndex& index) {
  std::string tail;
  put_record(tail, Opcode::kDataEnd, std::string(4, '\0'));  // the data have no checksum beside those of the chunks
  const std::size_t summary = tail.size();
  std::string offsets;
  const auto group = [&](Opcode opcode, const std::vector<std::string>& contents) {
    if (contents.empty()) return;
    const std::size_t begin = tail.size();
    for (const std::string& content : contents) put_record(tail, opcode, content);
    std::string place;
    FieldWriter write(place);
    write.u8(static_cast<std::uint8_t>(opcode));
    write.u64(index.data_end + begin);
    write.u64(tail.size() - begin);
    put_record(offsets, Opcode::kSummaryOffset, place);
  };
  std::vector<std::string> chunks;
  for (const ChunkIndex& chunk : index.chunks) chunks.push_back(content_of(chunk));
  std::vector<std::string> metadata;
  for (const McapIndex::MetadataPlace& place : index.metadata) metadata.push_back(content_of(place));
  group(Opcode::kSchema, index.schemas);
  group(Opcode::kChannel, index.channels);
  group(Opcode::kStatistics, {statistics_of(index)});
  group(Opcode::kChunkIndex, chunks);
  group(Opcode::kMetadataIndex, metadata);
  const std::size_t summary_offsets = tail.size();
  tail += offsets;
  // The checksum goes from the summary to the footer's field before it.
  FieldWriter write(tail);
  write.u8(static_cast<std::uint8_t>(Opcode::kFooter));
  write.u64(20);
  write.u64(index.data_end + summary);
  write.u64(index.data_end + summary_offsets);
  write.u32(crc32_of(std::string_view(tail).substr(summary)));
  tail += kMcapMagic;
  return tail;
}

std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace lukou::run_log
