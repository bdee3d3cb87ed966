#include "common/run_log/mcap_writer.hpp"

#include <fcntl.h>
#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou::run_log {
namespace {

/// The fastest level that still finds what repeats from step to step.
constexpr int kCompressionLevel = 1;

Error failure(const std::filesystem::path& path, const char* what) {
  return Error{path.string(), std::string(what) + ": " + std::strerror(errno)};
}

}  // namespace

struct McapWriter::Compressor {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  Compressor() = default;
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  ~Compressor() { ZSTD_freeCCtx(context); }

  /// Appends the compressed bytes.
  void compress(std::string_view bytes, std::string& to) const {
    const std::size_t begin = to.size();
    to.resize(begin + ZSTD_compressBound(bytes.size()));
    const std::size_t size =
        ZSTD_compressCCtx(context, to.data() + begin, to.size() - begin, bytes.data(), bytes.size(), kCompressionLevel);
    LUKOU_EXPECT(ZSTD_isError(size) == 0);
    to.resize(begin + size);
  }
};

Expected<McapWriter> McapWriter::create(const std::filesystem::path& file, std::string_view library) {
  const int handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644);
  if (handle < 0) return failure(file, "cannot be created");
  McapWriter writer(handle, file);
  writer.head_ = kMcapMagic;
  std::string content;
  FieldWriter write(content);
  write.text("");  // no profile
  write.text(library);
  put_record(writer.head_, Opcode::kHeader, content);
  return writer;
}

McapWriter::McapWriter(int file, std::filesystem::path path)
    : file_(file),
      path_(std::move(path)),
      compressor_(std::make_unique<Compressor>()),
      hash_(std::make_unique<Sha256>()) {}

McapWriter::McapWriter(McapWriter&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      compressor_(std::move(other.compressor_)),
      hash_(std::move(other.hash_)),
      head_(std::move(other.head_)),
      chunk_(std::move(other.chunk_)),
      out_(std::move(other.out_)),
      first_ns_(other.first_ns_),
      last_ns_(other.last_ns_),
      message_indexes_(std::move(other.message_indexes_)),
      index_(std::move(other.index_)) {}

McapWriter& McapWriter::operator=(McapWriter&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  std::swap(compressor_, other.compressor_);
  std::swap(hash_, other.hash_);
  std::swap(head_, other.head_);
  std::swap(chunk_, other.chunk_);
  std::swap(out_, other.out_);
  std::swap(first_ns_, other.first_ns_);
  std::swap(last_ns_, other.last_ns_);
  std::swap(message_indexes_, other.message_indexes_);
  std::swap(index_, other.index_);
  return *this;
}

McapWriter::~McapWriter() {
  if (file_ >= 0) ::close(file_);
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& type, std::string_view descriptors) {
  const auto number = static_cast<std::uint16_t>(index_.channels.size() + 1);
  std::string& schema = index_.schemas.emplace_back();
  FieldWriter of_schema(schema);
  of_schema.u16(number);
  of_schema.text(type);
  of_schema.text("protobuf");
  of_schema.text(descriptors);
  put_record(head_, Opcode::kSchema, schema);
  std::string& channel = index_.channels.emplace_back();
  FieldWriter of_channel(channel);
  of_channel.u16(number);
  of_channel.u16(number);  // the schema's
  of_channel.text(topic);
  of_channel.text("protobuf");
  of_channel.texts({});
  put_record(head_, Opcode::kChannel, channel);
  return number;
}

void McapWriter::add_metadata(const Metadata& metadata) {
  LUKOU_EXPECT(chunk_.empty() && index_.chunks.empty());
  std::string content;
  FieldWriter write(content);
  write.text(metadata.name);
  write.texts(metadata.entries);
  index_.metadata.push_back({metadata.name, head_.size(), kRecordHead + content.size()});
  put_record(head_, Opcode::kMetadata, content);
}

void McapWriter::add(std::uint16_t channel, std::uint64_t log_time_ns, std::uint32_t sequence,
                     std::string_view message) {
  LUKOU_EXPECT(channel >= 1 && channel <= index_.channels.size());
  if (chunk_.empty()) first_ns_ = log_time_ns;
  last_ns_ = log_time_ns;
  FieldWriter at(message_indexes_[channel]);
  at.u64(log_time_ns);
  at.u64(chunk_.size());
  constexpr std::size_t kMessageHead = 22;
  FieldWriter write(chunk_);
  write.u8(static_cast<std::uint8_t>(Opcode::kMessage));
  write.u64(kMessageHead + message.size());
  write.u16(channel);
  write.u32(sequence);
  write.u64(log_time_ns);
  write.u64(log_time_ns);
  chunk_ += message;
  ++index_.messages[channel];
}

Expected<Done> McapWriter::end_chunk() {
  out_ = head_;
  if (chunk_.empty()) {
    if (auto done = write_out(); !done) return done;
    head_.clear();
    return Done{};
  }
  ChunkIndex chunk{.first_ns = first_ns_,
                   .last_ns = last_ns_,
                   .offset = index_.data_end + out_.size(),
                   .uncompressed_size = chunk_.size()};
  std::string packed;
  compressor_->compress(chunk_, packed);
  chunk.compressed_size = packed.size();
  std::string content;
  FieldWriter write(content);
  write.u64(first_ns_);
  write.u64(last_ns_);
  write.u64(chunk_.size());
  write.u32(crc32_of(chunk_));
  write.text("zstd");
  write.u64(packed.size());
  content += packed;
  put_record(out_, Opcode::kChunk, content);
  chunk.length = kRecordHead + content.size();
  const std::size_t indexes = out_.size();
  for (const auto& [channel, pairs] : message_indexes_) {
    chunk.message_indexes[channel] = index_.data_end + out_.size();
    std::string entry;
    FieldWriter of_channel(entry);
    of_channel.u16(channel);
    of_channel.text(pairs);
    put_record(out_, Opcode::kMessageIndex, entry);
  }
  chunk.message_index_length = out_.size() - indexes;
  if (auto done = write_out(); !done) return done;
  index_.chunks.push_back(std::move(chunk));
  head_.clear();
  chunk_.clear();
  message_indexes_.clear();
  return Done{};
}

Expected<Done> McapWriter::write_out() {
  std::string_view rest = out_;
  while (!rest.empty()) {
    const ssize_t part = ::write(file_, rest.data(), rest.size());
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) {
      const Error error = failure(path_, "cannot be written");
      // A reader stops at a torn record, so if this fails too nothing before it is lost.
      static_cast<void>(::ftruncate(file_, static_cast<off_t>(index_.data_end)) == 0);
      return error;
    }
    rest.remove_prefix(static_cast<std::size_t>(part));
  }
  hash_->add(out_);
  index_.data_end += out_.size();
  return Done{};
}

Expected<Done> McapWriter::close() {
  if (auto done = end_chunk(); !done) return done;
  out_ = tail_of(index_);
  if (auto done = write_out(); !done) return done;
  if (::fsync(file_) != 0) return failure(path_, "cannot be synced");
  return Done{};
}

}  // namespace lukou::run_log
