// The compressed stream that FLANN saves an index as, read without trusting it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

namespace phos::inline photon {

/// LZ4 blocks of at most 64 KiB, of which each may refer to the one before it; a length before all but the
/// first, and a length of 0 after the last. FLANN's own reader takes lengths, and ends, as they come.
class FlannStream {
 public:
  struct Damaged : std::runtime_error {
    using std::runtime_error::runtime_error;
  };

  /// `bytes` begin with a header of `header_bytes`, which is not compressed; the first block follows it.
  FlannStream(std::span<const std::byte> bytes, std::size_t header_bytes, std::uint64_t first_block);
  ~FlannStream();
  FlannStream(const FlannStream&) = delete;

  /// The next value; values never span blocks. Throws Damaged.
  template <class T>
  T take() {
    T v;
    std::memcpy(&v, take_bytes(sizeof v), sizeof v);
    return v;
  }
  /// A boolean is 0 or 1.
  bool take_bool();
  /// Throws Damaged unless all was taken and the last length is there.
  void require_end();

 private:
  const std::byte* take_bytes(std::size_t n);
  std::uint64_t next_length();
  void decode(std::uint64_t length, std::size_t at);

  std::span<const std::byte> rest_;
  std::vector<std::byte> blocks_;  // two, in turn
  std::size_t block_ = 0;          // which one
  std::size_t at_ = 0, end_ = 0;   // in blocks_
  void* lz4_;
};

}  // namespace phos::inline photon
