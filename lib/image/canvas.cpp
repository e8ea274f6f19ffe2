#include "image/canvas.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "core/error.h"

namespace phos::inline image {

namespace {

constexpr int kColumns = 5, kRowsOfDots = 7;

struct Glyph {
  char letter;
  std::array<std::uint8_t, 7> rows;  ///< five bits each, the left dot first
};

constexpr Glyph kGlyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 6, 8, 16, 31}},    {'3', {14, 17, 1, 6, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 4, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {',', {0, 0, 0, 0, 12, 4, 8}},
    {':', {0, 12, 12, 0, 12, 12, 0}},    {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'+', {0, 4, 4, 31, 4, 4, 0}},       {'/', {1, 1, 2, 4, 8, 16, 16}},
    {'%', {24, 25, 2, 4, 8, 19, 3}},     {'(', {2, 4, 8, 8, 8, 4, 2}},
    {')', {8, 4, 2, 2, 2, 4, 8}},        {'=', {0, 0, 31, 0, 31, 0, 0}},
    {'<', {2, 4, 8, 16, 8, 4, 2}},       {'>', {8, 4, 2, 1, 2, 4, 8}},
    {'[', {14, 8, 8, 8, 8, 8, 14}},      {']', {14, 2, 2, 2, 2, 2, 14}},
    {'^', {4, 10, 17, 0, 0, 0, 0}},      {'*', {0, 4, 21, 14, 21, 4, 0}},
    {'_', {0, 0, 0, 0, 0, 0, 31}},       {'\xb2', {12, 18, 4, 8, 30, 0, 0}},
    {'\xb0', {12, 18, 18, 12, 0, 0, 0}}, {'a', {0, 0, 14, 1, 15, 17, 15}},
    {'b', {16, 16, 22, 25, 17, 17, 30}}, {'c', {0, 0, 14, 16, 16, 17, 14}},
    {'d', {1, 1, 13, 19, 17, 17, 15}},   {'e', {0, 0, 14, 17, 31, 16, 14}},
    {'f', {6, 9, 8, 28, 8, 8, 8}},       {'g', {0, 0, 15, 17, 15, 1, 14}},
    {'h', {16, 16, 22, 25, 17, 17, 17}}, {'i', {4, 0, 12, 4, 4, 4, 14}},
    {'j', {2, 0, 6, 2, 2, 18, 12}},      {'k', {16, 16, 18, 20, 24, 20, 18}},
    {'l', {12, 4, 4, 4, 4, 4, 14}},      {'m', {0, 0, 26, 21, 21, 21, 21}},
    {'n', {0, 0, 22, 25, 17, 17, 17}},   {'o', {0, 0, 14, 17, 17, 17, 14}},
    {'p', {0, 0, 30, 17, 30, 16, 16}},   {'q', {0, 0, 15, 17, 15, 1, 1}},
    {'r', {0, 0, 22, 25, 16, 16, 16}},   {'s', {0, 0, 15, 16, 14, 1, 30}},
    {'t', {8, 8, 28, 8, 8, 9, 6}},       {'u', {0, 0, 17, 17, 17, 19, 13}},
    {'v', {0, 0, 17, 17, 17, 10, 4}},    {'w', {0, 0, 17, 17, 21, 21, 10}},
    {'x', {0, 0, 17, 10, 4, 10, 17}},    {'y', {0, 0, 17, 17, 15, 1, 14}},
    {'z', {0, 0, 31, 2, 4, 8, 31}},      {'A', {14, 17, 17, 31, 17, 17, 17}},
    {'B', {30, 17, 17, 30, 17, 17, 30}}, {'C', {14, 17, 16, 16, 16, 17, 14}},
    {'D', {30, 17, 17, 17, 17, 17, 30}}, {'E', {31, 16, 16, 30, 16, 16, 31}},
    {'F', {31, 16, 16, 30, 16, 16, 16}}, {'G', {14, 17, 16, 23, 17, 17, 15}},
    {'H', {17, 17, 17, 31, 17, 17, 17}}, {'I', {14, 4, 4, 4, 4, 4, 14}},
    {'J', {7, 2, 2, 2, 2, 18, 12}},      {'K', {17, 18, 20, 24, 20, 18, 17}},
    {'L', {16, 16, 16, 16, 16, 16, 31}}, {'M', {17, 27, 21, 21, 17, 17, 17}},
    {'N', {17, 25, 21, 19, 17, 17, 17}}, {'O', {14, 17, 17, 17, 17, 17, 14}},
    {'P', {30, 17, 17, 30, 16, 16, 16}}, {'Q', {14, 17, 17, 17, 21, 18, 13}},
    {'R', {30, 17, 17, 30, 20, 18, 17}}, {'S', {15, 16, 16, 14, 1, 1, 30}},
    {'T', {31, 4, 4, 4, 4, 4, 4}},       {'U', {17, 17, 17, 17, 17, 17, 14}},
    {'V', {17, 17, 17, 17, 17, 10, 4}},  {'W', {17, 17, 17, 21, 21, 27, 17}},
    {'X', {17, 17, 10, 4, 10, 17, 17}},  {'Y', {17, 17, 10, 4, 4, 4, 4}},
    {'Z', {31, 1, 2, 4, 8, 16, 31}},
};

const Glyph* find_glyph(char c) {
  for (const Glyph& g : kGlyphs)
    if (g.letter == c) return &g;
  return nullptr;
}

/// First byte of a Latin-1 letter in UTF-8: the second is the letter.
constexpr char kLatin = '\xc2';

/// Dots that a letter takes, without the gap after it. Punctuation is narrow.
int columns(char c) { return c == '.' || c == ',' || c == ':' ? 3 : kColumns; }

}  // namespace

Colour8 to_srgb(const Rgb& linear) {
  Colour8 out;
  for (int i = 0; i < 3; ++i) {
    const float v = std::clamp(linear[i], 0.0f, 1.0f);
    const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    out[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(255 * s + 0.5f);
  }
  return out;
}

Picture make_picture(int width, int height, const Colour8& colour) {
  PHOS_CHECK(width > 0 && height > 0, width, " x ", height);
  Picture p{width, height, {}};
  p.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < p.rgb.size(); ++i) p.rgb[i] = colour[i % 3];
  return p;
}

void set_pixel(Picture& picture, int x, int y, const Colour8& colour) {
  if (x < 0 || y < 0 || x >= picture.width || y >= picture.height) return;
  const std::size_t index =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
  std::copy(colour.begin(), colour.end(), picture.rgb.begin() + static_cast<std::ptrdiff_t>(3 * index));
}

void fill(Picture& picture, int x, int y, int width, int height, const Colour8& colour) {
  for (int j = y; j < y + height; ++j)
    for (int i = x; i < x + width; ++i) set_pixel(picture, i, j, colour);
}

void draw_text(Picture& picture, int x, int y, int dot, std::string_view text, const Colour8& colour) {
  for (const char c : text) {
    if (c == kLatin) continue;
    const int first = (kColumns - columns(c)) / 2;
    if (const Glyph* g = find_glyph(c))
      for (int row = 0; row < kRowsOfDots; ++row)
        for (int column = 0; column < kColumns; ++column)
          if ((g->rows[static_cast<std::size_t>(row)] >> (kColumns - 1 - column)) & 1)
            fill(picture, x + (column - first) * dot, y + row * dot, dot, dot, colour);
    x += (columns(c) + 1) * dot;
  }
}

int text_width(std::string_view text, int dot) {
  int width = 0;
  for (const char c : text) width += c == kLatin ? 0 : (columns(c) + 1) * dot;
  return std::max(0, width - dot);
}

int text_height(int dot) { return kRowsOfDots * dot; }

std::string text_for_picture(std::string unit) {
  for (std::size_t at = unit.find("m2"); at != std::string::npos; at = unit.find("m2", at))
    unit.replace(at, 2, "m\xb2");
  return unit;
}

}  // namespace phos::inline image
