#include "services/lukou/report/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "common/results/result_folder.hpp"

namespace lukou::report {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1U << 18U;

Error failure(const fs::path& path, const char* what) {
  return Error{path.string(), std::string(what) + ": " + std::strerror(errno)};
}

Error taken(const fs::path& path) { return Error{path.string(), "exists already; name another with --out"}; }

}  // namespace

Expected<OutputFile> OutputFile::create(const fs::path& file) {
  std::error_code code;  // says that there is no such file: that is well
  if (fs::exists(fs::symlink_status(file, code))) return taken(file);
  code.clear();
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), code);
  if (code) return Error{file.parent_path().string(), "cannot be created: " + code.message()};
  fs::path unfinished = file;
  unfinished += "." + std::to_string(::getpid());
  unfinished += results::kUnfinished;
  const int number = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (number < 0) return failure(file, "cannot be created");
  return OutputFile(number, file, std::move(unfinished));
}

OutputFile::OutputFile(int file, fs::path path, fs::path unfinished)
    : file_(file), path_(std::move(path)), unfinished_(std::move(unfinished)) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::exchange(other.file_, -1)),
      path_(std::move(other.path_)),
      unfinished_(std::move(other.unfinished_)),
      buffer_(std::move(other.buffer_)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  abandon();
  file_ = std::exchange(other.file_, -1);
  path_ = std::move(other.path_);
  unfinished_ = std::move(other.unfinished_);
  buffer_ = std::move(other.buffer_);
  return *this;
}

OutputFile::~OutputFile() { abandon(); }

void OutputFile::abandon() {
  if (file_ < 0) return;
  ::close(file_);
  ::unlink(unfinished_.c_str());
  file_ = -1;
}

Expected<Done> OutputFile::write(std::string_view bytes) {
  buffer_.append(bytes);
  return buffer_.size() >= kBufferBytes ? flush() : Expected<Done>(Done{});
}

Expected<Done> OutputFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t part = ::write(file_, rest.data(), rest.size());
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) return failure(path_, "cannot be written");
    rest.remove_prefix(static_cast<std::size_t>(part));
  }
  buffer_.clear();
  return Done{};
}

Expected<Done> OutputFile::finish() {
  if (auto flushed = flush(); !flushed) return flushed;
  if (::fsync(file_) != 0) return failure(path_, "cannot be synced");
  if (auto named = give_name(unfinished_, path_); !named) return named;
  ::close(std::exchange(file_, -1));
  return Done{};
}

Expected<Done> write_new_file(const fs::path& file, std::string_view content) {
  auto output = OutputFile::create(file);
  if (!output) return output.error();
  if (auto written = output.value().write(content); !written) return written;
  return output.value().finish();
}

Expected<Done> give_name(const fs::path& unfinished, const fs::path& name) {
  if (::renameat2(AT_FDCWD, unfinished.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0) return Done{};
  if (errno == EEXIST) return taken(name);
  // A file system that knows no such rename.
  if (errno == EINVAL) {
    std::error_code code;
    if (fs::exists(fs::symlink_status(name, code))) return taken(name);
    if (::rename(unfinished.c_str(), name.c_str()) == 0) return Done{};
  }
  return failure(name, "cannot be given its name");
}

}  // namespace lukou::report
