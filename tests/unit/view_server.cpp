// The server of phos-view: its files and nothing else, to its own page and to no other.
#include "view/server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

#include "support/complaint.h"
#include "view/limits.h"
#include "view/request_origin.h"

namespace phos {
namespace {

constexpr const char* kData = "\0data\xff";

/// A server of "/" and "/data" in a thread of its own. It answers "ask" by "answer", and refuses all else.
class Served {
 public:
  Served() : server_({"127.0.0.1", 0}, {find, answer}), thread_([this] { server_.run(); }) {}
  ~Served() {
    server_.stop();
    thread_.join();
  }
  const ViewServer& server() const { return server_; }

 private:
  static std::optional<ServedFile> find(std::string_view path) {
    if (path == "/") return ServedFile{"text/html", "<p>page"};
    if (path == "/data") return ServedFile{"application/octet-stream", {kData, 6}};
    return std::nullopt;
  }
  static std::string answer(std::string_view message) {
    if (message == "ask") return "answer";
    throw Error(ExitCode::bad_input, "", "no question");
  }
  ViewServer server_;
  std::thread thread_;
};

class Client {
 public:
  explicit Client(const ViewServer& server) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server.port()));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    const timeval patience{20, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~Client() { ::close(socket_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

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

std::string get(const ViewServer& server, const std::string& path, const std::string& host = "localhost",
                const std::string& method = "GET") {
  const Client client(server);
  client.send(text(method, " ", path, " HTTP/1.1\r\nHost: ", host, "\r\nConnection: close\r\n\r\n"));
  return client.read_all();
}

bool has(const std::string& s, const std::string& part) { return s.find(part) != std::string::npos; }
int status(const std::string& response) {
  return response.size() > 12 ? std::stoi(response.substr(9, 3)) : 0;
}

std::string handshake(const std::string& origin) {
  return text("GET /socket HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n",
              "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n", origin, "\r\n");
}

/// A frame of a client, masked by zeros. `kind`: 1 text, 2 binary.
std::string frame(std::string_view bytes, int kind) {
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

TEST(ViewServer, ServesItsFiles) {
  const Served served;
  const std::string page = get(served.server(), "/");
  EXPECT_EQ(status(page), 200);
  EXPECT_TRUE(has(page, "Content-Type: text/html\r\n") && page.ends_with("\r\n\r\n<p>page")) << page;
  EXPECT_TRUE(get(served.server(), "/data?bench").ends_with(std::string("\r\n\r\n") + std::string(kData, 6)));
  const std::string head = get(served.server(), "/", "localhost", "HEAD");
  EXPECT_TRUE(has(head, "Content-Length: 7\r\n") && head.ends_with("\r\n\r\n")) << head;
}

TEST(ViewServer, KeepsConnections) {
  const Served served;
  const Client client(served.server());
  for (int i = 0; i < 3; ++i) {
    client.send("GET / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n\r\n");
    EXPECT_EQ(status(client.read_to("<p>page")), 200);
  }
}

TEST(ViewServer, ServesNothingElse) {
  const Served served;
  for (const char* path : {"/x", "/../etc/passwd", "//etc/passwd", "/data/", "/%64ata", "*", "/socket"})
    EXPECT_EQ(status(get(served.server(), path)), 404) << path;
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE"})
    EXPECT_EQ(status(get(served.server(), "/", "localhost", method)), 405) << method;
  const std::string page = get(served.server(), "/");
  EXPECT_FALSE(has(page, "Access-Control-")) << page;
  EXPECT_TRUE(has(page, "Cross-Origin-Resource-Policy: same-origin")) << page;
}

TEST(ViewServer, RefusesOtherNames) {
  const Served served;
  for (const char* host : {"evil.example", "localhost.evil.example", "", "127.0.0.1.evil.example:8080"})
    EXPECT_EQ(status(get(served.server(), "/", host)), 403) << host;
  const Client client(served.server());
  client.send("GET / HTTP/1.0\r\n\r\n");
  EXPECT_EQ(status(client.read_all()), 403);
}

TEST(ViewServer, SurvivesWhatIsNoRequest) {
  const Served served;
  for (const std::string& bytes :
       {std::string("\r\n\r\n\0\xff garbage\r\n\r\n", 19), "GET / HTTP/1.1\r\nX: " + std::string(20000, 'x'),
        std::string("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\n")}) {
    const Client client(served.server());
    client.send(bytes);
    EXPECT_GE(status(client.read_to("\r\n")), 400) << bytes.substr(0, 40);
  }
  EXPECT_EQ(status(get(served.server(), "/")), 200);
}

TEST(ViewServer, AnswersMessages) {
  const Served served;
  const Client first(served.server()), second(served.server());
  for (const Client* client : {&first, &second}) {
    client->send(handshake("Origin: http://localhost\r\n"));
    EXPECT_EQ(status(client->read_to("\r\n\r\n")), 101);
  }
  for (int i = 0; i < 3; ++i)
    for (const Client* client : {&first, &second}) {
      client->send(frame("ask", 2));
      EXPECT_EQ(client->read(8),
                "\x82\x06"
                "answer");
    }
}

TEST(ViewServer, BadMessagesEndTheirConnectionAlone) {
  const Served served;
  const Client good(served.server());
  good.send(handshake(""));
  good.read_to("\r\n\r\n");
  for (const std::string& bad : {frame("nonsense", 2), frame("ask", 1), frame("", 2),
                                 frame(std::string(kMostQuestionBytes.as<std::size_t>() + 1, 'x'), 2),
                                 std::string("\x82\x03"
                                             "ask")}) {  // not masked
    const Client client(served.server());
    client.send(handshake(""));
    client.read_to("\r\n\r\n");
    client.send(bad);
    EXPECT_EQ(client.read(1), "\x88") << "a frame that closes";
    good.send(frame("ask", 2));
    EXPECT_EQ(good.read(8),
              "\x82\x06"
              "answer");
  }
}

TEST(ViewServer, RefusesSocketsOfOtherPages) {
  const Served served;
  for (const char* origin :
       {"Origin: http://evil.example\r\n", "Origin: null\r\n", "Origin: https://localhost\r\n"}) {
    const Client client(served.server());
    client.send(handshake(origin));
    EXPECT_EQ(status(client.read_to("\r\n")), 403) << origin;
  }
}

TEST(ViewServer, ManyConnections) {
  const Served served;
  std::vector<std::unique_ptr<Client>> clients;
  for (std::int64_t i = 0; i < kMostConnections.most; ++i) {
    clients.push_back(std::make_unique<Client>(served.server()));
    clients.back()->send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(status(clients.back()->read_to("<p>page")), 200);
  }
  EXPECT_EQ(Client(served.server()).read_all(), "");
  clients.pop_back();
  for (int tries = 0; tries < 100 && status(get(served.server(), "/")) != 200; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(status(get(served.server(), "/")), 200);
}

TEST(ViewServer, SaysThatAPortIsTaken) {
  const Served served;
  const std::string said = test::complaint_of(
      [&] {
        ViewServer({"127.0.0.1", served.server().port()}, {});
      },
      ExitCode::usage);
  EXPECT_TRUE(said.starts_with("--port: ") && has(said, "another port")) << said;
  EXPECT_TRUE(has(test::complaint_of([] { ViewServer({"203.0.113.7", 0}, {}); }, ExitCode::usage), "--host"));
  EXPECT_TRUE(has(test::complaint_of(
                      [] {
                        ViewServer({"no such host", 0}, {});
                      },
                      ExitCode::usage),
                  "--host"));
}

TEST(ViewServer, TellsItsAddress) {
  const Served served;
  EXPECT_EQ(served.server().url(), text("http://127.0.0.1:", served.server().port(), "/"));
}

TEST(RequestOrigin, Names) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "192.168.1.20:80", "localhost", "LocalHost:1",
                           "[::1]", "[::1]:8080", "[fe80::1]:65535", "studio.local", "Studio.Local:8080"})
    EXPECT_TRUE(names_this_server(host, "studio.local")) << host;
  for (const char* host :
       {"", ":8080", "1.2.3", "1.2.3.4.5", "1.2.3.4x", "1.2..4", "1234.1.1.1", "0x7f.1.1.1", "localhost.",
        "localhost:80x", "localhost:123456", "localhost:", "[::1", "[]", "[localhost]", "[::1]x",
        "evil.example", "studio.local.evil.example", "a@localhost"})
    EXPECT_FALSE(names_this_server(host, "studio.local")) << host;
  EXPECT_FALSE(names_this_server("", ""));
}

TEST(RequestOrigin, Origins) {
  EXPECT_TRUE(is_same_origin(std::nullopt, "localhost:8080"));
  EXPECT_TRUE(is_same_origin("http://localhost:8080", "localhost:8080"));
  for (const char* origin : {"", "null", "http://localhost", "http://localhost:80801",
                             "https://localhost:8080", "http://evil.example"})
    EXPECT_FALSE(is_same_origin(origin, "localhost:8080")) << origin;
}

}  // namespace
}  // namespace phos
