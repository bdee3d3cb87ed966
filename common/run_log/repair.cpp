#include "common/run_log/repair.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "common/run_log/mcap_reader.hpp"
#include "common/run_log/run_log.hpp"

namespace lukou::run_log {
namespace {

Error failure(const std::filesystem::path& file, const char* what) {
  return Error{file.string(), std::string(what) + ": " + std::strerror(errno)};
}

/// Cuts a file to `size` bytes and appends to it.
Expected<Done> put_end(const std::filesystem::path& file, std::uint64_t size, std::string_view end) {
  const int handle = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (handle < 0) return failure(file, "cannot be written");
  bool good = ::ftruncate(handle, static_cast<off_t>(size)) == 0;
  while (good && !end.empty()) {
    const ssize_t part = ::write(handle, end.data(), end.size());
    good = part > 0 || (part < 0 && errno == EINTR);
    if (part > 0) end.remove_prefix(static_cast<std::size_t>(part));
  }
  good = good && ::fsync(handle) == 0;
  const Error error = failure(file, "cannot be given an end");
  ::close(handle);
  return good ? Expected<Done>(Done{}) : Expected<Done>(error);
}

}  // namespace

Expected<Done> repair(const std::filesystem::path& file, Step last) {
  auto log = McapReader::open(file);
  if (!log) {
    std::error_code code;
    std::filesystem::remove(file, code);
    return code ? Expected<Done>(Error{file.string(), "cannot be removed: " + code.message()}) : Expected<Done>(Done{});
  }
  const auto limit_ns = static_cast<std::uint64_t>(last < 0 ? 0 : last) * kStep_ns;
  const auto& chunks = log.value().index().chunks;
  std::size_t kept = chunks.size();
  while (kept > 0 && (last < 0 || chunks[kept - 1].last_ns > limit_ns)) --kept;
  if (kept == chunks.size() && log.value().finished()) return Done{};
  if (kept < chunks.size()) {
    // Without its end the file tells its index anew.
    if (auto done = put_end(file, chunks[kept].offset, {}); !done) return done;
    log = McapReader::open(file);
    if (!log) return log.error();
  }
  const McapIndex& index = log.value().index();
  return put_end(file, index.data_end, tail_of(index));
}

}  // namespace lukou::run_log
