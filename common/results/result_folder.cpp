#include "common/results/result_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace lukou::results {
namespace {

namespace fs = std::filesystem;

constexpr int kNamesMax = 10000;

/// An open file, closed at the end.
class Handle {
 public:
  explicit Handle(int number) : number_(number) {}
  ~Handle() {
    if (number_ >= 0) ::close(number_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

Error failure(const fs::path& path, const char* what, int code) {
  return Error{path.string(), std::string(what) + ": " + std::strerror(code)};
}

Expected<Done> write_all(int file, const fs::path& path, std::string_view content) {
  while (!content.empty()) {
    const ssize_t part = ::write(file, content.data(), content.size());
    if (part < 0 && errno == EINTR) continue;
    if (part < 0) return failure(path, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(part));
  }
  if (::fsync(file) != 0) return failure(path, "cannot be synced", errno);
  return Done{};
}

Expected<Done> make_parents(const fs::path& folder) {
  std::error_code code;
  if (folder.has_parent_path()) fs::create_directories(folder.parent_path(), code);
  if (code) return Error{folder.parent_path().string(), "cannot be created: " + code.message()};
  return Done{};
}

}  // namespace

Expected<ResultFolder> ResultFolder::create(const fs::path& folder) {
  const fs::path path = folder.has_filename() ? folder : folder.parent_path();  // "a/b/" means "a/b"
  const auto parents = make_parents(path);
  if (!parents) return parents.error();
  if (::mkdir(path.c_str(), 0755) == 0) return ResultFolder(path);
  if (errno != EEXIST) return failure(path, "cannot be created", errno);
  std::error_code code;
  if (!fs::is_directory(path, code)) return Error{path.string(), "is no folder"};
  const bool empty = fs::is_empty(path, code);
  if (code) return Error{path.string(), "cannot be read: " + code.message()};
  if (!empty) return Error{path.string(), "is not empty; results go into a new or an empty folder"};
  return ResultFolder(path);
}

Expected<ResultFolder> ResultFolder::create_new(const fs::path& base, std::string_view stamp, std::string_view pace) {
  const std::string first = std::string(stamp) + "-" + std::string(pace);
  const auto parents = make_parents(base / first);
  if (!parents) return parents.error();
  for (int n = 1; n <= kNamesMax; ++n) {
    const fs::path path = base / (n == 1 ? first : first + "-" + std::to_string(n));
    if (::mkdir(path.c_str(), 0755) == 0) return ResultFolder(path);
    if (errno != EEXIST) return failure(path, "cannot be created", errno);
  }
  return Error{(base / first).string(), "and its next names are taken; name a folder with --out"};
}

Expected<Done> ResultFolder::write_file(const std::string& name, std::string_view content) const {
  return results::write_file(path_ / name, content);
}

Expected<Done> write_file(const fs::path& file, std::string_view content) {
  fs::path unfinished = file;
  unfinished += kUnfinished;
  {
    const Handle handle(::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (handle.number() < 0) return failure(unfinished, "cannot be created", errno);
    const auto written = write_all(handle.number(), unfinished, content);
    if (!written) {
      ::unlink(unfinished.c_str());
      return written;
    }
  }
  if (::rename(unfinished.c_str(), file.c_str()) != 0) return failure(file, "cannot be replaced", errno);
  // The new name must survive a power cut too.
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Handle handle(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (handle.number() < 0 || ::fsync(handle.number()) != 0) return failure(folder, "cannot be synced", errno);
  return Done{};
}

}  // namespace lukou::results
