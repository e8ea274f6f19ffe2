#include "image/exr/encode.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>

#include <new>

#include "core/error.h"
#include "image/exr/memory.h"
#include "image/exr/zip.h"
#include "image/primaries.h"

namespace phos::inline image {
namespace {

Imf::Header header_of(const Image& image, ExrCompression compression) {
  Imf::Header header(image.width(), image.height());
  header.compression() = compression == ExrCompression::zip   ? Imf::ZIP_COMPRESSION
                         : compression == ExrCompression::piz ? Imf::PIZ_COMPRESSION
                                                              : Imf::NO_COMPRESSION;
  header.lineOrder() = Imf::INCREASING_Y;
  Imf::addWhiteLuminance(header, 1.0f);
  const auto xy = [](const Vec2& v) { return Imath::V2f(v.x, v.y); };
  Imf::addChromaticities(header, {xy(kRec709.red), xy(kRec709.green), xy(kRec709.blue), xy(kRec709.white)});
  if (const std::optional<double> rate = frames_per_s(image))
    Imf::addFramesPerSecond(header, Imf::Rational(*rate));
  for (const auto& [name, value] : image.attributes)
    if (header.find(name) == header.end()) header.insert(name, Imf::StringAttribute(value));
  for (const auto& [name, values] : image.channels())
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  return header;
}

std::string encode_by_openexr(const Imf::Header& header, const Image& image) {
  use_our_exr_threads();
  Imf::FrameBuffer buffer;
  const std::size_t row = static_cast<std::size_t>(image.width()) * sizeof(float);
  for (const auto& [name, values] : image.channels()) {
    // The library only reads through the pointer.
    auto* data = reinterpret_cast<char*>(const_cast<float*>(values.data()));
    buffer.insert(name, Imf::Slice(Imf::FLOAT, data, sizeof(float), row));
  }
  MemoryExrOut stream;
  {
    Imf::OutputFile file(stream, header, Imf::globalThreadCount());
    file.setFrameBuffer(buffer);
    file.writePixels(image.height());
  }
  // OpenEXR tells nobody of the lines that it had no memory to compress.
  std::string encoded = stream.take();
  MemoryExrIn written(encoded, "memory");
  if (!Imf::MultiPartInputFile(written, 0, false).partComplete(0)) throw std::bad_alloc();
  return encoded;
}

}  // namespace

std::string encode_exr(const Image& image, ExrCompression compression) {
  PHOS_CHECK(image.pixels() > 0 && !image.channels().empty(), image.width(), " x ", image.height(),
             " pixels, ", image.channels().size(), " channels");
  const Imf::Header header = header_of(image, compression);
  return compression == ExrCompression::zip ? encode_zip_exr(header, image)
                                            : encode_by_openexr(header, image);
}

}  // namespace phos::inline image
