// Images with named float channels, and their files.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/vector.h"

namespace phos::inline image {

/// Planar float channels of one size, row 0 at the top. Names are "R", "indirect.R", "normal.X", "Z" and so
/// on. Light is photometric RGB (cd/m2, or lx for illuminance.Y), linear Rec.709.
class Image {
 public:
  Image() = default;
  Image(int width, int height) : width_(width), height_(height) {}
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixels() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

  bool has(const std::string& channel) const { return channels_.contains(channel); }
  /// Adds a channel of zeros if it is not there.
  std::span<float> channel(const std::string& name);
  /// Throws std::out_of_range if it is not there.
  std::span<const float> channel(const std::string& name) const { return channels_.at(name); }
  const std::map<std::string, std::vector<float>>& channels() const { return channels_; }

  /// R, G, B of a layer ("" is the beauty) as vectors; set_rgb adds the channels.
  std::vector<Rgb> rgb(const std::string& layer) const;
  void set_rgb(const std::string& layer, std::span<const Rgb> values);
  bool has_layer(const std::string& layer) const;
  /// Layers that have R, G and B; "" first.
  std::vector<std::string> layers() const;

  /// Text attributes (provenance in EXR; kFramesPerSecond).
  std::map<std::string, std::string> attributes;

 private:
  int width_ = 0, height_ = 0;
  std::map<std::string, std::vector<float>> channels_;
};

/// Attribute of the frames of an animation: how many are shown each second. EXR has a number of that name.
inline constexpr const char* kFramesPerSecond = "framesPerSecond";
/// That rate; nothing if it is absent or not above 0.
std::optional<double> frames_per_s(const Image& image);

/// "R" for layer "", else "layer.R".
std::string channel_name(const std::string& layer, const std::string& component);

/// EXR or Radiance HDR, told apart by content. HDR becomes photometric: x 179 lm/W, primaries to Rec.709,
/// EXPOSURE divided out, VIEW kept as attribute. Throws Error(bad_input) for missing, truncated or damaged
/// files.
Image read_image(const std::string& path);
/// Do bytes begin as one of these?
bool is_image(std::string_view bytes);
/// Is a file called .exr or .hdr, whatever it holds?
bool is_named_image(const std::string& path);

/// All are lossless: zip is read everywhere, piz takes half again the time to write and makes a
/// sixth less of pictures with noise, none takes the least time.
enum class ExrCompression { zip, piz, none };
/// 32-bit float, whiteLuminance 1, Rec.709 chromaticities; same image gives the same bytes. Atomic.
void write_exr(const std::string& path, const Image& image, ExrCompression compression = ExrCompression::zip);
/// Radiance RGBE of the beauty, divided by 179 lm/W, in Radiance primaries. Atomic.
void write_hdr(const std::string& path, const Image& image);

/// 8-bit RGB, row 0 at the top. Atomic.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 * width * height, sRGB
};
void write_png(const std::string& path, const Picture& picture);
/// For tests: reads a file that write_png wrote (8-bit RGB or RGBA or grey).
Picture read_png(const std::string& path);

}  // namespace phos::inline image
