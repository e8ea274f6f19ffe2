#include "photon/tree/flann_compress.h"

#define LZ4_HC_STATIC_LINKING_ONLY
#include <lz4.h>
#include <lz4hc.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>

#include "core/error.h"
#include "core/parallel.h"
#include "photon/tree/build.h"

namespace phos::inline photon {
namespace {

constexpr std::size_t kBlock = 64 * 1024;
constexpr int kLevel = 9;  // of FLANN

/// The last end of a value of a tree that is not behind a place.
class ValueEnds {
 public:
  explicit ValueEnds(std::span<const std::byte> contents) : size_(contents.size()) {
    std::uint64_t points;
    std::memcpy(&points, contents.data(), sizeof points);
    nodes_ = kTreeOrder + sizeof(std::int32_t) * static_cast<std::size_t>(points);
  }
  std::size_t last_before(std::size_t place) const {
    if (place >= size_) return size_;
    if (place <= nodes_) return place - (place - kTreeOrder) % 4;
    const std::size_t in_node = (place - nodes_) % kTreeNode;
    return place - in_node % 4;
  }

 private:
  std::size_t size_, nodes_;
};

/// Ends of the blocks; of the first the header takes its part.
std::vector<std::size_t> block_ends(std::span<const std::byte> contents, std::size_t header_bytes) {
  const ValueEnds values(contents);
  std::vector<std::size_t> ends;
  for (std::size_t end = 0; end < contents.size();) {
    end = values.last_before(end + kBlock - (end == 0 ? header_bytes : 0));
    ends.push_back(end);
  }
  return ends;
}

/// FLANN keeps two blocks in turn in the halves of one buffer. Of the bytes before a block, LZ4 then has
/// the bytes just before it in memory, or else the bytes that the block's half has not
/// overwritten. Only 64 KiB can be referred to.
class Blocks {
 public:
  Blocks(std::span<const std::byte> contents, std::size_t header_bytes)
      : contents_(contents), header_bytes_(header_bytes), ends_(block_ends(contents, header_bytes)) {}

  std::size_t count() const { return ends_.size(); }
  /// Where a block begins in the contents.
  std::size_t begin(std::size_t i) const { return i == 0 ? 0 : ends_[i - 1]; }

  /// A length (of all but the first) and a block.
  std::vector<std::byte> compressed(std::size_t i) const {
    const std::span<const std::byte> block = contents_.subspan(begin(i), size(i));
    std::vector<std::byte> before(known_before(i));
    std::memcpy(before.data(), block.data() - before.size(), before.size());
    const bool goes_on = i % 2 == 1 && is_full(i - 1);  // in FLANN's buffer, and so in `before`
    if (goes_on) {
      before.insert(before.end(), block.begin(), block.end());
      return compressed({before.data(), before.size() - block.size()},
                        before.data() + before.size() - block.size(), block.size(), i > 0);
    }
    return compressed(before, block.data(), block.size(), i > 0);
  }

 private:
  std::size_t size(std::size_t i) const { return ends_[i] - begin(i); }
  bool is_full(std::size_t i) const { return size(i) + (i == 0 ? header_bytes_ : 0) == kBlock; }

  std::size_t known_before(std::size_t i) const {
    if (i == 0) return 0;
    std::size_t known = size(i - 1);
    // The part of the earlier block that this block leaves.
    if (i % 2 == 0 && is_full(i - 2)) known += kBlock - size(i);
    return std::min(known, kBlock);
  }

  static std::vector<std::byte> compressed(std::span<const std::byte> before, const std::byte* block,
                                           std::size_t size, bool with_length) {
    const std::unique_ptr<LZ4_streamHC_t, int (*)(LZ4_streamHC_t*)> lz4(LZ4_createStreamHC(),
                                                                        LZ4_freeStreamHC);
    if (!lz4) throw std::bad_alloc();
    LZ4_resetStreamHC_fast(lz4.get(), kLevel);
    if (!before.empty())
      LZ4_loadDictHC(lz4.get(), reinterpret_cast<const char*>(before.data()),
                     static_cast<int>(before.size()));
    const std::size_t front = with_length ? sizeof(std::uint64_t) : 0;
    std::vector<std::byte> out(front + LZ4_COMPRESSBOUND(kBlock));
    const int n = LZ4_compress_HC_continue(lz4.get(), reinterpret_cast<const char*>(block),
                                           reinterpret_cast<char*>(out.data() + front),
                                           static_cast<int>(size), LZ4_COMPRESSBOUND(kBlock));
    PHOS_CHECK(n > 0, "LZ4 cannot compress ", size, " bytes");
    const auto length = static_cast<std::uint64_t>(n);
    if (with_length) std::memcpy(out.data(), &length, sizeof length);
    out.resize(front + static_cast<std::size_t>(n));
    out.shrink_to_fit();
    return out;
  }

  std::span<const std::byte> contents_;
  std::size_t header_bytes_;
  std::vector<std::size_t> ends_;
};

}  // namespace

void compress_tree(std::span<const std::byte> header, std::span<const std::byte> contents,
                   const std::function<void(std::span<const std::byte>, std::size_t)>& give) {
  const std::size_t at_a_time = std::max<std::size_t>(64, 2 * static_cast<std::size_t>(thread_count()));
  const Blocks blocks(contents, header.size());
  std::vector<std::byte> piece(header.begin(), header.end());
  std::vector<std::vector<std::byte>> compressed(at_a_time);
  for (std::size_t begin = 0; begin < blocks.count(); begin += at_a_time) {
    const std::size_t n = std::min(at_a_time, blocks.count() - begin);
    parallel_for(n, 1, [&](std::size_t i) { compressed[i] = blocks.compressed(begin + i); });
    if (begin == 0) {
      const std::uint64_t first = compressed.front().size();
      std::memcpy(piece.data() + header.size() - sizeof first, &first, sizeof first);
    }
    for (std::size_t i = 0; i < n; ++i) piece.insert(piece.end(), compressed[i].begin(), compressed[i].end());
    if (begin + n == blocks.count())
      piece.resize(piece.size() + sizeof(std::uint64_t));  // no length: the end
    give(piece, begin + n < 2 ? 0 : blocks.begin(begin + n - 2));
    piece.clear();
  }
}

std::vector<std::byte> compress_tree(std::span<const std::byte> header, std::span<const std::byte> contents) {
  std::vector<std::byte> stream;
  compress_tree(header, contents, [&](std::span<const std::byte> piece, std::size_t) {
    stream.insert(stream.end(), piece.begin(), piece.end());
  });
  return stream;
}

}  // namespace phos::inline photon
