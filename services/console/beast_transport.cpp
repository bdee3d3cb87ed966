#include "services/console/beast_transport.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

namespace lukou::console {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

constexpr std::size_t kConnectionsMax = 64;
constexpr std::uint32_t kHeaderBytesMax = 8U << 10U;
constexpr std::size_t kMessageBytesMax = 64U << 10U;
constexpr std::chrono::seconds kRequestLimit{10};       ///< for a whole request, and between two
constexpr std::chrono::seconds kSilenceLimit{30};       ///< of a viewer who does not answer pings
constexpr std::chrono::seconds kSendLimit{20};          ///< for one message
constexpr std::chrono::milliseconds kAcceptAgain{100};  ///< after the host had no descriptor to give
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; font-src 'self'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

using FileRequest = http::request<http::empty_body>;
using FileResponse = http::response<http::string_body>;

class Connection;

/// What all connections share.
struct Shared {
  Gate gate;
  PageFolder folder;
  Visitors& visitors;
  std::set<std::shared_ptr<Connection>> connections;
};

std::string_view text(beast::string_view view) { return {view.data(), view.size()}; }

FileResponse answer_to(const FileRequest& request, const PageFile& file) {
  FileResponse response{static_cast<http::status>(file.status), request.version()};
  response.set(http::field::content_type, file.type);
  response.set(http::field::cache_control, "no-cache");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Content-Security-Policy", kPolicy);
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.keep_alive(request.keep_alive());
  const std::string tag = "\"" + file.tag + "\"";
  if (!file.tag.empty()) response.set(http::field::etag, tag);
  if (file.tag.empty() || text(request[http::field::if_none_match]) != tag) {
    response.body() = file.body;
  } else {
    response.result(http::status::not_modified);
  }
  response.prepare_payload();
  if (request.method() == http::verb::head) response.body().clear();
  return response;
}

/// One connection, from its first byte to its end: files, then perhaps a socket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Shared& shared)
      : stream_(std::move(socket)), send_limit_(stream_.get_executor()), shared_(shared) {}

  void read_request() {
    parser_.emplace();
    parser_->header_limit(kHeaderBytesMax);
    parser_->body_limit(0);
    stream_.expires_after(kRequestLimit);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error == http::error::end_of_stream || error == beast::error::timeout) return self->end();
      if (error) return self->refuse({}, 400, "This is not a request that the console understands.");
      self->on_request(self->parser_->release());
    });
  }

  /// Sends what is new for the viewer, if nothing is under way.
  void pump() {
    if (viewer_ == 0 || sending_) return;
    sending_ = shared_.visitors.next(viewer_);
    if (!sending_) return;
    send_limit_.expires_after(kSendLimit);
    send_limit_.async_wait([self = shared_from_this()](beast::error_code cancelled) {
      if (!cancelled) self->end();
    });
    socket_->async_write(asio::buffer(*sending_), [self = shared_from_this()](beast::error_code error, std::size_t) {
      self->sending_.reset();
      self->send_limit_.cancel();
      if (error) return self->end();
      self->pump();
    });
  }

  [[nodiscard]] bool too_slow() const { return viewer_ != 0 && shared_.visitors.too_slow(viewer_); }

  /// At once, without a word.
  void end() {
    if (viewer_ != 0) shared_.visitors.gone(std::exchange(viewer_, 0));
    send_limit_.cancel();
    beast::error_code ignored;
    auto& lowest = socket_ ? beast::get_lowest_layer(*socket_) : stream_;
    static_cast<void>(lowest.socket().shutdown(tcp::socket::shutdown_both, ignored));
    lowest.close();
    shared_.connections.erase(shared_from_this());
  }

  void say_goodbye() {
    if (!socket_) return end();
    if (viewer_ != 0) shared_.visitors.gone(std::exchange(viewer_, 0));
    if (!socket_->is_open()) return end();
    socket_->async_close(websocket::close_code::going_away,
                         [self = shared_from_this()](beast::error_code) { self->end(); });
  }

 private:
  void on_request(FileRequest request) {
    const bool socket = websocket::is_upgrade(request);
    const std::string_view target = text(request.target());
    const Gate::Verdict verdict = shared_.gate.check({.host = text(request[http::field::host]),
                                                      .origin = text(request[http::field::origin]),
                                                      .target = target,
                                                      .cookie = text(request[http::field::cookie]),
                                                      .socket = socket});
    if (!verdict.why.empty()) return refuse(request, verdict.status, std::string(verdict.why));
    if (socket) {
      if (target.substr(0, target.find('?')) != "/ws") return refuse(request, 404, "The socket is at /ws.");
      return accept(std::move(request));
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head) {
      return refuse(request, 405, "Files are read with GET.");
    }
    FileResponse response = answer_to(request, shared_.folder.file(target));
    if (verdict.new_cookie) {
      response.set(http::field::set_cookie,
                   std::string(kTokenCookie) + "=" + shared_.gate.token() + "; Path=/; HttpOnly; SameSite=Strict");
    }
    respond(std::move(response));
  }

  void refuse(const FileRequest& request, unsigned status, const std::string& why) {
    FileResponse response = answer_to(request, {status, "text/plain; charset=utf-8", why + "\n", ""});
    response.keep_alive(false);
    respond(std::move(response));
  }

  void respond(FileResponse response) {
    response_ = std::move(response);
    stream_.expires_after(kRequestLimit);
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || !self->response_.keep_alive()) return self->end();
      self->read_request();
    });
  }

  void accept(FileRequest request) {
    stream_.expires_never();
    socket_.emplace(std::move(stream_));
    socket_->set_option(websocket::stream_base::timeout{
        .handshake_timeout = kRequestLimit, .idle_timeout = kSilenceLimit, .keep_alive_pings = true});
    socket_->read_message_max(kMessageBytesMax);
    socket_->binary(true);
    socket_->auto_fragment(false);
    // What a page sent before the answer is no part of the protocol.
    buffer_.clear();
    upgrade_ = std::move(request);
    socket_->async_accept(upgrade_, [self = shared_from_this()](beast::error_code error) {
      if (error) return self->end();
      self->viewer_ = self->shared_.visitors.came();
      self->read_message();
      self->pump();
    });
  }

  void read_message() {
    socket_->async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error || self->viewer_ == 0) return self->end();
      const auto bytes = self->buffer_.cdata();
      const bool understood =
          self->socket_->got_binary() &&
          self->shared_.visitors.said(self->viewer_, {static_cast<const char*>(bytes.data()), bytes.size()});
      self->buffer_.consume(self->buffer_.size());
      if (!understood) return self->end();
      self->pump();
      self->read_message();
    });
  }

  beast::tcp_stream stream_;
  asio::steady_timer send_limit_;
  Shared& shared_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  FileResponse response_;
  FileRequest upgrade_;
  std::optional<websocket::stream<beast::tcp_stream>> socket_;
  ViewerId viewer_ = 0;
  Bytes sending_;
};

class BeastTransport final : public Transport {
 public:
  BeastTransport(Gate gate, PageFolder folder, Visitors& visitors)
      : shared_{std::move(gate), std::move(folder), visitors, {}}, acceptor_(context_), again_(context_) {}

  ~BeastTransport() override {
    // Before the context goes: nothing under way may outlive what it refers to.
    const auto connections = shared_.connections;
    for (const auto& connection : connections) connection->end();
    beast::error_code ignored;
    static_cast<void>(acceptor_.close(ignored));
    again_.cancel();
    context_.poll();
  }

  Expected<Done> open(const Listening& listening) {
    beast::error_code error;
    const auto address = asio::ip::make_address(listening.address, error);
    if (error) return Error{"--address", "`" + listening.address + "` is not an IP address"};
    for (int i = 0; i < listening.ports_to_try; ++i) {
      const tcp::endpoint endpoint{address, static_cast<std::uint16_t>(listening.port + (listening.port == 0 ? 0 : i))};
      error = bind(endpoint);
      if (!error) break;
      if (error != asio::error::address_in_use) break;
    }
    if (error) {
      return Error{listening.address + ":" + std::to_string(listening.port), "cannot listen: " + error.message()};
    }
    accept();
    return Done{};
  }

  [[nodiscard]] std::uint16_t port() const override { return acceptor_.local_endpoint().port(); }

  void serve(double limit_s) override {
    const auto limit = std::chrono::microseconds(static_cast<long long>(limit_s * 1e6));
    if (context_.run_one_for(limit) > 0) context_.poll();
    const auto connections = shared_.connections;  // some may end
    for (const auto& connection : connections) {
      if (connection->too_slow()) {
        connection->end();
      } else {
        connection->pump();
      }
    }
  }

  void close() override {
    const auto connections = shared_.connections;
    for (const auto& connection : connections) connection->say_goodbye();
  }

 private:
  beast::error_code bind(const tcp::endpoint& endpoint) {
    beast::error_code error;
    beast::error_code ignored;
    static_cast<void>(acceptor_.close(ignored));
    static_cast<void>(acceptor_.open(endpoint.protocol(), error));
    if (!error) static_cast<void>(acceptor_.set_option(asio::socket_base::reuse_address(true), error));
    if (!error) static_cast<void>(acceptor_.bind(endpoint, error));
    if (!error) static_cast<void>(acceptor_.listen(asio::socket_base::max_listen_connections, error));
    return error;
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {
        again_.expires_after(kAcceptAgain);
        again_.async_wait([this](beast::error_code cancelled) {
          if (!cancelled) accept();
        });
        return;
      }
      // Whoever is too many is closed at once.
      if (shared_.connections.size() < kConnectionsMax) {
        static_cast<void>(socket.set_option(tcp::no_delay(true), error));
        auto connection = std::make_shared<Connection>(std::move(socket), shared_);
        shared_.connections.insert(connection);
        connection->read_request();
      }
      accept();
    });
  }

  Shared shared_;
  asio::io_context context_;
  tcp::acceptor acceptor_;
  asio::steady_timer again_;
};

}  // namespace

Expected<std::unique_ptr<Transport>> listen(const Listening& listening, Gate gate, PageFolder folder,
                                            Visitors& visitors) {
  auto transport = std::make_unique<BeastTransport>(std::move(gate), std::move(folder), visitors);
  if (auto opened = transport->open(listening); !opened) return opened.error();
  return std::unique_ptr<Transport>(std::move(transport));
}

}  // namespace lukou::console
