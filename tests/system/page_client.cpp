#include "tests/system/page_client.hpp"

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

#include "console.pb.h"

namespace lukou::test {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

tcp::endpoint console_at(std::uint16_t port) { return {asio::ip::make_address("127.0.0.1"), port}; }

}  // namespace

struct PageClient::Wire {
  asio::io_context context;
  websocket::stream<tcp::socket> socket{context};
  beast::flat_buffer buffer;
  int status = 0;
  bool open = false;
  bool reading = false;
  bool got = false;
};

PageClient::PageClient(std::uint16_t port, const Manners& manners)
    : wire_(std::make_unique<Wire>()), draws_(manners.draws) {
  const std::string host = manners.host.empty() ? "127.0.0.1:" + std::to_string(port) : manners.host;
  beast::error_code error;
  wire_->socket.next_layer().connect(console_at(port), error);
  if (error) return;
  wire_->socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    const std::string origin = manners.origin.value_or("http://" + host);
    if (!origin.empty()) request.set(beast::http::field::origin, origin);
    if (!manners.cookie.empty()) request.set(beast::http::field::cookie, manners.cookie);
  }));
  websocket::response_type response;
  wire_->socket.handshake(response, host, manners.path, error);
  wire_->status = static_cast<int>(response.result_int());
  wire_->open = !error;
  if (wire_->open) wire_->socket.binary(true);
}

PageClient::~PageClient() {
  beast::error_code ignored;
  wire_->socket.next_layer().close(ignored);
  wire_->context.poll();
}

int PageClient::status() const { return wire_->status; }
bool PageClient::open() const { return wire_->open; }

std::optional<console::ToPage> PageClient::next(double limit_s) {
  if (!wire_->open) return std::nullopt;
  if (!wire_->reading) {
    wire_->reading = true;
    wire_->got = false;
    wire_->socket.async_read(wire_->buffer, [this](beast::error_code error, std::size_t) {
      wire_->reading = false;
      wire_->got = !error;
      if (error) wire_->open = false;
    });
  }
  wire_->context.restart();
  const auto limit = std::chrono::microseconds(static_cast<long long>(limit_s * 1e6));
  const auto begin = std::chrono::steady_clock::now();
  while (wire_->reading && std::chrono::steady_clock::now() - begin < limit) {
    wire_->context.run_one_for(limit - (std::chrono::steady_clock::now() - begin));
  }
  if (wire_->reading || !wire_->got) return std::nullopt;
  console::ToPage message;
  const auto bytes = wire_->buffer.cdata();
  const bool parsed = message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
  wire_->buffer.clear();
  if (!parsed) return std::nullopt;
  if (draws_ && message.has_picture()) {
    console::FromPage drawn;
    drawn.mutable_drawn()->set_step(message.picture().step());
    say(drawn);
  }
  return message;
}

std::optional<console::ToPage> PageClient::until(const std::function<bool(const console::ToPage&)>& passes,
                                                 double limit_s) {
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
    if (gone.count() >= limit_s) return std::nullopt;
    auto message = next(limit_s - gone.count());
    if (!message || passes(*message)) return message;
  }
}

void PageClient::say(const console::FromPage& message) { say_raw(message.SerializeAsString()); }

void PageClient::say_raw(const std::string& bytes, bool binary) {
  if (!wire_->open) return;
  beast::error_code error;
  wire_->socket.binary(binary);
  wire_->socket.write(asio::buffer(bytes), error);
}

void PageClient::take_control(bool from_another) {
  console::FromPage message;
  message.mutable_take_control()->set_from_another(from_another);
  say(message);
}

std::string PageClient::ask(const std::string& text) {
  console::FromPage message;
  message.mutable_request()->set_number(++requests_);
  message.mutable_request()->set_text(text);
  say(message);
  const auto answer = until([&](const console::ToPage& m) { return m.has_reply() && m.reply().number() == requests_; });
  if (!answer) return "no answer";
  return (answer->reply().ok() ? "" : "refused: ") + answer->reply().text();
}

std::string http_get(std::uint16_t port, const std::string& target, const std::string& host,
                     const std::string& more_headers) {
  asio::io_context context;
  tcp::socket socket(context);
  beast::error_code error;
  socket.connect(console_at(port), error);
  const std::string request =
      "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\nConnection: close\r\n" + more_headers + "\r\n";
  asio::write(socket, asio::buffer(request), error);
  std::string answer;
  asio::read(socket, asio::dynamic_buffer(answer), error);
  return answer;
}

}  // namespace lukou::test
