// Requests to a server of this machine, byte by byte.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <string_view>

#include "core/error.h"

namespace phos::test {

class HttpClient {
 public:
  explicit HttpClient(unsigned port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    const timeval patience{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~HttpClient() { ::close(socket_); }
  HttpClient(const HttpClient&) = delete;
  HttpClient& operator=(const HttpClient&) = delete;

  void send(std::string_view bytes) const {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
  }
  /// Up to `end`, or to the end of the connection.
  std::string read_to(std::string_view end) const {
    std::string s;
    char c = 0;
    while ((end.empty() || !s.ends_with(end)) && ::recv(socket_, &c, 1, 0) == 1) s += c;
    return s;
  }
  std::string read_all() const { return read_to(""); }
  std::string read(std::size_t bytes) const {
    std::string s;
    char c = 0;
    while (s.size() < bytes && ::recv(socket_, &c, 1, 0) == 1) s += c;
    return s;
  }

 private:
  int socket_;
};

inline std::string get(unsigned port, const std::string& path, const std::string& host = "localhost",
                       const std::string& method = "GET") {
  const HttpClient client(port);
  client.send(text(method, " ", path, " HTTP/1.1\r\nHost: ", host, "\r\nConnection: close\r\n\r\n"));
  return client.read_all();
}

inline bool has(const std::string& s, const std::string& part) { return s.find(part) != std::string::npos; }
inline int status(const std::string& response) {
  return response.size() > 12 ? std::stoi(response.substr(9, 3)) : 0;
}

inline std::string handshake(const std::string& origin) {
  return text("GET /socket HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n",
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n", origin, "\r\n");
}

/// A frame of a client, masked by zeros. `kind`: 1 text, 2 binary.
inline std::string frame(std::string_view bytes, int kind) {
  std::string s(1, static_cast<char>(0x80 | kind));
  if (bytes.size() < 126) {
    s += static_cast<char>(0x80 | bytes.size());
  } else {
    s += static_cast<char>(0x80 | 126);
    s += static_cast<char>(bytes.size() >> 8);
    s += static_cast<char>(bytes.size() & 255);
  }
  return s + std::string(4, '\0') + std::string(bytes);
}

}  // namespace phos::test
