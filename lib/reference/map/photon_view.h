// The photon map shown directly.
#pragma once

#include "reference/map/map_light.h"
#include "reference/map/map_options.h"

namespace phos::inline reference {

/// All light of a visible surface, direct light too, is that of the photons about it (PhotonDiscs) by its
/// whole BSDF but for delta lobes, whose light is followed to the next surface. Gloss is thus lit by those of
/// the photons that its lobe takes: of sharp gloss few, with as much noise.
class PhotonView final : public MapLight {
 public:
  PhotonView(const MapScene& scene, const MapOptions& options);
  MapSample luminance(const Ray& ray, RandomStream& random) const override;
  DiscIrradiance irradiance(const SurfacePoint& point, RandomStream& random) const override;
  bool samples_differ() const override { return false; }
  std::optional<float> disc_radius_m(const Vec3& p) const override { return discs_.radius_m(p); }

 private:
  const RayScene* rays_;
  PhotonDiscs discs_;
};

}  // namespace phos::inline reference
