// The one source that includes Boost.Beast.
#include "view/server.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <utility>

#include "core/error.h"
#include "core/interrupt.h"
#include "view/limits.h"
#include "view/request_origin.h"

namespace phos::inline view {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Request = http::request<http::string_body>;
using FileResponse = http::response<http::span_body<const char>>;

constexpr std::string_view kSocketPath = "/socket";
constexpr std::string_view kPlain = "text/plain; charset=utf-8";
constexpr std::uint32_t kMostHeaderBytes = 8192;
constexpr std::chrono::seconds kRequestTime{30}, kSendTime{600};
constexpr auto kInterruptTime = std::chrono::milliseconds(100);  // between looks at interrupted()

std::string_view view_of(beast::string_view s) { return {s.data(), s.size()}; }
beast::string_view beast_view(std::string_view s) { return {s.data(), s.size()}; }

/// What the connections of a server share.
struct Shared {
  ServedPage page;
  std::string host;
  std::int64_t connections = 0;
};

/// Counts a connection while it lives.
class Counted {
 public:
  explicit Counted(Shared& shared) : shared_(shared) { ++shared_.connections; }
  ~Counted() { --shared_.connections; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  Shared& shared_;
};

/// A WebSocket: each message gets its answer before the next is read.
class SocketConnection : public std::enable_shared_from_this<SocketConnection> {
 public:
  SocketConnection(beast::tcp_stream stream, Shared& shared)
      : shared_(shared), counted_(shared), socket_(std::move(stream)) {}

  void accept(Request request) {
    request_ = std::move(request);
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(kMostQuestionBytes.as<std::size_t>());
    socket_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
      if (!error) self->read();
    });
  }

 private:
  void read() {
    buffer_.clear();
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->answer();
    });
  }

  void answer() {
    const auto bytes = buffer_.cdata();
    try {
      if (socket_.got_text()) throw Error(ExitCode::bad_input, "", "is text");
      answer_ = shared_.page.answer({static_cast<const char*>(bytes.data()), bytes.size()});
    } catch (const Error&) {
      socket_.async_close(websocket::close_code::bad_payload,
                          [self = shared_from_this()](beast::error_code) {});
      return;
    }
    socket_.binary(true);
    socket_.async_write(asio::buffer(answer_),
                        [self = shared_from_this()](beast::error_code error, std::size_t) {
                          if (!error) self->read();
                        });
  }

  Shared& shared_;
  Counted counted_;
  websocket::stream<beast::tcp_stream> socket_;
  Request request_;
  beast::flat_buffer buffer_;
  std::string answer_;
};

/// Requests of one connection, one after another.
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  HttpConnection(Tcp::socket socket, Shared& shared)
      : shared_(shared), counted_(shared), stream_(std::move(socket)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeaderBytes);
    parser_->body_limit(0);
    stream_.expires_after(kRequestTime);
    http::async_read(
        stream_, buffer_, *parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
          if (error == http::error::end_of_stream)
            self->close();
          else if (error == http::error::header_limit)
            self->refuse(http::status::request_header_fields_too_large);
          else if (error == http::error::body_limit)
            self->refuse(http::status::payload_too_large);
          else if (error && error.category() == http::make_error_code(http::error::bad_method).category())
            self->refuse(http::status::bad_request);
          else if (!error)
            self->respond();
        });
  }

 private:
  void respond() {
    const Request& request = parser_->get();
    const std::string_view host = view_of(request[http::field::host]);
    if (!names_this_server(host, shared_.host)) return refuse(http::status::forbidden);
    const std::string_view target = view_of(request.target());
    const std::string_view path = target.substr(0, target.find('?'));
    if (path == kSocketPath && websocket::is_upgrade(request)) {
      std::optional<std::string_view> origin;
      if (const auto found = request.find(http::field::origin); found != request.end())
        origin = view_of(found->value());
      if (!is_same_origin(origin, host)) return refuse(http::status::forbidden);
      std::make_shared<SocketConnection>(std::move(stream_), shared_)->accept(parser_->release());
      return;
    }
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(http::status::method_not_allowed);
    const std::optional<ServedFile> file = shared_.page.file(path);
    if (!file) return refuse(http::status::not_found);
    send(http::status::ok, *file, request.keep_alive());
  }

  void refuse(http::status status) {
    said_ = std::string(view_of(http::obsolete_reason(status))) + "\n";
    send(status, {kPlain, said_}, false);
  }

  void send(http::status status, const ServedFile& file, bool keep_alive) {
    const Request& request = parser_->get();
    response_ = FileResponse(status, request.version() == 10 ? 10 : 11);
    response_.set(http::field::content_type, beast_view(file.type));
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Content-Security-Policy",
                  "default-src 'self'; img-src 'self' data:; frame-ancestors 'none'");
    if (status == http::status::method_not_allowed) response_.set(http::field::allow, "GET, HEAD");
    const bool head = request.method() == http::verb::head;
    response_.body() = {file.bytes.data(), head ? 0 : file.bytes.size()};
    response_.keep_alive(keep_alive);
    response_.content_length(file.bytes.size());
    serializer_.emplace(response_);
    stream_.expires_after(kSendTime);
    const auto sent = [self = shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
      if (error) return;
      if (keep_alive)
        self->read();
      else
        self->close();
    };
    if (head)
      http::async_write_header(stream_, *serializer_, sent);
    else
      http::async_write(stream_, *serializer_, sent);
  }

  void close() {
    beast::error_code ignored;
    stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  }

  Shared& shared_;
  Counted counted_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  std::string said_;
  FileResponse response_;
  std::optional<http::response_serializer<http::span_body<const char>>> serializer_;
};

}  // namespace

struct ViewServer::Impl {
  Impl(const ServerAddress& address, ServedPage page)
      : shared{std::move(page), address.host}, acceptor(io), look(io) {
    const auto port = static_cast<unsigned short>(address.port);
    beast::error_code error;
    const auto found =
        Tcp::resolver(io).resolve(address.host, std::to_string(port), Tcp::resolver::passive, error);
    if (error || found.empty())
      throw Error(ExitCode::usage, "--host",
                  text(address.host, ": is no address of this machine (", error.message(),
                       "); give one, such as 127.0.0.1, or 0.0.0.0 for all"));
    const Tcp::endpoint endpoint = *found.begin();
    const auto check = [&] {
      if (!error) return;
      const bool host = error == boost::system::errc::address_not_available;
      throw Error(ExitCode::usage, host ? "--host" : "--port",
                  text(host ? address.host : std::to_string(port), ": ", error.message(),
                       host ? "; give an address of this machine"
                            : "; give another port, or 0 for any that is free"));
    };
    acceptor.open(endpoint.protocol(), error), check();
    acceptor.set_option(Tcp::acceptor::reuse_address(true), error), check();
    acceptor.bind(endpoint, error), check();
    acceptor.listen(asio::socket_base::max_listen_connections, error), check();
  }

  void accept() {
    acceptor.async_accept([this](beast::error_code error, Tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error && shared.connections < kMostConnections.most)
        std::make_shared<HttpConnection>(std::move(socket), shared)->read();
      accept();
    });
  }

  void look_for_interrupts() {
    look.expires_after(kInterruptTime);
    look.async_wait([this](beast::error_code error) {
      if (error) return;
      if (interrupted())
        io.stop();
      else
        look_for_interrupts();
    });
  }

  Shared shared;  // outlives the connections, which io holds
  asio::io_context io{1};
  Tcp::acceptor acceptor;
  asio::steady_timer look;
};

ViewServer::ViewServer(const ServerAddress& address, ServedPage page)
    : impl_(std::make_unique<Impl>(address, std::move(page))) {}

ViewServer::~ViewServer() = default;

unsigned ViewServer::port() const { return impl_->acceptor.local_endpoint().port(); }

std::string ViewServer::url() const {
  const std::string& host = impl_->shared.host;
  const bool ipv6 = host.find(':') != std::string::npos;
  return text("http://", ipv6 ? "[" : "", host, ipv6 ? "]" : "", ":", port(), "/");
}

void ViewServer::run() {
  impl_->accept();
  impl_->look_for_interrupts();
  impl_->io.run();
}

void ViewServer::stop() { impl_->io.stop(); }

}  // namespace phos::inline view
