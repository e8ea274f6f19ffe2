// Paths of light from the lamps: the vertices that eye paths are connected to or merged with, and
// the segments that cross the air after a sharp reflection.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/eye_path_tracer.h"
#include "reference/light_starts.h"
#include "reference/path_weights.h"
#include "scene/material/bsdf.h"

namespace phos::inline reference {

/// Where a light path met a surface that scatters it not as a mirror alone.
struct LightVertex {
  SurfacePoint point;
  Bsdf bsdf;
  Vec3 towards_lamp{0};  ///< unit, along the path
  Rgb flux_lm{0};        ///< that lands, of one path
  SubPathEnd end;
  double every_light = 1;  ///< factor of end.connect where shadow rays of the other side go to every lamp
  std::int32_t scatterings = 0;  ///< before it: 0 at the first surface
  bool after_sharp = false;      ///< came by a mirror, glass, or sharp gloss: eye paths may be merged here
  bool sharp = false;            ///< the material reflects sharply
};

/// What a light path goes along after a sharp reflection: to the next surface, or on through a pane.
struct SharpSegment {
  Vec3 start{0}, direction{0};  ///< from the reflection, or from where it left a pane
  float length_m = 0;           ///< to the next surface
  float before_m = 0;           ///< from the reflection to the start
  float slack_m = 0;            ///< rounding of the end
  Rgb flux_lm{0};
  double density = 1;            ///< per sr, of the direction; 1 of a mirror's
  double cos_leaving = 1;        ///< at the reflection
  double behind = 0;             ///< U + rho V there
  std::int32_t scatterings = 0;  ///< the reflection included
  bool mirror = false;           ///< cannot be connected
};

/// All that a number of light paths leave behind, path by path.
struct LightPaths {
  std::vector<LightVertex> vertex;
  std::vector<std::uint32_t> first;  ///< of each path, and the end
  std::vector<SharpSegment> segment;
  bool segments_only = false;  ///< vertices are not kept
  std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
};

/// Follows light from the lamps. Const and usable from any thread; holds references.
class LightTracer {
 public:
  LightTracer(const RayScene& rays, const Luminaires& luminaires, const LightStarts& lamps,
              const PathOptions& options);
  /// Adds one path to `paths` (its vertices, its segments and the end of its range). `eta`: of merging.
  void trace(RandomStream& random, double eta, LightPaths& paths) const;

 private:
  struct Walk;
  bool meet(const SurfacePoint& point, const Bsdf& bsdf, double eta, Walk& walk, LightPaths& paths) const;
  bool scatter(const SurfacePoint& point, const Bsdf& bsdf, Walk& walk, RandomStream& random) const;

  const RayScene* rays_;
  const Luminaires* luminaires_;
  const LightStarts* lamps_;
  PathOptions options_;
};

/// So many paths, path i of random stream item + i. Same bytes for any number of threads.
LightPaths trace_light(const LightTracer& tracer, std::uint64_t seed, std::uint64_t item, std::size_t paths,
                       double eta, bool segments_only = false);

}  // namespace phos::inline reference
