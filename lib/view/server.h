// A server of one page and its data, over HTTP and WebSocket.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace phos::inline view {

/// What GET of a path returns.
struct ServedFile {
  std::string_view type;   ///< of its content: "text/html; charset=utf-8"
  std::string_view bytes;  ///< live as long as the server
};

/// Called in the thread of run(), one call at a time.
struct ServedPage {
  /// The file of an absolute path without a query ("/", "/view.js"); nothing: there is none.
  std::function<std::optional<ServedFile>(std::string_view path)> file;
  /// The answer to a binary message of a WebSocket. An Error that it throws ends that connection alone.
  std::function<std::string(std::string_view message)> answer;
};

struct ServerAddress {
  std::string host = "127.0.0.1";  ///< numeric, or a name of this machine
  std::int64_t port = 8080;        ///< 0: any free one
};

/// GET and HEAD of files, and a WebSocket at /socket. Every other path is "404 Not Found". Requests whose
/// Host header does not name this server, and WebSockets that a page of another origin opens, are "403
/// Forbidden". Responses forbid other sites to use them (no CORS).
class ViewServer {
 public:
  /// Listens. Throws Error(usage) for a host that is no address of this machine, and for a port that another
  /// program has or that this user may not have.
  ViewServer(const ServerAddress& address, ServedPage page);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  unsigned port() const;
  /// "http://127.0.0.1:8080/"
  std::string url() const;
  /// Serves until stop() is called or the program is interrupted (core/interrupt.h).
  void run();
  /// From any thread.
  void stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline view
