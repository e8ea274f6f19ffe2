#include "image/png.h"

#include <png.h>

#include "core/error.h"

namespace phos::inline image {

namespace {

/// libpng's simplified reader, freed whatever happens.
struct Reader {
  png_image image{};
  Reader() { image.version = PNG_IMAGE_VERSION; }
  ~Reader() { png_image_free(&image); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

[[noreturn]] void damaged(const std::string& where, const std::string& why) {
  throw Error(ExitCode::bad_input, where, "damaged or truncated PNG file (" + why + "); make it again");
}

}  // namespace

Picture decode_png(std::string_view bytes, const std::string& where) {
  Reader reader;
  png_image& png = reader.image;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) damaged(where, png.message);
  // One bit a pixel, deflated 1032-fold, is the best that the format can do.
  if (std::uint64_t{png.width} * png.height > (1u << 22) + 8256 * std::uint64_t{bytes.size()})
    damaged(where, text("too short for ", png.width, " x ", png.height, " pixels"));
  png.format = PNG_FORMAT_RGB;
  Picture picture{static_cast<int>(png.width), static_cast<int>(png.height), {}};
  picture.rgb.resize(PNG_IMAGE_SIZE(png));
  const png_color black{};
  if (png_image_finish_read(&png, &black, picture.rgb.data(), 0, nullptr) == 0) damaged(where, png.message);
  return picture;
}

std::string encode_png(const Picture& picture) {
  PHOS_CHECK(picture.width > 0 && picture.height > 0, picture.width, " x ", picture.height);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(picture.width);
  png.height = static_cast<png_uint_32>(picture.height);
  png.format = PNG_FORMAT_RGB;
  PHOS_CHECK(picture.rgb.size() == PNG_IMAGE_SIZE(png), picture.rgb.size());
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  const int written = png_image_write_to_memory(&png, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr);
  PHOS_CHECK(written != 0, png.message);
  bytes.resize(size);
  return bytes;
}

}  // namespace phos::inline image
