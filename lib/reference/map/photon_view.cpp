#include "reference/map/photon_view.h"

#include "reference/map/specular_walk.h"
#include "reference/map/visible_glow.h"

namespace phos::inline reference {

PhotonView::PhotonView(const MapScene& scene, const MapOptions& options)
    : rays_(&scene.rays), discs_(scene.photons, options.photons_in_disc) {}

MapSample PhotonView::luminance(const Ray& ray, RandomStream& random) const {
  MapSample sample;
  random.start_bounce(0);
  follow_specular(
      *rays_, ray, random,
      [&](const SpecularStop& stop, const SurfacePoint* point) {
        add_visible_glow(rays_->scene(), stop, point, sample.sum);
      },
      [&](const SpecularStop& stop, const SurfacePoint& point, const Bsdf& bsdf) {
        const DiscRadiance light = discs_.reflected(point, bsdf, -stop.direction);
        sample.noise += stop.throughput * light.noise;
        if (stop.passed) {
          sample.sum.specular += stop.throughput * light.total();
          return;
        }
        sample.sum.direct += light.direct;
        sample.sum.indirect += light.indirect, sample.sum.glossy += light.glossy;
      });
  return sample;
}

DiscIrradiance PhotonView::irradiance(const SurfacePoint& point, RandomStream& /*random*/) const {
  return discs_.irradiance(point);
}

}  // namespace phos::inline reference
