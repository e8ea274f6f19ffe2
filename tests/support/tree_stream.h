// FLANN's saved index, its one compressed block taken out and put in.
#pragma once

#include <lz4.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace phos::test {

/// Bytes of FLANN's header, where the block's length stands in it, and the most that a block holds.
inline constexpr std::size_t kTreeHeader = 80, kTreeLength = 72, kTreeBlock = 64 * 1024;

/// What FLANN keeps behind its header; nothing if there is more than one block.
inline std::optional<std::vector<std::byte>> tree_contents(const std::vector<std::byte>& stream) {
  if (stream.size() < kTreeHeader + 8) return std::nullopt;
  std::vector<std::byte> contents(kTreeBlock);
  const int n = LZ4_decompress_safe(
      reinterpret_cast<const char*>(stream.data()) + kTreeHeader, reinterpret_cast<char*>(contents.data()),
      static_cast<int>(stream.size() - kTreeHeader - 8), static_cast<int>(kTreeBlock));
  if (n <= 0) return std::nullopt;
  contents.resize(static_cast<std::size_t>(n));
  return contents;
}

/// The same stream with other contents.
inline std::vector<std::byte> with_contents(const std::vector<std::byte>& stream,
                                            const std::vector<std::byte>& contents) {
  std::vector<std::byte> out(stream.begin(), stream.begin() + kTreeHeader);
  out.resize(kTreeHeader + static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(contents.size()))));
  const int n = LZ4_compress_default(
      reinterpret_cast<const char*>(contents.data()), reinterpret_cast<char*>(out.data()) + kTreeHeader,
      static_cast<int>(contents.size()), static_cast<int>(out.size() - kTreeHeader));
  const auto length = static_cast<std::uint64_t>(n);
  std::memcpy(out.data() + kTreeLength, &length, sizeof length);
  out.resize(kTreeHeader + static_cast<std::size_t>(n));
  out.resize(out.size() + 8);  // a length of 0
  return out;
}

}  // namespace phos::test
