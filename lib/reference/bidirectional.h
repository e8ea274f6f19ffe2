// Light along paths from both ends: unbiased, but for merging, which finds light that no other strategy
// finds.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reference/light_path.h"
#include "reference/vertex_grid.h"

namespace phos::inline reference {

/// What the eye paths of one pass work with.
struct LightPass {
  LightPaths paths;
  VertexGrid grid;       ///< over paths.vertex
  double merge_eta = 0;  ///< paths x pi r^2 / 2: half the area about a point counts, the whole tells the bias
};

/// How the paths of an eye start.
struct EyeStart {
  double density = 0;      ///< per sr, of the camera ray; per m2 across it where all of them are parallel
  bool parallel = false;   ///< orthographic camera
  double light_paths = 1;  ///< connected to the eye for each of its own
};

/// Of one eye path.
struct BidirectionalSample {
  PathSample sum;
  Rgb bias{0};  ///< the light of merging within the whole radius less within 1/sqrt(2) of the radius: an
                ///< estimate of the bias of the latter, to second order
};

/// Bidirectional path tracing with multiple importance sampling (balance heuristic) over all connections
/// (Veach 1997, chapter 10), and vertex merging (Georgiev et al. 2012) where light comes by way of a mirror,
/// glass or sharp gloss: no connection makes a path on which, of every two scatterings that follow each
/// other, one is a mirror's. Merging blurs that light within a radius. Light passes straight through panes,
/// which is no scattering. Const and usable from any thread; holds references.
class BidirectionalTracer {
 public:
  BidirectionalTracer(const RayScene& rays, const Luminaires& luminaires, const LightStarts& lamps,
                      const PathOptions& options = {});

  /// Luminance along a camera ray, cd/m2, but for the light that light paths bring to the camera themselves
  /// (splat()). `path`: number of the light path that it is connected to.
  BidirectionalSample luminance(const Ray& ray, const EyeStart& start, const LightPass& pass,
                                std::size_t path, RandomStream& random) const;

  /// Illuminance of a sensor on the side of its geometric normal, lx, by one path, but for the light that
  /// light paths bring to the disc about it themselves (SensorDisc). `disc_eta`: (light paths a sensor path)
  /// x area of that disc.
  BidirectionalSample irradiance(const SurfacePoint& sensor, double disc_eta, const LightPass& pass,
                                 std::size_t path, RandomStream& random) const;
  /// The same of a point of a surface, by merging instead of a disc.
  BidirectionalSample surface_irradiance(const SurfacePoint& point, const LightPass& pass, std::size_t path,
                                         RandomStream& random) const;

  /// What a vertex of a light path sends to a camera, `towards` it (unit) and so far away. A pixel's mean
  /// luminance is the sum of this over all light paths over their number. `start` as of the pixel that sees
  /// the vertex. Its sum is black where something is between.
  PathSample splat(const LightVertex& vertex, const Vec3& towards, float distance_m,
                   const EyeStart& start) const;

 private:
  struct Walk;
  struct Vertex;
  struct Scattered;
  enum class Next : std::uint8_t { none, straight, ray };

  bool samples_every_lamp(std::int64_t scatterings) const;
  Scattered scattered(const Vertex& at, const Vec3& wi) const;
  void add(const Rgb& light, std::int64_t scatterings, const Vertex& at, const Vec3& wi, const Walk& walk,
           PathSample& sum) const;
  void add_hit(const Rgb& luminance, double shadow_rays, double light_path, const Walk& walk,
               PathSample& sum) const;
  void add_hit_at(const SurfacePoint& point, const Walk& walk, PathSample& sum) const;
  void add_hit_beyond(const Walk& walk, PathSample& sum) const;
  void add_lamp(std::size_t i, double choice, const Vertex& at, const Walk& walk, RandomStream& random,
                PathSample& sum) const;
  void add_lamps(const Vertex& at, const Walk& walk, RandomStream& random, PathSample& sum) const;
  void connect(const Vertex& at, const LightVertex& y, const Walk& walk, PathSample& sum) const;
  void merge(const Vertex& at, const LightPass& pass, const Walk& walk, BidirectionalSample& sample) const;
  void gather(const Vertex& at, const LightPass& pass, std::size_t path, const Walk& walk,
              RandomStream& random, BidirectionalSample& sample) const;
  Vertex vertex_at(const SurfacePoint& point, const Bsdf& bsdf, const Walk& walk) const;
  Next scatter(const Vertex& at, Walk& walk, RandomStream& random) const;
  BidirectionalSample irradiance(const Vertex& sensor, const LightPass& pass, std::size_t path,
                                 RandomStream& random) const;
  void follow(Walk& walk, const LightPass& pass, std::size_t path, RandomStream& random,
              BidirectionalSample& sample) const;

  const RayScene* rays_;
  const Luminaires* luminaires_;
  const LightStarts* lamps_;
  PathOptions options_;
};

}  // namespace phos::inline reference
