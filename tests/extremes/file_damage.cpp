// A damaged file is an error of one line, never a crash, and never another value.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include "core/error.h"
#include "core/random.h"
#include "file/container.h"
#include "file/inspect/inspect.h"
#include "file/layout.h"
#include "support/container.h"
#include "support/run.h"

namespace phos {
namespace {

using test::container_bytes;

/// A file in memory that Container::open can map, so that thousands of damaged versions take no time.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : fd_(::memfd_create("phos", MFD_CLOEXEC)) { set(bytes); }
  ~MemoryFile() { ::close(fd_); }
  void set(const std::string& bytes) const {
    ASSERT_EQ(::ftruncate(fd_, static_cast<off_t>(bytes.size())), 0);
    ASSERT_EQ(::pwrite(fd_, bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  void put(std::size_t at, char byte) const { ASSERT_EQ(::pwrite(fd_, &byte, 1, static_cast<off_t>(at)), 1); }
  std::string path() const { return text("/proc/self/fd/", fd_); }

 private:
  int fd_;
};

std::string sample_bytes() {
  const std::string path = test::scratch("damage") + "/a.photons";
  test::SampleColumns().writer().write(path, test::sample_provenance());
  return test::slurp(path);
}

std::size_t header_size(const std::string& bytes) {
  return phos_header_bytes(std::as_bytes(std::span(bytes.data(), bytes.size()))).size();
}

/// Everything that a reader could take from a file.
std::string contents(const std::string& path) {
  const Container file = Container::open(path);
  file.verify();
  std::string all = describe(file).dump();
  for (const auto& [name, t] : file.tensors())
    all += name + std::string(reinterpret_cast<const char*>(t.bytes.data()), t.bytes.size());
  return all;
}

enum class Outcome { refused, unharmed, wrong };

Outcome try_reading(const std::string& path, const std::string& expected) {
  try {
    return contents(path) == expected ? Outcome::unharmed : Outcome::wrong;
  } catch (const Error& e) {
    const std::string what = e.what();
    const bool good =
        e.code() == ExitCode::bad_input && e.where() == path && what.find('\n') == std::string::npos;
    return good ? Outcome::refused : Outcome::wrong;
  }
}

TEST(Damage, EveryBitOfTheHeaderIsNoticed) {
  const std::string bytes = sample_bytes();
  const MemoryFile file(bytes);
  const std::string expected = contents(file.path());
  for (std::size_t i = 0; i < header_size(bytes); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      file.put(i, static_cast<char>(bytes[i] ^ (1 << bit)));
      EXPECT_EQ(try_reading(file.path(), expected), Outcome::refused) << "byte " << i << " bit " << bit;
      file.put(i, bytes[i]);
    }
  EXPECT_EQ(try_reading(file.path(), expected), Outcome::unharmed);
}

TEST(Damage, EveryByteOfTheDataIsNoticed) {
  const std::string bytes = sample_bytes();
  const MemoryFile file(bytes);
  const std::string expected = contents(file.path());
  for (std::size_t i = header_size(bytes); i < bytes.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      file.put(i, static_cast<char>(bytes[i] ^ (1 << bit)));
      EXPECT_NO_THROW(Container::open(file.path()));
      EXPECT_EQ(try_reading(file.path(), expected), Outcome::refused) << "byte " << i << " bit " << bit;
      file.put(i, bytes[i]);
    }
}

TEST(Damage, EveryTruncationIsNoticedOnOpening) {
  const std::string bytes = sample_bytes();
  const MemoryFile file(bytes);
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    file.set(bytes.substr(0, n));
    EXPECT_THROW(Container::open(file.path()), Error) << n;
  }
  file.set(bytes + "x");
  EXPECT_THROW(Container::open(file.path()), Error);
  file.set(bytes + std::string(5000, '\0'));
  EXPECT_THROW(Container::open(file.path()), Error);
}

TEST(Damage, RandomDamageNeverGivesAnotherValue) {
  const std::string bytes = sample_bytes();
  const MemoryFile file(bytes);
  const std::string expected = contents(file.path());
  for (std::uint64_t trial = 0; trial < 20000; ++trial) {
    RandomStream random(1, Stage::test, trial);
    std::string damaged = bytes;
    const std::size_t times = 1 + random.bits() % 8;
    for (std::size_t k = 0; k < times; ++k) {
      const std::size_t at = random.bits() % damaged.size();
      const std::size_t length = random.bits() % 16;
      switch (random.bits() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random.bits());
          break;
        case 1:
          damaged[at] = "0123456789[]{},:\" "[random.bits() % 18];
          break;
        case 2:
          damaged.erase(at, length);
          break;
        default:
          damaged.insert(at, damaged.substr(random.bits() % damaged.size(), length));
          break;
      }
      if (damaged.empty()) damaged.push_back(0);
    }
    file.set(damaged);
    EXPECT_NE(try_reading(file.path(), expected), Outcome::wrong) << "trial " << trial;
  }
}

TEST(Damage, GarbageIsRefused) {
  const MemoryFile file("x");
  for (std::uint64_t trial = 0; trial < 2000; ++trial) {
    RandomStream random(2, Stage::test, trial);
    std::string garbage;
    const std::size_t n = random.bits() % 512;
    for (std::size_t i = 0; i < n; ++i) garbage += static_cast<char>(random.bits());
    file.set(trial % 2 == 0 ? garbage : container_bytes(text("{", garbage)));
    EXPECT_EQ(try_reading(file.path(), ""), Outcome::refused) << "trial " << trial;
  }
}

std::string tensor(const std::string& shape, const std::string& offsets,
                   const std::string& dtype = "\"F32\"") {
  return text("{\"dtype\":", dtype, ",\"shape\":", shape, ",\"data_offsets\":", offsets, '}');
}

std::string with_metadata(const std::string& tensors) {
  std::string header =
      text(R"({"__metadata__":{"format":"phos/photons/1"})", tensors.empty() ? "" : ",", tensors, '}');
  header.append((64 - (8 + header.size()) % 64) % 64, ' ');
  return header;
}

// Each lie about the data is refused for its own reason.
TEST(Damage, LyingHeadersAreRefused) {
  const std::string data(64, 'd');
  const std::vector<std::pair<std::string, std::string>> cases{
      {with_metadata("\"a\":" + tensor("[8]", "[0,32]") + ",\"b\":" + tensor("[8]", "[16,48]")), "overlaps"},
      {with_metadata("\"a\":" + tensor("[4]", "[0,16]") + ",\"b\":" + tensor("[8]", "[32,64]")),
       "belong to none"},
      {with_metadata("\"a\":" + tensor("[4]", "[16,32]")), "belong to none"},
      {with_metadata("\"a\":" + tensor("[4]", "[0,16]")), "too many"},
      {with_metadata("\"a\":" + tensor("[32]", "[0,128]")), "truncated"},
      {with_metadata("\"a\":" + tensor("[15]", "[0,64]")), "needs 60 bytes"},
      {with_metadata("\"a\":" + tensor("[16]", "[64,0]")), "offsets"},
      {with_metadata("\"a\":" + tensor("[4611686018427387904,4]", "[0,64]")), "larger than any memory"},
      {with_metadata("\"a\":" + tensor("[9223372036854775807,2]", "[0,64]", "\"U8\"")), "offsets"},
      {with_metadata("\"a\":" + tensor("[18446744073709551615]", "[0,64]")), "whole number"},
      {with_metadata("\"a\":" + tensor("[-16]", "[0,64]")), "whole number"},
      {with_metadata("\"a\":" + tensor("[16.0]", "[0,64]")), "whole number"},
      {with_metadata("\"a\":" + tensor("[16]", "[0,\"64\"]")), "whole number"},
      {with_metadata("\"a\":" + tensor("[16]", "[0]")), "pair"},
      {with_metadata("\"a\":" + tensor("16", "[0,64]")), "not an array"},
      {with_metadata("\"a\":" + tensor("[16]", "[0,64]", "\"F33\"")), "unknown dtype"},
      {with_metadata("\"a\":" + tensor("[16]", "[0,64]", "7")), "unknown dtype"},
      {with_metadata("\"a\":7"), "not an object"},
      {with_metadata("\"a\":{}"), "has no \"dtype\""},
      {with_metadata("\"a\":" + tensor("[1]", "[0,1]", "\"U8\"") +
                     ",\"b\":" + tensor("[63]", "[1,64]", "\"U8\"")),
       "checksums"},
      {with_metadata("\"a\":" + tensor("[2]", "[0,2]", "\"U8\"") + ",\"b\":" + tensor("[1]", "[2,6]") +
                     ",\"c\":" + tensor("[58]", "[6,64]", "\"U8\"")),
       "not aligned"},
      {with_metadata("\"a\":" + tensor("[16]", "[0,64]") + ",\"a\":" + tensor("[16]", "[0,64]")), "twice"},
      {R"({"__metadata__":{"format":7}})", "not a string"},
      {R"({"__metadata__":7})", "no JSON object"},
      {R"({"__metadata__":{"format":"phos/photons/1","counters":"{\"x\":-1}"}})", "below 0"},
      {R"({"__metadata__":{"format":"phos/photons/1","inputs":"[1]"}})", "not an object"},
      {R"({"__metadata__":{"format":"phos/photons/x"}})", "not a phos file"},
      {R"({"__metadata__":{"format":"phos/photons/-1"}})", "not a phos file"},
      {R"({"__metadata__":{"format":"phos/1"}})", "not a phos file"},
      {"{\"a\":" + std::string(100000, '['), "deeper"}};
  const MemoryFile file("x");
  for (const auto& [header, reason] : cases) {
    file.set(container_bytes(header, data));
    try {
      Container::open(file.path());
      ADD_FAILURE() << header;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_NE(std::string(e.what()).find(reason), std::string::npos) << header << "\n" << e.what();
    }
  }
}

TEST(Damage, HeaderLengthIsCapped) {
  std::string bytes = sample_bytes();
  for (const std::uint64_t length :
       {std::uint64_t{0}, kMaxHeaderBytes + 1, std::uint64_t{1} << 40, UINT64_MAX, UINT64_MAX - 7}) {
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = static_cast<char>((length >> (8 * i)) & 255);
    EXPECT_THROW(Container::open(MemoryFile(bytes).path()), Error) << length;
  }
}

}  // namespace
}  // namespace phos
