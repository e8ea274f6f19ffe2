// Light along rays and at points by a method that reads a photon map.
#pragma once

#include <optional>

#include "core/random.h"
#include "photon/photon_map.h"
#include "reference/eye_path_tracer.h"
#include "reference/map/photon_discs.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline reference {

/// A scene and its photons. Holds references.
struct MapScene {
  const RayScene& rays;
  const Luminaires& luminaires;
  const PhotonMap& photons;
};

/// One sample of the luminance along a camera ray, cd/m2.
struct MapSample {
  PathSample sum;
  Rgb noise{0};  ///< standard error that the number of photons leaves in it: all samples of a place share it
};

/// Const and usable from any thread; holds references.
class MapLight {
 public:
  virtual ~MapLight() = default;
  /// Draws from `random`.
  virtual MapSample luminance(const Ray& ray, RandomStream& random) const = 0;
  /// One sample of the irradiance on the side of the geometric normal.
  virtual DiscIrradiance irradiance(const SurfacePoint& point, RandomStream& random) const = 0;
  /// Do samples of irradiance() at one point differ?
  virtual bool samples_differ() const = 0;
  /// Radius of the disc of photons that irradiance() reads at the point itself, m; null: it reads none there,
  /// and the point need not lie on a surface.
  virtual std::optional<float> disc_radius_m(const Vec3& p) const = 0;
};

}  // namespace phos::inline reference
