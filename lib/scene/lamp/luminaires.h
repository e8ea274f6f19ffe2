// Sampling the lights of a scene: for direct light, and for the emission of photons.
#pragma once

#include <optional>
#include <vector>

#include "core/spherical_triangle.h"
#include "core/vector.h"
#include "scene/mirror/image_bounds.h"
#include "scene/mirror/planes.h"
#include "scene/opening/portal_light.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// Luminance leaving a surface point on the side it is seen from, towards a unit direction, cd/m2 (0 behind a
/// one-sided emitter).
Rgb emitted_luminance(const Scene& scene, const SurfacePoint& point, const Vec3& towards);
/// Has the emission of an area light's instance one luminance, all over and from everywhere?
bool shines_evenly(const Scene& scene, const Instance& instance);

/// Luminance that a ray which leaves the scene sees, cd/m2 (0 without an environment).
Rgb background_luminance(const Scene& scene, const Vec3& direction);

/// Factor of a spot light's intensity at an angle from its axis: glTF's ((c - outer) / (inner - outer))^2, 1
/// inside the inner cone, 0 outside the outer one; a step where the two are equal.
float spot_falloff(const Light& light, double cos_angle);
/// The same at a place that lies along `way` (of any length) from the lamp; good for cones down to 1e-6 rad.
float spot_falloff(const Light& light, const DVec3& way);

/// Factor of the intensity of a light of kind spot or measured towards a place that lies along `way` (of any
/// length but 0) from the lamp; 1 for a point.
float intensity_share(const Scene& scene, const Light& light, const DVec3& way);

/// Light arriving at a point from a light's sample, visibility not yet tested.
struct Illumination {
  Vec3 direction{0};  ///< unit, from the point towards the light
  Vec3 position{0};   ///< of the sample on the light (unused where it is infinitely far)
  Vec3 normal{0};     ///< of an area light there, on the side seen from the point; 0 for others
  float distance_m = kInfinity;
  float error_m = 0;           ///< rounding error at the far end, for RayScene::visible
  std::uint32_t triangle = 0;  ///< of an area light
  Rgb value{0};  ///< lights of an extent: luminance, cd/m2. Others: illuminance on a surface facing it, lx
  float density = 0;  ///< per sr; 0 for lights without an extent (value then needs only the cosine)
};

/// A point from which a light emits.
struct EmissionPoint {
  Vec3 position{0},
      normal{0, 0, 1};  ///< of the front side; a double-sided light shines from both, the caller chooses
  float error_m = 0;
  std::uint32_t triangle = 0;
  Rgb luminance{0};   ///< cd/m2
  float density = 0;  ///< per m2 (of one side)
};

/// The ray along which a light's sample reaches a point; t_max_m as of ray_between().
Ray shadow_ray(const SurfacePoint& point, const Illumination& light);

/// Share of the light, by channel, that gets along a shadow ray, straight through panes; all light where
/// t_max_m is not above 0.
Rgb arriving_share(const RayScene& rays, const Ray& shadow_ray);
/// The same from a sample of a light to a point.
Rgb arriving_share(const RayScene& rays, const SurfacePoint& from, const Illumination& light);

class Luminaires {
  /// What of a light is sampled from a place near it: a facet or the parallelogram.
  struct Near {
    SphericalPatch patch;
    double density = 0;  // per sr
  };

 public:
  explicit Luminaires(const Scene& scene);
  std::size_t size() const { return scene_->light.size(); }
  const Light& operator[](std::size_t i) const { return scene_->light[i]; }
  /// By way of which lamps have images (scene/mirror/images.h).
  const MirrorPlanes& mirrors() const { return mirrors_; }
  /// ImageBounds::promise_lx() of the image of light `i` in a chain of mirrors().
  float image_promise_lx(std::size_t chain, std::size_t i, const SurfacePoint& point) const {
    return image_bounds_.promise_lx(mirrors_, chain, i, point);
  }
  float image_promise_lx(std::size_t chain, std::size_t i, const ImageBounds::Sight& last,
                         const SurfacePoint& point) const {
    return image_bounds_.promise_lx(mirrors_, chain, i, last, point);
  }

  /// One sample of light `i` as seen from `from`. False where it cannot shine there (behind it, outside the
  /// cone). Area lights: of a triangle chosen by u_triangle in proportion to its power, uniform over it, or
  /// over the solid angle under which it is seen where that is near (within 2 radii), so that no sample
  /// outweighs the others. A parallelogram of two triangles is sampled by `u` alone, so that strata of `u`
  /// are strata of the light. Environment: as Environment::sample() chooses, or
  /// through the portals that are seen from there (PortalLight), by `u` alone too.
  bool illuminate(std::size_t i, const Vec3& from, float u_triangle, const Vec2& u,
                  Illumination& result) const {
    return View(*this, i, from).illuminate(u_triangle, u, result);
  }

  /// Light `i` as seen from one place, for several samples: its near parts are looked at once. For
  /// one thread; holds a reference.
  class View {
   public:
    View(const Luminaires& lights, std::size_t i, const Vec3& from) : lights_(lights), i_(i), from_(from) {}
    bool illuminate(float u_triangle, const Vec2& u, Illumination& result);

   private:
    bool illuminate_from_area(float u_triangle, const Vec2& u, Illumination& result);

    const Luminaires& lights_;
    std::size_t i_;
    Vec3 from_;
    std::optional<std::size_t> looked_at_;  // facet
    std::optional<Near> near_;              // of the light; none where it is far
  };

  /// Is illuminate(i) steered by `u` alone? Else `u_triangle` chooses a part of the lamp, and `u` a place on
  /// it.
  bool by_u_alone(std::size_t i) const { return shape_[i].cdf.empty() || shape_[i].parallelogram; }
  /// Density per sr with which illuminate(i, from) would choose the direction in which a ray of `distance_m`
  /// hit `triangle` of an area light, seen at cos_light > 0. For multiple importance sampling.
  float density(std::size_t i, const Vec3& from, std::uint32_t triangle, float distance_m,
                float cos_light) const;
  /// Density per m2 (of one side) with which sample_point(i) chooses a point on `triangle`; 0 where it is
  /// none of the light's.
  float area_density(std::size_t i, std::uint32_t triangle) const;
  /// density() for a ray that left the scene: with which the environment's light is sampled there, 0 without
  /// one.
  float density_beyond(const Vec3& from, const Vec3& direction) const;
  /// Illuminance by the environment on a surface there, roughly, nothing but the portals considered, lx.
  float promise_beyond_lx(const Vec3& from) const;
  /// Index of the environment among the lights, or -1.
  std::int32_t environment() const { return environment_; }
  /// Index of the area light that a triangle belongs to, or -1.
  std::int32_t light_of(std::uint32_t triangle) const;

  /// A point on area light i, chosen in proportion to the emitted power of its triangles.
  EmissionPoint sample_point(std::size_t i, float u_triangle, const Vec2& u) const;
  /// A point on the luminous opening of area light i (which has a fitting), uniform over the part that is
  /// seen from far away in unit `direction`; the normal is on the side seen. density 0: nothing is seen.
  EmissionPoint sample_seen_from(std::size_t i, const Vec3& direction, float u_triangle, const Vec2& u) const;

  /// Probability of each light in proportion to its flux (luminance of flux_lm), each at least
  /// `minimum_share`/size(). All equal where no light has any flux. The environment's flux is
  /// `environment_lm` instead, if that is not negative.
  std::vector<double> power_shares(double minimum_share, double environment_lm = -1) const;

 private:
  struct Facet {
    Vec3 corner[3], normal;
    float error_m;
    float density_per_m2;  // 0 for one that is never chosen
    float share;           // its probability
    Vec3 middle;
    float near2_m2;  // square of the distance from the middle within which it is near
  };
  struct Shape {
    std::vector<double> cdf;   // over the triangles, ends at 1
    std::vector<Facet> facet;  // of each triangle
    bool parallelogram = false;
    std::uint8_t corner[2] = {0,
                              0};  // the corners (of the two triangles) that lie opposite their common edge
  };
  struct Spot {
    std::uint32_t triangle;  // of the light's, from 0
    Vec2 weights;            // of the second and third vertex
  };
  Shape make_shape(const Light& light) const;
  void find_parallelogram(const Instance& instance, Shape& shape) const;
  static std::size_t choose_facet(const Shape& shape, float u_triangle);
  static Spot choose(const Shape& shape, float u_triangle, const Vec2& u);
  static Spot choose(const Shape& shape, std::size_t facet, const Near& near, const Vec2& u);
  /// Facet k, or the parallelogram that it belongs to; nothing where it is far.
  static std::optional<Near> see_near(const Shape& shape, std::size_t k, const Vec3& from);
  EmissionPoint point_of(const Light& light, const Shape& shape, const Spot& spot) const;

  const Scene* scene_;
  MirrorPlanes mirrors_;
  ImageBounds image_bounds_;
  std::int32_t environment_ = -1;
  std::optional<PortalLight> portals_;  // of the environment
  std::vector<Shape> shape_;            // per light; empty for one without area
  std::vector<std::int32_t> instance_light_;
};

}  // namespace phos::inline scene
