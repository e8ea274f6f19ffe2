#include "view/static/smaller_textures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/texture/texture.h"
#include "view/message/reader.h"
#include "view/message/writer.h"

namespace phos::inline view {
namespace {

using Numbers = std::vector<std::uint32_t>;

struct Codes {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

std::uint8_t code_of(double linear, bool srgb) {
  const double shown = !srgb                 ? linear
                       : linear <= 0.0031308 ? 12.92 * linear
                                             : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;  // IEC 61966-2-1
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(shown, 0., 1.)));
}

/// One axis of an image: `to` values of the means of `from` values over even stretches. Values are `step`
/// apart.
void shrink(const double* in, std::size_t from, double* out, std::size_t to, std::size_t step) {
  const double stretch = static_cast<double>(from) / static_cast<double>(to);
  for (std::size_t i = 0; i < to; ++i) {
    const double begin = static_cast<double>(i) * stretch;
    const double end = std::min(begin + stretch, static_cast<double>(from));
    double sum = 0;
    for (auto k = static_cast<std::size_t>(begin); k < from && static_cast<double>(k) < end; ++k)
      sum += in[k * step] *
             (std::min(end, static_cast<double>(k + 1)) - std::max(begin, static_cast<double>(k)));
    out[i * step] = sum / (end - begin);
  }
}

Codes reduced(const Codes& codes, std::size_t width, std::size_t height, bool srgb) {
  Codes small{width, height, std::vector<std::uint8_t>(4 * width * height)};
  std::vector<double> whole(codes.width * codes.height), narrow(codes.width * codes.height),
      both(codes.width * codes.height);
  for (std::size_t c = 0; c < 4; ++c) {
    std::array<double, 256> linear;
    const bool curved = srgb && c < 3;
    for (int i = 0; i < 256; ++i)
      linear[static_cast<std::size_t>(i)] = static_cast<double>(decode_channel(i, 255, curved));
    for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = linear[codes.rgba[4 * i + c]];
    for (std::size_t y = 0; y < codes.height; ++y)
      shrink(&whole[y * codes.width], codes.width, &narrow[y * codes.width], width, 1);
    for (std::size_t x = 0; x < width; ++x) shrink(&narrow[x], codes.height, &both[x], height, codes.width);
    for (std::size_t y = 0; y < height; ++y)
      for (std::size_t x = 0; x < width; ++x)
        small.rgba[4 * (y * width + x) + c] = code_of(both[y * codes.width + x], curved);
  }
  return small;
}

/// Copies a field as it is.
void copy(const MessageReader& from, const MessageField& field, MessageWriter& to) {
  switch (field.type) {
    case FieldType::u8: {
      const std::string_view bytes = from.bytes(field.table, field.name);
      return to.add(field.table, field.name, std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
    }
    case FieldType::u32:
      return to.add(field.table, field.name, from.numbers(field.table, field.name));
    case FieldType::f32:
      return to.add(field.table, field.name, from.floats(field.table, field.name));
  }
}

}  // namespace

SmallerTextures with_smaller_textures(std::string_view scene_message, unsigned most_side) {
  const MessageReader scene(scene_message, MessageKind::scene);
  Numbers width = scene.numbers("texture", "width"), height = scene.numbers("texture", "height");
  Numbers first = scene.numbers("texture", "first_texel");
  const Numbers srgb = scene.numbers("texture", "srgb");
  const std::string_view all = scene.bytes("texel", "rgba");
  std::vector<std::uint8_t> rgba;
  SmallerTextures result;
  for (std::size_t i = 0; i < width.size(); ++i) {
    const std::size_t texels = std::size_t{width[i]} * height[i];
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(4 * std::size_t{first[i]});
    Codes codes{width[i], height[i], {begin, begin + static_cast<std::ptrdiff_t>(4 * texels)}};
    if (const unsigned side = std::max(width[i], height[i]); side > most_side) {
      const auto small = [&](std::size_t n) {
        return std::max<std::size_t>(1, (n * most_side + side / 2) / side);
      };
      codes = reduced(codes, small(codes.width), small(codes.height), srgb[i] != 0);
      ++result.reduced;
    }
    width[i] = static_cast<std::uint32_t>(codes.width), height[i] = static_cast<std::uint32_t>(codes.height);
    first[i] = static_cast<std::uint32_t>(rgba.size() / 4);
    rgba.insert(rgba.end(), codes.rgba.begin(), codes.rgba.end());
  }
  if (result.reduced == 0) {
    result.message = scene_message;
    return result;
  }
  MessageWriter message(MessageKind::scene);
  for (const MessageField& field : layout_of(MessageKind::scene).fields) copy(scene, field, message);
  message.add("texture", "width", width);
  message.add("texture", "height", height);
  message.add("texture", "first_texel", first);
  message.add("texel", "rgba", rgba);
  result.message = message.message();
  return result;
}

}  // namespace phos::inline view
