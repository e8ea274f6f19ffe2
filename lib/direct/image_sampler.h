// Samples of the images that lamps have in flat mirrors.
#pragma once

#include <optional>
#include <vector>

#include "core/random.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline direct {

/// Chooses among the images that lamps have in flat mirrors (scene/mirror/images.h): by the light that they
/// promise at the point (ImageBounds), or where there are too many to compare, a chain of mirrors by its
/// reflectance and a lamp by its power. Every image that may light the point has a chance. Const, usable from
/// any thread; holds references.
class ImageSampler {
 public:
  ImageSampler(const RayScene& rays, const Luminaires& lights);

  /// There are no images.
  bool empty() const { return chain_.empty() || lamp_.empty(); }

  struct Sample {
    Rgb lux{0};         ///< on the point's surface; cosine, density and the choice included; 0: none arrives
    Vec3 direction{0};  ///< unit, to where it comes from
    bool extended = false;  ///< rays could find the lamp too
  };
  /// One sample of one image, unbiased for the light of all. Images of more than `most_reflections`
  /// (negative: no limit) count as dark. Draws from `random`. There must be an image.
  Sample sample(const SurfacePoint& point, std::int64_t most_reflections, RandomStream& random) const;
  /// One sample of each image that promises a good part of the light, and of the rest as many as make such a
  /// part together; those that bring light. Unbiased. Samples k = 0 to total - 1 of places that share a
  /// pixel, of streams `sequence` that start alike, are a low-discrepancy sequence together.
  void sample_all(const SurfacePoint& point, int k, int total, RandomStream& sequence,
                  std::vector<Sample>& out) const;

 private:
  /// Up to so many images are compared at the point itself.
  static constexpr std::size_t kMostCompared = 2048;
  struct Choice {
    std::size_t index = 0;
    double below = 0, up_to = 0;  // probability of those before it, and with it
    std::int64_t reflections = 0;
  };
  struct Image {
    std::size_t chain = 0, light = 0;
    double probability = 1;
    std::int64_t reflections = 0;
  };
  /// A side of a mirror, and the chains that end there.
  struct Side {
    std::int32_t plane = 0;
    bool front = true;
    std::vector<std::size_t> chain;  // of chain_
  };
  /// Calls f(image, promise in lx) for each image that may light the point.
  template <class F>
  void each_image(const SurfacePoint& point, F&& f) const;
  bool compares() const { return chain_.size() * lamp_.size() <= kMostCompared; }
  static const Choice& choose(const std::vector<Choice>& among, double u);
  /// Nothing where no image may light the point.
  std::optional<Image> choose(const SurfacePoint& point, double u) const;
  Sample sample_of(const Image& image, const SurfacePoint& point, float u_triangle, const Vec2& u) const;

  const RayScene& rays_;
  const Luminaires& lights_;
  std::vector<Choice> chain_, lamp_;
  std::vector<Side> side_;
};

}  // namespace phos::inline direct
