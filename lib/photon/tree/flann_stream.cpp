#include "photon/tree/flann_stream.h"

#include <lz4.h>

#include <new>

namespace phos::inline photon {
namespace {

constexpr std::size_t kBlockBytes = 64 * 1024;

LZ4_streamDecode_t* stream(void* lz4) { return static_cast<LZ4_streamDecode_t*>(lz4); }

}  // namespace

FlannStream::FlannStream(std::span<const std::byte> bytes, std::size_t header_bytes,
                         std::uint64_t first_block)
    : blocks_(2 * kBlockBytes), lz4_(LZ4_createStreamDecode()) {
  if (lz4_ == nullptr) throw std::bad_alloc();
  if (bytes.size() < header_bytes) throw Damaged("is truncated");
  rest_ = bytes.subspan(header_bytes);
  // Values behind the header lie behind it in the block too, so that it is so much shorter.
  decode(first_block, header_bytes);
}

FlannStream::~FlannStream() { LZ4_freeStreamDecode(stream(lz4_)); }

std::uint64_t FlannStream::next_length() {
  std::uint64_t length;
  if (rest_.size() < sizeof length) throw Damaged("is truncated");
  std::memcpy(&length, rest_.data(), sizeof length);
  rest_ = rest_.subspan(sizeof length);
  return length;
}

void FlannStream::decode(std::uint64_t length, std::size_t at) {
  if (length == 0 || length > rest_.size()) throw Damaged("is truncated");
  if (length >= LZ4_COMPRESSBOUND(kBlockBytes)) throw Damaged("has a block that is too long");
  std::byte* const to = blocks_.data() + block_ * kBlockBytes + at;
  const int n = LZ4_decompress_safe_continue(stream(lz4_), reinterpret_cast<const char*>(rest_.data()),
                                             reinterpret_cast<char*>(to), static_cast<int>(length),
                                             static_cast<int>(kBlockBytes - at));
  if (n <= 0) throw Damaged("has a block that cannot be decoded");
  at_ = block_ * kBlockBytes + at;
  end_ = at_ + static_cast<std::size_t>(n);
  rest_ = rest_.subspan(static_cast<std::size_t>(length));
}

const std::byte* FlannStream::take_bytes(std::size_t n) {
  if (n > end_ - at_) {
    if (at_ != end_) throw Damaged("has a value across blocks");
    block_ = 1 - block_;
    decode(next_length(), 0);
    if (n > end_ - at_) throw Damaged("has a value across blocks");
  }
  const std::byte* const value = blocks_.data() + at_;
  at_ += n;
  return value;
}

bool FlannStream::take_bool() {
  const auto v = take<std::uint8_t>();
  if (v > 1) throw Damaged("has a switch that is neither on nor off");
  return v == 1;
}

void FlannStream::require_end() {
  if (at_ != end_ || next_length() != 0 || !rest_.empty()) throw Damaged("goes on after its end");
}

}  // namespace phos::inline photon
