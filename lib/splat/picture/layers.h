// The layers of a picture, as sums over the samples of each pixel.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/vector.h"
#include "image/image.h"

namespace phos::inline splat {

enum class Layer : std::uint8_t {
  beauty,
  direct,
  indirect,
  glossy,
  specular,
  emission,
  stderr_,
  albedo,
  illuminance,
  weight,
  normal,
  position,
  depth,
};

/// Some of the layers.
class LayerSet {
 public:
  /// Names as in the file ("beauty", "direct", ..., "Z"), or "all". Throws Error(usage) for others, or none.
  explicit LayerSet(std::span<const std::string> names);
  bool has(Layer layer) const { return (bits_ >> static_cast<unsigned>(layer) & 1u) != 0; }
  /// Asked for by "all": layers that would be black are left out of the file then.
  bool all() const { return all_; }
  /// Is any of them of light? Others tell of surfaces and records.
  bool show_light() const;
  /// "beauty, direct, ..."
  static std::string names();

 private:
  std::uint32_t bits_ = 0;
  bool all_ = false;
};

/// What one sample of a pixel sees. cd/m2 towards the camera where nothing else is said.
struct PixelSample {
  Rgb direct{0}, indirect{0}, glossy{0}, specular{0}, emission{0};
  Rgb albedo{0};
  DVec3 variance{0};      ///< of direct light and gloss, by their rays
  Rgb noisy{0};           ///< the part of direct light and gloss that is subject to noise
  Rgb indirect_error{0};  ///< of the records' part; samples share records, so that it does not average out
  float illuminance_lx = 0, weight = 0;
  Rgb beauty() const { return direct + indirect + glossy + specular + emission; }
};

/// Sums of the layers that are asked for.
class Layers {
 public:
  /// Pixels get up to `most_samples`. Those of more than one, and no fewer than `spread_from`, send single
  /// rays, whose noise shows in the spread of their samples alone, or rays that samples share, whose noise
  /// does not: the larger is stated.
  Layers(int width, int height, const LayerSet& wanted, int most_samples, int spread_from);

  /// Memory of a pixel, in bytes: sums, or sums and picture where that is more.
  static double bytes_of_pixel(const LayerSet& wanted);

  /// A sample, or as many that see the same as `times` tells.
  void add(std::size_t pixel, const PixelSample& sample, int times = 1);
  /// What does not average: seen through the pixel's first sample.
  void set_surface(std::size_t pixel, const Vec3& position, const Vec3& normal, float depth_m);
  /// Divided by samples[pixel]; direct light (in beauty, too) and illuminance are 0 at least.
  Image image(std::span<const std::uint16_t> samples) const;

 private:
  Rgb standard_error(std::size_t pixel, int samples) const;
  int width_, height_, spread_from_;
  LayerSet wanted_;
  // One entry per pixel; empty where not asked for.
  std::vector<Rgb> beauty_, direct_, indirect_, glossy_, specular_, emission_, albedo_, normal_, position_;
  std::vector<Rgb> indirect_error_;
  // Squares are beyond the range of floats where light is within, and less the square of the mean are a small
  // rest.
  std::vector<DVec3> variance_;
  std::vector<DVec3> noisy_, noisy_square_;  // empty, too, where no pixel has samples enough
  std::vector<float> illuminance_, weight_, depth_;
};

}  // namespace phos::inline splat
