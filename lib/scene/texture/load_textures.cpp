#include "scene/texture/load_textures.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.h"
#include "core/parallel.h"
#include "file/lfs_pointer.h"
#include "scene/limits.h"
#include "scene/texture/texture.h"

namespace phos::inline scene {
namespace {

/// A byte holds no more than this (PNG: a bit a pixel, deflated 1032-fold); decoders would fill the rest of a
/// file that is cut off.
constexpr std::int64_t kPixelsPerByte = 8256, kPixelsOfAnyFile = 1 << 20;

struct Size {
  std::int64_t width = 0, height = 0;
};

std::int64_t big_endian(const unsigned char* p, int n) {
  std::int64_t v = 0;
  for (int i = 0; i < n; ++i) v = v << 8 | p[i];
  return v;
}

std::int64_t little_endian(const unsigned char* p, int n) {
  std::int64_t v = 0;
  for (int i = n - 1; i >= 0; --i) v = v << 8 | p[i];
  return v;
}

Size jpeg_size(const unsigned char* p, std::size_t n) {
  std::size_t at = 2;
  while (at + 9 < n) {
    if (p[at] != 0xff) return {};
    const unsigned char marker = p[at + 1];
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) return {big_endian(p + at + 7, 2), big_endian(p + at + 5, 2)};
    at += 2 + static_cast<std::size_t>(big_endian(p + at + 2, 2));
  }
  return {};
}

/// Does a PNG hold the bytes that its chunks state? The decoder takes memory for them before it looks.
bool holds_its_chunks(const std::string& bytes) {
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    if (std::memcmp(p + at + 4, "IEND", 4) == 0) return true;
    const auto length = static_cast<std::size_t>(static_cast<std::uint32_t>(big_endian(p + at, 4)));
    if (length > bytes.size() - at - 8) return false;
    at += 12 + length;
  }
  return true;
}

/// Size by the header alone, before a decoder allocates for it; zero for unknown formats.
Size header_size(const std::string& bytes) {
  const auto* p = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t n = bytes.size();
  if (n >= 24 && std::memcmp(p, "\x89PNG\r\n\x1a\n", 8) == 0)
    return {big_endian(p + 16, 4), big_endian(p + 20, 4)};
  if (n >= 4 && p[0] == 0xff && p[1] == 0xd8) return jpeg_size(p, n);
  if (n >= 26 && p[0] == 'B' && p[1] == 'M') {
    return {little_endian(p + 18, 4), std::abs(static_cast<std::int32_t>(little_endian(p + 22, 4)))};
  }
  const bool targa =
      n >= 18 && p[1] <= 1 && (p[2] == 1 || p[2] == 2 || p[2] == 3 || (p[2] >= 9 && p[2] <= 11));
  if (targa) return {little_endian(p + 12, 2), little_endian(p + 14, 2)};
  return {};
}

void fill_texels(const std::vector<unsigned char>& bytes, bool srgb, std::vector<Vec4>& texels) {
  constexpr int kLargest = 0xffff;
  std::vector<float> colour(kLargest + 1);
  for (int i = 0; i <= kLargest; ++i) colour[static_cast<std::size_t>(i)] = decode_channel(i, kLargest, srgb);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    std::array<std::uint16_t, 4> c;
    std::memcpy(c.data(), bytes.data() + i * sizeof c, sizeof c);
    texels[i] = {colour[c[0]], colour[c[1]], colour[c[2]], decode_channel(c[3], kLargest, false)};
  }
}

/// Empty if it worked; else why not.
std::string decode_image(const std::string& bytes, bool srgb, Texture& texture) {
  if (is_lfs_pointer(bytes)) return text("is ", kLfsPointer);
  const Size size = header_size(bytes);
  if (size.width <= 0 || size.height <= 0) return "is neither PNG, JPEG, BMP nor TGA";
  if (std::max(size.width, size.height) > kMostTextureSide.most ||
      size.width * size.height > kMostTexturePixels.most) {
    return text("has ", size.width, " x ", size.height, " pixels, which is too large");
  }
  if (size.width * size.height > kPixelsOfAnyFile + kPixelsPerByte * static_cast<std::int64_t>(bytes.size()))
    return text("is too short for ", size.width, " x ", size.height, " pixels");
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) return "is larger than 2 GiB";
  if (bytes.starts_with("\x89PNG") && !holds_its_chunks(bytes)) return "is cut off, or damaged";
  tinygltf::Image image;
  std::string error, warning;
  const bool read = tinygltf::LoadImageData(&image, 0, &error, &warning, 0, 0,
                                            reinterpret_cast<const unsigned char*>(bytes.data()),
                                            static_cast<int>(bytes.size()), nullptr);
  if (!read || image.width <= 0 || image.height <= 0 || image.component != 4) return "cannot be decoded";
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::size_t code = image.bits == 16 ? 2 : 1;
  if (image.image.size() < pixels * 4 * code) return "cannot be decoded";
  texture.width = image.width;
  texture.height = image.height;
  if (code == 2) {
    texture.texels.resize(pixels);
    fill_texels(image.image, srgb, texture.texels);
  } else {
    texture.srgb = srgb;
    texture.codes.resize(pixels);
    std::memcpy(texture.codes.data(), image.image.data(), pixels * sizeof(Texture::Code));
  }
  return "";
}

void remap(TextureUse& use, const std::vector<std::int32_t>& place) {
  if (use.used()) use.texture = place[static_cast<std::size_t>(use.texture)];
}

}  // namespace

std::int32_t TexturePool::add(const std::string& key, const std::string& name, std::string bytes,
                              const std::string& missing, const Sampling& sampling, bool srgb) {
  const std::string full = key + (srgb ? " srgb" : " linear");
  if (const auto it = known_.find(full); it != known_.end()) return it->second;
  const auto index = static_cast<std::int32_t>(requests_.size());
  requests_.push_back({name, std::move(bytes), missing, sampling, srgb});
  known_.emplace(full, index);
  return index;
}

std::vector<std::int32_t> TexturePool::decode(Scene& scene) {
  std::vector<Texture> decoded(requests_.size());
  std::vector<std::string> problem(requests_.size());
  parallel_for(requests_.size(), 1, [&](std::size_t i) {
    const Request& request = requests_[i];
    Texture& texture = decoded[i];
    texture.name = request.name;
    texture.wrap_u = request.sampling.wrap_u;
    texture.wrap_v = request.sampling.wrap_v;
    texture.nearest = request.sampling.nearest;
    problem[i] =
        request.missing.empty() ? decode_image(request.bytes, request.srgb, texture) : request.missing;
  });
  std::vector<std::int32_t> place(requests_.size(), -1);
  for (std::size_t i = 0; i < requests_.size(); ++i) {
    if (problem[i].empty()) {
      place[i] = static_cast<std::int32_t>(scene.texture.size());
      scene.texture.push_back(std::move(decoded[i]));
    } else {
      scene.warnings.emplace_back(Note::Level::warning, kTextureNotFound, "texture", requests_[i].name,
                                  problem[i] + "; the factor of the material is used");
    }
  }
  for (Material& m : scene.material) {
    for (TextureUse* use : m.texture_uses()) remap(*use, place);
  }
  return place;
}

}  // namespace phos::inline scene
