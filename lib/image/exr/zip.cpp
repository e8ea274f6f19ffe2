#include "image/exr/zip.h"

#include <ImfVersion.h>
#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "core/parallel.h"
#include "image/exr/memory.h"

namespace phos::inline image {
namespace {

/// Layers of floats hardly shrink by more effort (a Cornell box: 0.2 to 0.5 % by half again the time).
constexpr int kLevel = 1;
constexpr int kBlockLines = 16;
constexpr std::size_t kLongName = 32;  // with its end; longer ones are flagged

using Bytes = std::vector<unsigned char>;

struct FreeCompressor {
  void operator()(libdeflate_compressor* c) const { libdeflate_free_compressor(c); }
};

/// Lines of a block: of each line, the channels by name.
Bytes gather(const Image& image, int first, int lines) {
  const auto width = static_cast<std::size_t>(image.width());
  const std::size_t row = width * sizeof(float);
  Bytes block(static_cast<std::size_t>(lines) * image.channels().size() * row);
  unsigned char* to = block.data();
  for (int y = first; y < first + lines; ++y)
    for (const auto& [name, values] : image.channels()) {
      std::memcpy(to, values.data() + static_cast<std::size_t>(y) * width, row);
      to += row;
    }
  return block;
}

/// The even bytes and then the odd ones, of which there are as many; each as its difference to the one before
/// it, plus 128.
Bytes predicted(const Bytes& block) {
  const std::size_t half = block.size() / 2;
  Bytes apart(block.size()), differences(block.size());
  for (std::size_t i = 0; i < half; ++i) apart[i] = block[2 * i], apart[half + i] = block[2 * i + 1];
  differences[0] = apart[0];
  for (std::size_t i = 1; i < apart.size(); ++i)
    differences[i] = static_cast<unsigned char>(apart[i] - apart[i - 1] + 128);
  return differences;
}

Bytes deflated(Bytes block) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kLevel));
  if (!compressor) throw std::bad_alloc();
  const Bytes differences = predicted(block);
  Bytes smaller(block.size() - 1);  // a result that does not fit is not smaller
  const std::size_t size = libdeflate_zlib_compress(compressor.get(), differences.data(), differences.size(),
                                                    smaller.data(), smaller.size());
  if (size == 0) return block;
  smaller.resize(size);
  return smaller;
}

template <class Number>
void append(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);  // little-endian, as this machine is
  bytes.append(raw, sizeof value);
}

bool has_long_name(const Imf::Header& header, const Image& image) {
  bool found = std::any_of(image.channels().begin(), image.channels().end(),
                           [](const auto& c) { return c.first.size() >= kLongName; });
  for (auto a = header.begin(); a != header.end(); ++a)
    found = found || std::max(std::strlen(a.name()), std::strlen(a.attribute().typeName())) >= kLongName;
  return found;
}

std::string head(const Imf::Header& header, const Image& image) {
  std::string bytes;
  append(bytes, std::int32_t{Imf::MAGIC});
  append(bytes, std::int32_t{Imf::EXR_VERSION | (has_long_name(header, image) ? Imf::LONG_NAMES_FLAG : 0)});
  MemoryExrOut attributes;
  header.writeTo(attributes);
  return bytes + attributes.take();
}

}  // namespace

std::string encode_zip_exr(const Imf::Header& header, const Image& image) {
  header.sanityCheck();
  std::vector<Bytes> block(static_cast<std::size_t>((image.height() + kBlockLines - 1) / kBlockLines));
  const auto first_line = [](std::size_t i) { return static_cast<int>(i) * kBlockLines; };
  parallel_for(block.size(), 1, [&](std::size_t i) {
    const int lines = std::min(kBlockLines, image.height() - first_line(i));
    block[i] = deflated(gather(image, first_line(i), lines));
  });
  std::string file = head(header, image);
  std::uint64_t at = file.size() + block.size() * sizeof(std::uint64_t);
  std::uint64_t end = at;
  for (const Bytes& b : block) end += 2 * sizeof(std::int32_t) + b.size();
  file.reserve(end);
  for (const Bytes& b : block) {
    append(file, at);
    at += 2 * sizeof(std::int32_t) + b.size();
  }
  for (std::size_t i = 0; i < block.size(); ++i) {
    append(file, static_cast<std::int32_t>(first_line(i)));
    append(file, static_cast<std::int32_t>(block[i].size()));
    file.append(reinterpret_cast<const char*>(block[i].data()), block[i].size());
    block[i] = {};
  }
  return file;
}

}  // namespace phos::inline image
