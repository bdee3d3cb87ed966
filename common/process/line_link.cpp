#include "common/process/line_link.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace lukou::process {

LineLink::LineLink(int descriptor) : descriptor_(descriptor) {}

LineLink::LineLink(LineLink&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), pending_(std::move(other.pending_)) {}

LineLink& LineLink::operator=(LineLink&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(pending_, other.pending_);
  return *this;
}

LineLink::~LineLink() { close(); }

void LineLink::close() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

Expected<std::pair<LineLink, int>> LineLink::pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) return Error{"socketpair", std::strerror(errno)};
  ::fcntl(ends[0], F_SETFD, FD_CLOEXEC);
  return std::pair(LineLink(ends[0]), ends[1]);
}

std::vector<std::string> LineLink::take() {
  std::array<char, 4096> some{};
  while (open()) {
    const auto got = ::recv(descriptor_, some.data(), some.size(), MSG_DONTWAIT);
    if (got > 0) {
      pending_.append(some.data(), static_cast<std::size_t>(got));
    } else if (got < 0 && errno == EINTR) {
      continue;
    } else {
      if (got == 0 || (errno != EAGAIN && errno != EWOULDBLOCK)) close();
      break;
    }
  }
  std::vector<std::string> lines;
  for (std::size_t end = pending_.find('\n'); end != std::string::npos; end = pending_.find('\n')) {
    lines.push_back(pending_.substr(0, end));
    pending_.erase(0, end + 1);
  }
  return lines;
}

void LineLink::say(const std::string& line) {
  if (!open()) return;
  const std::string bytes = line + "\n";
  const auto sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent != static_cast<ssize_t>(bytes.size())) close();
}

}  // namespace lukou::process
