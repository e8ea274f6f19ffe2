// The compressed stream that FLANN saves an index as, written by all threads.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace phos::inline photon {

/// The stream that FLANN's SaveArchive writes, byte for byte with the same LZ4: its header, whose last 8
/// bytes become the length of the first block, then `contents` in blocks (flann_stream.h), each compressed as
/// if after all before it. `contents` are the bytes that build_tree() returns; values do not span blocks.
/// Throws std::bad_alloc.
std::vector<std::byte> compress_tree(std::span<const std::byte> header, std::span<const std::byte> contents);

/// The same in pieces, one after another: give(piece, done), where the first `done` bytes of the contents are
/// not needed any more.
void compress_tree(std::span<const std::byte> header, std::span<const std::byte> contents,
                   const std::function<void(std::span<const std::byte>, std::size_t)>& give);

}  // namespace phos::inline photon
