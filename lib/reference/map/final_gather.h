// Gathering at every pixel: the classical second pass over a photon map.
#pragma once

#include <optional>

#include "reference/map/map_light.h"
#include "reference/map/map_options.h"
#include "reference/map/specular_walk.h"

namespace phos::inline reference {

/// Light of a visible surface in four parts (Jensen 2001; docs/methods.md#c8): from lamps by shadow rays
/// alone, as EyePathTracer::direct() has it; by way of mirrors and glass, from the caustic photons about it
/// (PhotonDiscs); from other surfaces by `gather_rays` rays drawn from its BSDF (of a Lambert surface
/// distributed as the cosine, in strata), each lit where it lands by the photons about the hit; and by delta
/// lobes, followed. A gather ray goes on by mirrors and glass until it lands; lamps on its way do not count,
/// as shadow rays or caustic photons bring their light. The samples' spread holds the gathering; neither the
/// noise of the photons where rays land nor the bias of the discs is in any stated error.
class FinalGather final : public MapLight {
 public:
  FinalGather(const MapScene& scene, const MapOptions& options);
  FinalGather(const FinalGather&) = delete;
  FinalGather& operator=(const FinalGather&) = delete;
  MapSample luminance(const Ray& ray, RandomStream& random) const override;
  DiscIrradiance irradiance(const SurfacePoint& point, RandomStream& random) const override;
  bool samples_differ() const override { return true; }
  std::optional<float> disc_radius_m(const Vec3& p) const override;

 private:
  struct Gathered {
    Rgb indirect{0}, glossy{0};
  };
  Gathered gather(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, RandomStream& random) const;
  Rgb landed(const SurfacePoint& from, const Vec3& direction, RandomStream& random) const;
  Rgb unsampled_glow(const SpecularStop& stop, const SurfacePoint* point) const;
  MapSample scattered(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo,
                      RandomStream& random) const;

  const RayScene* rays_;
  const Luminaires* luminaires_;
  EyePathTracer lamps_;
  PhotonDiscs discs_;
  std::optional<PhotonMap> caustic_map_;
  std::optional<PhotonDiscs> caustic_discs_;  // null: the map has no caustic photons
  std::int64_t count_;
};

}  // namespace phos::inline reference
