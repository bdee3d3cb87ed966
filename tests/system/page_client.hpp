#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace lukou::console {
class FromPage;
class ToPage;
}  // namespace lukou::console

namespace lukou::test {

/// What a browser does, without a browser: one WebSocket to a console.
class PageClient {
 public:
  struct Manners {
    std::string path = "/ws";
    std::optional<std::string> origin;  ///< empty: as the page itself
    std::string host;                   ///< empty: 127.0.0.1:port
    std::string cookie;
    bool draws = true;  ///< says of each picture that it was drawn
  };
  explicit PageClient(std::uint16_t port) : PageClient(port, Manners()) {}
  PageClient(std::uint16_t port, const Manners& manners);
  ~PageClient();
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  /// HTTP status of the answer; 101: a socket.
  [[nodiscard]] int status() const;
  /// Whether the socket is still open, as far as has been read.
  [[nodiscard]] bool open() const;
  /// The next message; nothing if none comes within the limit or the socket is closed.
  std::optional<console::ToPage> next(double limit_s = 10.0);
  /// The next message that passes; others are dropped.
  std::optional<console::ToPage> until(const std::function<bool(const console::ToPage&)>& passes,
                                       double limit_s = 20.0);
  void say(const console::FromPage& message);
  void say_raw(const std::string& bytes, bool binary = true);
  void take_control(bool from_another = false);
  /// Asks and waits for the answer: its text, after "refused: " if it was refused.
  std::string ask(const std::string& text);

 private:
  struct Wire;
  std::unique_ptr<Wire> wire_;
  bool draws_;
  std::uint32_t requests_ = 0;
};

/// Answer to a GET: status line, headers and body as they came.
std::string http_get(std::uint16_t port, const std::string& target, const std::string& host = "127.0.0.1",
                     const std::string& more_headers = "");

}  // namespace lukou::test
