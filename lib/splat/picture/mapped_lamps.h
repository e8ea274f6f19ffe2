// Light of lamps by shadow maps in memory, at samples of a picture: what OpenGL does not add up by pixels.
#pragma once

#include <span>
#include <vector>

#include "scene/rays.h"

namespace phos::inline splat {

struct LampMap;

/// A sample of a pixel; an infinite distance: it shows no surface.
struct SeenSample {
  Ray ray;
  Hit hit;
};

/// Light of the lamps there.
struct LampsAt {
  Rgb lux{0};                             ///< on the seen side
  Rgb point_gloss{0}, extended_gloss{0};  ///< cd/m2 through the glossy lobes: of lamps without, with an area
};

/// Const; holds a reference.
class MappedLamps {
 public:
  /// `taps` x `taps` texels are asked. Without `gloss`, light through glossy lobes is not looked for.
  MappedLamps(const RayScene& rays, int taps, bool gloss) : rays_(rays), taps_(taps), gloss_(gloss) {}
  /// Adds the light from one place on a lamp. Same bytes for any number of threads.
  void add(const LampMap& map, bool extended, std::span<const SeenSample> samples,
           std::span<LampsAt> light) const;

 private:
  const RayScene& rays_;
  int taps_;
  bool gloss_;
};

}  // namespace phos::inline splat
