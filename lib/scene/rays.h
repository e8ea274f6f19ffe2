// Rays against the scene (Embree), and their hits.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace phos {
class Options;
}

namespace phos::inline scene {

struct Ray {
  Vec3 origin{0};
  Vec3 direction{0, 0, 1};  ///< unit
  float t_min_m = 0, t_max_m = kInfinity;
};

struct Hit {
  float distance_m = kInfinity;
  std::uint32_t triangle = 0;
  float u = 0, v = 0;  ///< barycentric weights of the second and third vertex
};

/// A point on a surface, seen from one side. All directions unit.
struct SurfacePoint {
  Vec3 position{0};
  Vec3 geometric_normal{0, 0, 1};  ///< on the side it is seen from
  Vec3 smooth_normal{0, 0, 1};     ///< interpolated vertex normal on the same side, which caches use
  Vec3 normal{0, 0, 1};            ///< smooth_normal with the normal map applied, which BSDFs use
  Vec3 tangent{1, 0, 0};           ///< orthogonal to normal; of an anisotropic material, x of its frame
  Vec2 uv0{0}, uv1{0};             ///< of the sets that the material's textures use; else 0
  Vec4 colour{1};
  std::uint32_t triangle = 0, instance = 0, material = 0;
  bool front = true;     ///< seen from the counter-clockwise side
  float error_m = 0;     ///< bound on the rounding error of position; rays start this far off the surface
  float distance_m = 0;  ///< travelled by the ray that found it

  /// Origin for a ray leaving towards `direction`, off the surface on that side by error_m.
  Vec3 leave(const Vec3& direction) const {
    return position + (glm::dot(direction, geometric_normal) >= 0 ? error_m : -error_m) * geometric_normal;
  }
  /// The same point, seen from the other side.
  SurfacePoint other_side() const {
    SurfacePoint other = *this;
    other.geometric_normal = -geometric_normal, other.smooth_normal = -smooth_normal, other.normal = -normal;
    other.front = !front;
    return other;
  }
};

struct Crossing;

struct RayOptions {
  std::string isa;  ///< "" = best of this machine; "sse2" for byte-exact files across machines
};
/// --isa: the value of RayOptions::isa.
void declare_isa(Options& options, std::string& isa);

/// The acceleration structure. Queries are const and may be made from any thread. Holds a reference to the
/// scene.
class RayScene {
 public:
  explicit RayScene(const Scene& scene, const RayOptions& options = {});
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  const Scene& scene() const;
  /// Nearest hit, alpha-masked texels passed through. False if the ray escapes.
  bool intersect(const Ray& ray, Hit& hit) const;
  /// The same for each of several rays that run side by side, faster; hits of rays that escape stay as they
  /// are. Same bits.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits) const;
  /// Is there anything that light passes straight through (scene/material/passage.h)?
  bool has_panes() const;
  /// Nearest hit on a surface that does not pass the ray straight, and the crossings before it, in order.
  /// False if there is no such hit; `crossings` are then all there are.
  bool through(const Ray& ray, Hit& hit, std::vector<Crossing>& crossings) const;
  /// Share of unpolarised light, by channel, that goes along a ray to its end, straight through panes; 0
  /// where anything else is in the way. Of a ray that ends at a finite distance also the factor of
  /// StraightLight::nearer(), as of a lamp there. What a shadow ray is to a scene with windows.
  Rgb transmittance(const Ray& ray) const;
  /// The same for each of several rays that run side by side, faster. Same bits.
  void transmittance(std::span<const Ray> rays, std::span<Rgb> shares) const;
  /// Is anything in the way, within (t_min, t_max), panes too?
  bool occluded(const Ray& ray) const;
  /// The same for each of several rays that run side by side, faster: 1 where something is, else 0. Same
  /// bits.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;
  /// Can a and b see each other? Both ends are kept clear of their own surfaces by their error_m.
  bool visible(const SurfacePoint& a, const SurfacePoint& b) const;
  /// The same of a point in space: is ray_between() free?
  bool visible(const SurfacePoint& a, const Vec3& point, float error_m) const;

  /// The point a hit stands for, seen against the ray.
  SurfacePoint surface(const Ray& ray, const Hit& hit) const;
  /// The facets and vertex normals of a large scene lie about in memory: before the surface() of each hit in
  /// turn this fetches the data that hits a few places later will read. Changes no result.
  void ask_ahead(std::span<const Hit> hits, std::size_t turn) const;
  /// The Embree handle (RTCScene), for benchmarks that measure its bound.
  void* native() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The ray that must be free for a point in space (a light's sample), known to `error_m`, to be seen from a
/// surface point: it ends short of the point by that error or by the surface's own rounding. t_max_m is not
/// above 0 where the two are too close to each other for anything to stand between: do not ask then.
Ray ray_between(const SurfacePoint& from, const Vec3& to, float error_m);

/// intersect + surface.
bool trace(const RayScene& rays, const Ray& ray, SurfacePoint& point);

}  // namespace phos::inline scene
