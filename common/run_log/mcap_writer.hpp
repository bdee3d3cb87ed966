#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/core/hash.hpp"
#include "common/run_log/mcap_records.hpp"

namespace lukou::run_log {

/// Writes an MCAP file: messages in chunks that are compressed with zstd and have a checksum and an index. What
/// end_chunk() has written survives the death of the process; the bytes depend on the calls alone.
class McapWriter {
 public:
  /// `library`: what the header says wrote the file. Errors: the file is there already, or cannot be made.
  static Expected<McapWriter> create(const std::filesystem::path& file, std::string_view library);
  McapWriter(McapWriter&& other) noexcept;
  McapWriter& operator=(McapWriter&& other) noexcept;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  ~McapWriter();

  /// A channel of Protobuf messages. `descriptors`: a serialised FileDescriptorSet that holds `type`. Returns its
  /// number.
  std::uint16_t add_channel(const std::string& topic, const std::string& type, std::string_view descriptors);
  /// Requires that no message came before.
  void add_metadata(const Metadata& metadata);

  /// Puts a message into the open chunk. Log times must not go backwards.
  void add(std::uint16_t channel, std::uint64_t log_time_ns, std::uint32_t sequence, std::string_view message);
  /// Writes what is not written yet: header, channels and metadata, and the open chunk if it holds anything. On failure
  /// it stays open, and what of it got through is cut off.
  Expected<Done> end_chunk();
  /// Writes the open chunk and the end of the file, and waits until the disk has it all. Nothing may follow.
  Expected<Done> close();

  /// SHA-256 of what has been written.
  [[nodiscard]] std::string sha256() const { return hash_->hex(); }

 private:
  struct Compressor;
  McapWriter(int file, std::filesystem::path path);
  /// Writes out_; on failure cuts the file back.
  Expected<Done> write_out();

  int file_ = -1;
  std::filesystem::path path_;
  std::unique_ptr<Compressor> compressor_;
  std::unique_ptr<Sha256> hash_;
  std::string head_;   ///< records before the first chunk that are not written yet
  std::string chunk_;  ///< messages of the open chunk, not compressed
  std::string out_;
  std::uint64_t first_ns_ = 0;  ///< of the open chunk
  std::uint64_t last_ns_ = 0;
  std::map<std::uint16_t, std::string> message_indexes_;  ///< of the open chunk: pairs of time and offset
  McapIndex index_;
};

}  // namespace lukou::run_log
