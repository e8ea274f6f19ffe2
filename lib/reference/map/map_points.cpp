#include "reference/map/map_points.h"

#include <cmath>

#include "core/error.h"
#include "core/progress.h"
#include "reference/map/foot.h"

namespace phos::inline reference {
namespace {

std::vector<SurfacePoint> places_of(const MapLight& light, const RayScene& rays,
                                    std::span<const SensorPoint> points, const std::string& where) {
  std::vector<SurfacePoint> places;
  for (const SensorPoint& point : points) {
    places.push_back(sensor_at(rays.scene(), point.position, point.normal));
    if (!light.disc_radius_m(point.position)) continue;
    const auto foot = foot_of(rays, point, light);
    if (!foot)
      throw Error(
          ExitCode::bad_input, where,
          text("point ", places.size(),
               " lies on no surface that faces its way and stores photons, and the method reads those "
               "about it; put it on one, or give --method path or bidirectional"));
    places.back() = *foot;
  }
  return places;
}

void add_noise(PointIrradiance& point, const Rgb& noise_lx) {
  point.stderr_lx = glm::sqrt(point.stderr_lx * point.stderr_lx + noise_lx * noise_lx);
  point.illuminance_stderr_lx =
      std::hypot(point.illuminance_stderr_lx, static_cast<double>(luminance(noise_lx)));
}

}  // namespace

MeasuredPoints measure_map_points(const MapLight& light, const RayScene& rays, bool lit,
                                  std::span<const SensorPoint> points, const std::string& where,
                                  PointOptions options) {
  MeasuredPoints measured{{}, {{}, Sampler::photons}};
  if (!light.samples_differ()) options.samples = 1, options.relative_error.reset();
  const std::vector<SurfacePoint> places = places_of(light, rays, points, where);
  Progress progress("reference", points.size(), "points");
  for (const SurfacePoint& place : places) {
    const auto sample = [&](RandomStream& random) { return light.irradiance(place, random).irradiance_lx; };
    PointIrradiance point = estimate_irradiance(sample, lit, options);
    RandomStream random(options.seed, Stage::reference, options.item << 32);
    add_noise(point, light.irradiance(place, random).noise_lx);
    measured.doubts.judge(point);
    measured.samples += point.samples, measured.rejected += point.rejected;
    measured.light.push_back(point);
    ++options.item;
    progress.advance();
  }
  return measured;
}

}  // namespace phos::inline reference
