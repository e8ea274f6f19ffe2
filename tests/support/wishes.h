// Wishes of a page to a phos-view that serves, byte by byte.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "support/http_client.h"

namespace phos::test {

/// A page that asks for records at points.
class WishingPage {
 public:
  explicit WishingPage(unsigned port) : client_(port) {
    const std::string format = get(port, "/format.json");
    const std::string key = "\"version\":";
    version_ = static_cast<std::uint16_t>(std::stoul(format.substr(format.find(key) + key.size())));
    client_.send(handshake(""));
    EXPECT_EQ(status(client_.read_to("\r\n\r\n")), 101);
  }

  /// Rows of position and normal.
  using Points = std::vector<std::vector<float>>;

  std::string wish(const Points& position, const Points& normal, bool save = false) const {
    const std::uint64_t one = 1;
    std::string s;
    for (const std::string& value :
         {bytes(std::uint32_t{0}), bytes(1.f), bytes(std::uint32_t{save ? 1u : 0u})})
      s += bytes(one) + value + std::string(4, '\0');
    for (const Points* points : {&position, &normal}) {
      s += bytes(std::uint64_t{points->size()});
      for (const std::vector<float>& p : *points)
        for (const float v : p) s += bytes(v);
      s.resize((s.size() + 7) / 8 * 8, '\0');
    }
    return "phov" + bytes(version_) + bytes(std::uint16_t{5}) + bytes(std::uint64_t{s.size() + 16}) + s;
  }

  struct Answer {
    std::uint32_t state = 0, waiting = 0, records = 0, saves = 0;
  };
  Answer ask(const std::string& wish) const {
    client_.send(frame(wish, 2));
    const std::string answer = read();
    if (answer.size() < 16 + 7 * 16) return {};
    const auto field = [&](std::size_t k) {
      return number<std::uint32_t>(answer.substr(16 + 16 * k + 8, 4));
    };
    return {field(2), field(3), field(4), field(5)};
  }
  /// Asks until nothing waits, and until the file has been written so often.
  Answer settle(const std::string& first, std::uint32_t saves = 0) const {
    Answer answer = ask(first);
    for (int tries = 0; tries < 3000 && (answer.waiting > 0 || answer.saves < saves); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      answer = ask(wish({}, {}));
    }
    EXPECT_EQ(answer.waiting, 0u);
    return answer;
  }
  const HttpClient& client() const { return client_; }

 private:
  template <class T>
  static std::string bytes(const T& value) {
    return {reinterpret_cast<const char*>(&value), sizeof value};
  }
  template <class T>
  static T number(const std::string& bytes) {
    T value{};
    if (bytes.size() == sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  /// The next message of the server, which may come in several frames.
  std::string read() const {
    std::string message;
    for (bool last = false; !last;) {
      const std::string head = client_.read(2);
      if (head.size() < 2 || (head[0] & 0x0f) != (message.empty() ? 2 : 0)) {
        ADD_FAILURE() << "no frame of a message";
        return "";
      }
      last = (head[0] & 0x80) != 0;
      std::size_t size = static_cast<unsigned char>(head[1]);
      if (size > 125) {
        const std::string length = client_.read(size == 126 ? 2 : 8);
        size = 0;
        for (const char c : length) size = size << 8 | static_cast<unsigned char>(c);
      }
      message += client_.read(size);
    }
    return message;
  }

  HttpClient client_;
  std::uint16_t version_ = 0;
};

}  // namespace phos::test
