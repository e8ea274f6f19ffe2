#include "image/exr/decode.h"

#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cstring>
#include <new>

#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "image/exr/header.h"
#include "image/exr/memory.h"
#include "image/primaries.h"

namespace phos::inline image {

namespace {

/// Bytes of pixels that one byte of file can stand for at most: deflate does 1032, the wavelet and cosine
/// codecs more on black pictures.
std::uint64_t best_ratio(Imf::Compression c) {
  switch (c) {
    case Imf::NO_COMPRESSION:
      return 2;  // half to float
    case Imf::RLE_COMPRESSION:
      return 256;
    case Imf::ZIP_COMPRESSION:
    case Imf::ZIPS_COMPRESSION:
    case Imf::PXR24_COMPRESSION:
      return 2200;
    default:
      return 16384;
  }
}

std::uint64_t extent(int lo, int hi) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, std::int64_t{hi} - lo + 1));
}

/// A damaged header may ask for terabytes: refuse sizes that the file cannot hold, before memory is
/// allocated.
void require_plausible(const Imf::Header& header, std::uint64_t file_bytes) {
  constexpr std::uint64_t kSide = 1u << 18, kAllowance = 16u << 20;
  std::uint64_t channels = 1;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) ++channels;
  for (const Imath::Box2i& box : {header.dataWindow(), header.displayWindow()}) {
    const std::uint64_t width = extent(box.min.x, box.max.x), height = extent(box.min.y, box.max.y);
    if (width == 0 || height == 0 || width > kSide || height > kSide)
      throw Iex::InputExc(text("a picture of ", width, " x ", height, " pixels"));
    if (width * height * channels > (kAllowance + file_bytes * best_ratio(header.compression())) / 4)
      throw Iex::InputExc(text("the file is too short for ", width, " x ", height, " pixels"));
  }
}

struct Window {
  Imath::Box2i data, display;
};

/// Pixels of the data window into the display window; the rest stays zero.
void place(const std::vector<float>& data, const Window& w, std::span<float> out) {
  const auto data_width = static_cast<std::int64_t>(extent(w.data.min.x, w.data.max.x));
  const auto width = static_cast<std::int64_t>(extent(w.display.min.x, w.display.max.x));
  const int y0 = std::max(w.data.min.y, w.display.min.y), y1 = std::min(w.data.max.y, w.display.max.y);
  const int x0 = std::max(w.data.min.x, w.display.min.x), x1 = std::min(w.data.max.x, w.display.max.x);
  if (x0 > x1) return;
  for (std::int64_t y = y0; y <= y1; ++y) {
    const auto from = data.begin() + (y - w.data.min.y) * data_width + (x0 - w.data.min.x);
    std::copy(from, from + (x1 - x0 + 1),
              out.begin() + (y - w.display.min.y) * width + (x0 - w.display.min.x));
  }
}

/// Why a part cannot be read here, though the file is sound; empty where it can.
std::string why_not_read(const Imf::Header& header) {
  if (header.hasType() && Imf::isDeepData(header.type()))
    return "has deep pixels, which phos does not read; flatten the picture";
  std::string subsampled;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
      subsampled += text(subsampled.empty() ? "" : ", ", c.name());
  if (subsampled.empty()) return "";
  return text("has subsampled chroma (", subsampled,
              "), which phos does not read; save the picture with full channels R, G and B");
}

void read_part(Imf::MultiPartInputFile& file, int index, const std::string& prefix,
               const Imath::Box2i& display, Image& image) {
  const Imf::Header& header = file.header(index);
  const Window window{header.dataWindow(), display};
  Imf::InputPart part(file, index);
  const std::size_t width = extent(window.data.min.x, window.data.max.x);
  const std::size_t pixels = width * extent(window.data.min.y, window.data.max.y);
  std::map<std::string, std::vector<float>> values;
  Imf::FrameBuffer buffer;
  for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
    std::vector<float>& v = values[c.name()];
    v.resize(pixels);
    buffer.insert(c.name(),
                  Imf::Slice::Make(Imf::FLOAT, v.data(), window.data, sizeof(float), width * sizeof(float)));
  }
  part.setFrameBuffer(buffer);
  part.readPixels(window.data.min.y, window.data.max.y);
  for (auto& [name, v] : values) {
    const bool add = !prefix.empty() && !name.starts_with(prefix + ".");
    place(v, window, image.channel(add ? prefix + "." + name : name));
    v = {};
  }
}

/// Rec.709 and cd/m2 from the colours that the header states.
void convert_colours(const Imf::Header& header, Image& image) {
  const float white = Imf::hasWhiteLuminance(header) ? Imf::whiteLuminance(header) : 1.0f;
  const float scale = std::isfinite(white) && white > 0 ? white : 1.0f;
  Primaries from = kRec709;
  if (Imf::hasChromaticities(header)) {
    const Imf::Chromaticities& c = Imf::chromaticities(header);
    const Primaries given{
        {c.red.x, c.red.y}, {c.green.x, c.green.y}, {c.blue.x, c.blue.y}, {c.white.x, c.white.y}};
    if (!given.not_given()) from = given;
    if (!is_valid(from)) throw Iex::InputExc("the chromaticities are not a colour space");
  }
  const Mat3 m = convert_primaries(from, kRec709);
  if (scale == 1 && m == Mat3(1)) return;
  for (const std::string& layer : image.layers()) {
    std::vector<Rgb> values = image.rgb(layer);
    const Mat3 colour = (layer == "albedo" ? 1.0f : scale) * m;
    for (Rgb& v : values) v = colour * v;
    image.set_rgb(layer, values);
  }
}

/// Parts that can be read. Throws Error(bad_input) where there is none.
std::vector<int> fitting_parts(const Imf::MultiPartInputFile& file, const std::string& where) {
  std::vector<int> parts;
  std::string why;
  for (int i = 0; i < file.parts(); ++i) {
    const std::string reason = why_not_read(file.header(i));
    if (reason.empty()) parts.push_back(i);
    if (why.empty()) why = reason;
  }
  if (parts.empty()) throw Error(ExitCode::bad_input, where, why);
  return parts;
}

Image read_parts(Imf::MultiPartInputFile& file, std::uint64_t file_bytes, const std::string& where) {
  const std::vector<int> parts = fitting_parts(file, where);
  for (const int i : parts) require_plausible(file.header(i), file_bytes);
  const Imf::Header& first = file.header(parts[0]);
  const Imath::Box2i display = first.displayWindow();
  Image image(static_cast<int>(extent(display.min.x, display.max.x)),
              static_cast<int>(extent(display.min.y, display.max.y)));
  for (const int i : parts) {
    const Imf::Header& header = file.header(i);
    read_part(file, i, i != parts[0] && header.hasName() ? header.name() : "", display, image);
  }
  if (Imf::hasFramesPerSecond(first) && Imf::framesPerSecond(first).d != 0)
    image.attributes[kFramesPerSecond] = shortest(static_cast<double>(Imf::framesPerSecond(first)));
  for (auto a = first.begin(); a != first.end(); ++a)
    if (const auto* s = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
      image.attributes[a.name()] = s->value();
  for (const char* structural : {"type", "name", "view"}) image.attributes.erase(structural);
  convert_colours(first, image);
  return image;
}

}  // namespace

Image decode_exr(std::string_view bytes, const std::string& where) {
  use_our_exr_threads();
  try {
    check_exr_header(bytes, where);
    MemoryExrIn stream(bytes, where);
    Imf::MultiPartInputFile file(stream, Imf::globalThreadCount(), false);
    if (file.parts() < 1) throw Iex::InputExc("the file holds no picture");
    return read_parts(file, bytes.size(), where);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;  // the sizes in the header are possible: memory is short
  } catch (const std::exception& e) {
    std::string why = e.what();
    for (char& c : why)
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
    throw Error(ExitCode::bad_input, where, "damaged or truncated OpenEXR file (" + why + "); make it again");
  }
}

}  // namespace phos::inline image
