#pragma once

#include <string>
#include <utility>
#include <vector>

#include "common/core/expected.hpp"

namespace lukou::process {

/// Short lines in both directions between a launcher and a program that it started. Never waits.
class LineLink {
 public:
  /// `descriptor`: of a connected stream socket, owned from now on; -1: nobody is at the other end.
  explicit LineLink(int descriptor = -1);
  LineLink(LineLink&& other) noexcept;
  LineLink& operator=(LineLink&& other) noexcept;
  ~LineLink();

  /// Two ends; the descriptor of the second is for a child: it stays open over exec.
  static Expected<std::pair<LineLink, int>> pair();

  /// False once the other end is gone.
  [[nodiscard]] bool open() const { return descriptor_ >= 0; }
  /// Complete lines that have come in since the last call.
  std::vector<std::string> take();
  /// What the other end does not take at once is lost: it has stopped reading long ago.
  void say(const std::string& line);

 private:
  void close();

  int descriptor_;
  std::string pending_;
};

}  // namespace lukou::process
