#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/core/expected.hpp"
#include "common/run_log/mcap_records.hpp"

namespace lukou::run_log {

/// Reads an MCAP file as McapWriter writes it. A file without its end (whoever wrote it was killed) is read up to its
/// last whole chunk.
class McapReader {
 public:
  /// Errors: no such file, no MCAP file, one that uses what ours do not.
  static Expected<McapReader> open(const std::filesystem::path& file);
  McapReader(McapReader&& other) noexcept;
  McapReader& operator=(McapReader&& other) noexcept;
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;
  ~McapReader();

  [[nodiscard]] const McapIndex& index() const { return index_; }
  /// False: the file has no end, its index was made by reading the whole of it.
  [[nodiscard]] bool finished() const { return finished_; }
  /// Bytes behind the last whole record of a file that has no end.
  [[nodiscard]] std::uint64_t torn_bytes() const { return torn_bytes_; }
  /// Topic of each channel, by number.
  [[nodiscard]] const std::map<std::uint16_t, std::string>& topics() const { return topics_; }
  [[nodiscard]] std::optional<Metadata> metadata(std::string_view name) const;

  /// The messages of a chunk, uncompressed. Errors: the file has changed, or its bytes are not those that were written.
  Expected<std::string> chunk(std::size_t number) const;

  struct Message {
    std::uint16_t channel = 0;
    std::uint32_t sequence = 0;
    std::uint64_t log_time_ns = 0;
    std::string_view data;
  };
  /// Takes the next message off the front of a chunk; nothing at its end.
  static std::optional<Message> take_message(std::string_view& chunk);

 private:
  McapReader(int file, std::filesystem::path path, std::uint64_t size)
      : file_(file), path_(std::move(path)), size_(size) {}
  [[nodiscard]] std::optional<std::string> bytes(std::uint64_t offset, std::uint64_t size) const;
  bool read_summary();
  Expected<Done> scan();
  Expected<Done> note_channels();
  void note(Opcode opcode, std::uint64_t offset, std::uint64_t size);
  [[nodiscard]] Error wrong(const std::string& what) const { return {path_.string(), what}; }

  int file_ = -1;
  std::filesystem::path path_;
  std::uint64_t size_ = 0;
  McapIndex index_;
  std::map<std::uint16_t, std::string> topics_;
  bool finished_ = false;
  std::uint64_t torn_bytes_ = 0;
};

}  // namespace lukou::run_log
