// Light straight through panes: the surfaces that a ray crosses on its way.
#pragma once

#include <span>
#include <vector>

#include "scene/material/bsdf.h"
#include "scene/material/pane.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Does light pass straight through a material, at some of its texels at least? Solid glass does only where
/// its faces are plane and parallel; that is not told by the material.
bool passes_straight(const Scene& scene, const Material& material);
/// Does light pass a material, straight or into a solid?
bool transmits(const Scene& scene, const Material& material);

/// What a ray passes straight through: a thin pane, a sheet, a film, a plate of solid glass between parallel
/// faces, or a pack of such panes, parallel and next to each other, with all interreflection in it.
struct Crossing {
  SurfacePoint point;   ///< where the ray enters, seen against it
  PaneLayer layer;      ///< of the whole
  float leave_m = 0;    ///< distance along the ray at which it leaves the last part
  float plate_m = 0;    ///< solid glass in it, along the normal; 0: it is thin
  float plate_ior = 1;  ///< its index
  bool own = true;      ///< `layer` is Bsdf::pane() of the point
};

/// Crossings that follow each other along a straight line: the light that is left. Polarisation is carried
/// from one to the next as long as they are parallel.
class StraightLight {
 public:
  /// `direction` (unit) of the ray.
  void add(const Crossing& crossing, const Vec3& direction);
  /// Share of unpolarised light, by channel.
  Rgb transmittance() const { return before_ * 0.5f * (pass_[0] + pass_[1]); }
  /// Factor of the light of a lamp at a finite distance, which plates of solid glass bring nearer: of its
  /// illuminance on a plane parallel to them, at `distance_m` along the ray (the first order of
  /// docs/methods.md#g1-7: flux of a bundle of rays over the area that it comes to). 1 without plates.
  float nearer(float distance_m) const;

 private:
  Rgb before_{1};  // the mean over crossings that are not parallel to the last
  Rgb pass_[2]{Rgb(1), Rgb(1)};
  Vec3 normal_{0};
  float cosine_ = 1;
  struct Plate {
    float thickness_m, ior;
  };
  std::vector<Plate> plate_;
  bool parallel_ = true;  // all plates
};

/// One hit of a ray on a surface that may pass it.
struct PaneHit {
  float distance_m;
  std::uint32_t triangle;
  float u, v;
};

/// Crossings of a ray from its hits on surfaces that may pass it. Sorts the hits. Returns the hit that does
/// not pass it straight after all (a face of solid glass without a parallel one behind it), or null;
/// crossings are those before it.
const PaneHit* find_crossings(const RayScene& rays, const Ray& ray, std::span<PaneHit> hits,
                              std::vector<Crossing>& crossings);

/// The nearest surface that does not pass a ray straight, as trace(); `share` of the light from there that
/// comes straight through the surfaces before it. Light that panes themselves send along the ray is left out.
bool trace_straight(const RayScene& rays, const Ray& ray, SurfacePoint& point, Rgb& share);

/// The surfaces that a ray meets one after another, for a walk that may pass straight through some of them.
/// All of them lie on one line; distances count from its start. Holds references.
class Way {
 public:
  Way(const RayScene& rays, const Ray& ray) : rays_(&rays), ray_(ray) {}
  /// The next one. False: the ray leaves the scene (or reaches its t_max_m). Only a surface that passes light
  /// straight has one behind it.
  bool next(SurfacePoint& point);
  /// Of the point that next() found.
  Bsdf bsdf(const SurfacePoint& point) const;

 private:
  const RayScene* rays_;
  Ray ray_;
  bool looked_ = false, ends_ = false;
  Hit end_;
  std::vector<Crossing> crossing_;
  std::size_t at_ = 0;  // crossings met
};

}  // namespace phos::inline scene
