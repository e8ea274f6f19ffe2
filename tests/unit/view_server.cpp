// The server of phos-view: its files and nothing else, to its own page and to no other.
#include "view/server.h"

#include <gtest/gtest.h>

#include <thread>

#include "support/complaint.h"
#include "support/http_client.h"
#include "view/limits.h"
#include "view/request_origin.h"

namespace phos {
namespace {

using test::frame;
using test::get;
using test::handshake;
using test::has;
using test::HttpClient;
using test::status;

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

TEST(ViewServer, ServesItsFiles) {
  const Served served;
  const std::string page = get(served.server().port(), "/");
  EXPECT_EQ(status(page), 200);
  EXPECT_TRUE(has(page, "Content-Type: text/html\r\n") && page.ends_with("\r\n\r\n<p>page")) << page;
  EXPECT_TRUE(
      get(served.server().port(), "/data?bench").ends_with(std::string("\r\n\r\n") + std::string(kData, 6)));
  const std::string head = get(served.server().port(), "/", "localhost", "HEAD");
  EXPECT_TRUE(has(head, "Content-Length: 7\r\n") && head.ends_with("\r\n\r\n")) << head;
}

TEST(ViewServer, KeepsConnections) {
  const Served served;
  const HttpClient client(served.server().port());
  for (int i = 0; i < 3; ++i) {
    client.send("GET / HTTP/1.1\r\nHost: 127.0.0.1:8080\r\n\r\n");
    EXPECT_EQ(status(client.read_to("<p>page")), 200);
  }
}

TEST(ViewServer, ServesNothingElse) {
  const Served served;
  for (const char* path : {"/x", "/../etc/passwd", "//etc/passwd", "/data/", "/%64ata", "*", "/socket"})
    EXPECT_EQ(status(get(served.server().port(), path)), 404) << path;
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE"})
    EXPECT_EQ(status(get(served.server().port(), "/", "localhost", method)), 405) << method;
  const std::string page = get(served.server().port(), "/");
  EXPECT_FALSE(has(page, "Access-Control-")) << page;
  EXPECT_TRUE(has(page, "Cross-Origin-Resource-Policy: same-origin")) << page;
}

TEST(ViewServer, RefusesOtherNames) {
  const Served served;
  for (const char* host : {"evil.example", "localhost.evil.example", "", "127.0.0.1.evil.example:8080"})
    EXPECT_EQ(status(get(served.server().port(), "/", host)), 403) << host;
  const HttpClient client(served.server().port());
  client.send("GET / HTTP/1.0\r\n\r\n");
  EXPECT_EQ(status(client.read_all()), 403);
}

TEST(ViewServer, SurvivesWhatIsNoRequest) {
  const Served served;
  for (const std::string& bytes :
       {std::string("\r\n\r\n\0\xff garbage\r\n\r\n", 19), "GET / HTTP/1.1\r\nX: " + std::string(20000, 'x'),
        std::string("POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 99999999\r\n\r\n")}) {
    const HttpClient client(served.server().port());
    client.send(bytes);
    EXPECT_GE(status(client.read_to("\r\n")), 400) << bytes.substr(0, 40);
  }
  EXPECT_EQ(status(get(served.server().port(), "/")), 200);
}

TEST(ViewServer, AnswersMessages) {
  const Served served;
  const HttpClient first(served.server().port()), second(served.server().port());
  for (const HttpClient* client : {&first, &second}) {
    client->send(handshake("Origin: http://localhost\r\n"));
    EXPECT_EQ(status(client->read_to("\r\n\r\n")), 101);
  }
  for (int i = 0; i < 3; ++i)
    for (const HttpClient* client : {&first, &second}) {
      client->send(frame("ask", 2));
      EXPECT_EQ(client->read(8),
                "\x82\x06"
                "answer");
    }
}

TEST(ViewServer, BadMessagesEndTheirConnectionAlone) {
  const Served served;
  const HttpClient good(served.server().port());
  good.send(handshake(""));
  good.read_to("\r\n\r\n");
  for (const std::string& bad : {frame("nonsense", 2), frame("ask", 1), frame("", 2),
                                 frame(std::string(kMostQuestionBytes.as<std::size_t>() + 1, 'x'), 2),
                                 std::string("\x82\x03"
                                             "ask")}) {  // not masked
    const HttpClient client(served.server().port());
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
    const HttpClient client(served.server().port());
    client.send(handshake(origin));
    EXPECT_EQ(status(client.read_to("\r\n")), 403) << origin;
  }
}

TEST(ViewServer, ManyConnections) {
  const Served served;
  std::vector<std::unique_ptr<HttpClient>> clients;
  for (std::int64_t i = 0; i < kMostConnections.most; ++i) {
    clients.push_back(std::make_unique<HttpClient>(served.server().port()));
    clients.back()->send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_EQ(status(clients.back()->read_to("<p>page")), 200);
  }
  EXPECT_EQ(HttpClient(served.server().port()).read_all(), "");
  clients.pop_back();
  for (int tries = 0; tries < 100 && status(get(served.server().port(), "/")) != 200; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(status(get(served.server().port(), "/")), 200);
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
