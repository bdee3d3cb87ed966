#include "common/results/table.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/core/contract.hpp"

namespace lukou::results {
namespace {

constexpr int kDecimals = 6;
constexpr std::size_t kNumberSizeMax = 400;  // 1e308 in full, with its decimals

template <class Number, class... Format>
void append_number(std::string& buffer, Number number, Format... format) {
  std::array<char, kNumberSizeMax> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), number, format...);
  LUKOU_EXPECT(result.ec == std::errc{});
  buffer.append(digits.data(), result.ptr);
}

void append_real(std::string& buffer, double number) {
  if (!std::isfinite(number)) return;
  const std::size_t begin = buffer.size();
  append_number(buffer, number, std::chars_format::fixed, kDecimals);
  while (buffer.back() == '0') buffer.pop_back();
  if (buffer.back() == '.') buffer.pop_back();
  if (buffer.compare(begin, std::string::npos, "-0") == 0) buffer.replace(begin, 2, "0");
}

Error failure(const std::filesystem::path& path, const char* what) {
  return Error{path.string(), std::string(what) + ": " + std::strerror(errno)};
}

}  // namespace

Expected<TableWriter> TableWriter::create(const std::filesystem::path& file, std::string_view columns) {
  const int handle = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644);
  if (handle < 0) return failure(file, "cannot be created");
  TableWriter table(handle, file);
  table.buffer_.append(columns).append("\n");
  table.whole_rows_size_ = table.buffer_.size();
  const auto written = table.flush();
  if (!written) return written.error();
  return table;
}

TableWriter::TableWriter(int file, std::filesystem::path path)
    : file_(file), path_(std::move(path)), hash_(std::make_unique<Sha256>()) {}

TableWriter::TableWriter(TableWriter&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      buffer_(std::move(other.buffer_)),
      whole_rows_size_(other.whole_rows_size_),
      rows_buffered_(other.rows_buffered_),
      rows_flushed_(other.rows_flushed_),
      size_(other.size_),
      hash_(std::move(other.hash_)) {}

TableWriter& TableWriter::operator=(TableWriter&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(path_, other.path_);
  std::swap(buffer_, other.buffer_);
  std::swap(whole_rows_size_, other.whole_rows_size_);
  std::swap(rows_buffered_, other.rows_buffered_);
  std::swap(rows_flushed_, other.rows_flushed_);
  std::swap(size_, other.size_);
  std::swap(hash_, other.hash_);
  return *this;
}

TableWriter::~TableWriter() {
  if (file_ >= 0) ::close(file_);
}

void TableWriter::end_cell() { buffer_ += ','; }

void TableWriter::whole(std::int64_t number) {
  append_number(buffer_, number);
  end_cell();
}

void TableWriter::count(std::uint64_t number) {
  append_number(buffer_, number);
  end_cell();
}

void TableWriter::tenths(std::int64_t tenths_of_s) {
  if (tenths_of_s < 0) buffer_ += '-';
  const std::int64_t size = tenths_of_s < 0 ? -tenths_of_s : tenths_of_s;
  append_number(buffer_, size / 10);
  buffer_ += '.';
  buffer_ += static_cast<char>('0' + size % 10);
  end_cell();
}

void TableWriter::real(double number) {
  append_real(buffer_, number);
  end_cell();
}

void TableWriter::name(std::string_view text) {
  LUKOU_EXPECT(text.find_first_of(",\"\r\n") == std::string_view::npos);
  buffer_ += text;
  end_cell();
}

void TableWriter::end_row() {
  LUKOU_EXPECT(buffer_.size() > whole_rows_size_);
  buffer_.back() = '\n';  // in place of the last cell's comma
  whole_rows_size_ = buffer_.size();
  ++rows_buffered_;
}

Expected<Done> TableWriter::flush() {
  std::size_t written = 0;
  while (written < whole_rows_size_) {
    const ssize_t part = ::write(file_, buffer_.data() + written, whole_rows_size_ - written);
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) {
      const Error error = failure(path_, "cannot be written");
      // Whatever of a row got through must not stay. If this fails too, repair() cuts it.
      if (written > 0 && ::ftruncate(file_, size_) != 0)
        return Error{error.where, error.what + " (and has a torn row)"};
      return error;
    }
    written += static_cast<std::size_t>(part);
  }
  hash_->add(std::string_view(buffer_).substr(0, whole_rows_size_));
  size_ += static_cast<std::int64_t>(whole_rows_size_);
  rows_flushed_ += std::exchange(rows_buffered_, 0);
  buffer_.erase(0, std::exchange(whole_rows_size_, 0));
  return Done{};
}

Expected<Done> TableWriter::sync() {
  if (auto flushed = flush(); !flushed) return flushed;
  if (::fsync(file_) != 0) return failure(path_, "cannot be synced");
  return Done{};
}

std::string real_text(double number) {
  std::string text;
  append_real(text, number);
  return text;
}

}  // namespace lukou::results
