#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The records of an MCAP file, as far as a run log uses them. Little endian; a record is an opcode, a length of eight
// bytes and its content. Source: the MCAP specification, version 0.

namespace lukou::run_log {

inline constexpr std::string_view kMcapMagic = "\x89MCAP0\r\n";
inline constexpr std::size_t kRecordHead = 9;  ///< bytes of opcode and length

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

/// What the index says of a chunk.
struct ChunkIndex {
  std::uint64_t first_ns = 0;  ///< log time of its first message
  std::uint64_t last_ns = 0;
  std::uint64_t offset = 0;                                ///< of its record in the file
  std::uint64_t length = 0;                                ///< of its record, head included
  std::map<std::uint16_t, std::uint64_t> message_indexes;  ///< offset of each channel's message index
  std::uint64_t message_index_length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

struct Metadata {
  std::string name;
  std::map<std::string, std::string> entries;
};

/// Appends fields to a record's content.
class FieldWriter {
 public:
  explicit FieldWriter(std::string& bytes) : bytes_(bytes) {}
  void u8(std::uint8_t value) { bytes_ += static_cast<char>(value); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  void text(std::string_view value);
  void texts(const std::map<std::string, std::string>& values);
  void counts(const std::map<std::uint16_t, std::uint64_t>& values);

 private:
  void number(std::uint64_t value, int bytes);
  std::string& bytes_;
};

/// Takes fields from a record's content; once something is missing every further field is empty and ok() is false.
class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : rest_(bytes) {}
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::string_view text() { return bytes(u32()); }
  std::map<std::string, std::string> texts();
  std::map<std::uint16_t, std::uint64_t> counts();
  std::string_view bytes(std::uint64_t size);
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  std::uint64_t number(std::size_t bytes);
  std::string_view rest_;
  bool ok_ = true;
};

/// A record in bytes that hold records one after the other.
struct Record {
  Opcode opcode{};
  std::string_view content;
};
/// Takes the next record off the front of `bytes`; nothing if there is no whole one.
std::optional<Record> take_record(std::string_view& bytes);
/// Appends a whole record.
void put_record(std::string& bytes, Opcode opcode, std::string_view content);

std::string content_of(const ChunkIndex& index);
std::optional<ChunkIndex> chunk_index_of(std::string_view content);

/// What the end of a file says of the rest.
struct McapIndex {
  struct MetadataPlace {
    std::string name;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
  };
  std::vector<std::string> schemas;   ///< contents of their records
  std::vector<std::string> channels;  ///< likewise
  std::vector<MetadataPlace> metadata;
  std::vector<ChunkIndex> chunks;
  std::map<std::uint16_t, std::uint64_t> messages;  ///< by channel
  std::uint64_t data_end = 0;                       ///< offset in the file behind the last record of the data
};

/// All that follows the data: end of the data, summary, footer, magic.
std::string tail_of(const McapIndex& index);

/// CRC-32 (IEEE 802.3) of bytes, going on from that of the bytes before.
std::uint32_t crc32_of(std::string_view bytes, std::uint32_t before = 0);

}  // namespace lukou::run_log
