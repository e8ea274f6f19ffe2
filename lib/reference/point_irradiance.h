// Irradiance at points, by path tracing, with its standard error.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/counters.h"
#include "reference/eye_path_tracer.h"

namespace phos::inline reference {

struct PointIrradiance {
  Rgb irradiance_lx{0};
  Rgb stderr_lx{0};           ///< of the mean, per channel; 0 for fewer than two samples
  double illuminance_lx = 0;  ///< luminance of irradiance_lx
  double illuminance_stderr_lx = 0;
  std::uint64_t samples = 0;
  std::uint64_t rejected = 0;  ///< samples that were not finite, left out
  /// Is illuminance_stderr_lx to be trusted: by how the samples lie, and with light in them (see
  /// central_moments.h); always where the scene has no lamp.
  bool trusted = true;
};

struct PointOptions {
  std::int64_t samples = 4096;  ///< paths, at most
  /// Stop once stderr / value of the illuminance is at most this, and the former is to be trusted.
  std::optional<double> relative_error;
  std::int64_t least_samples = 0;  ///< before that
  std::uint64_t seed = 0;
  std::uint64_t item = 0;  ///< tells apart the random numbers of several points (below 2^31)
  PathOptions path;
};

/// A sensor at `p` that faces unit `n`, lifted off a surface it lies on by the rounding error of positions in
/// this scene, so that its own surface does not shade it.
SurfacePoint sensor_at(const Scene& scene, const Vec3& p, const Vec3& n);

/// Irradiance on the side of the unit normal `n` at `p`. A point on a surface is lifted off it by the
/// rounding error of positions in this scene, so that its own surface does not shade it. Same bytes for any
/// number of threads.
PointIrradiance estimate_irradiance(const RayScene& rays, const Luminaires& luminaires, const Vec3& p,
                                    const Vec3& n, const PointOptions& options);

/// The same with all but the essentials at their defaults; bounces as in PathOptions (1 = direct light only).
PointIrradiance estimate_irradiance(const RayScene& rays, const Luminaires& luminaires, const Vec3& p,
                                    const Vec3& n, std::int64_t samples, std::int64_t bounces = -1,
                                    std::uint64_t seed = 0);

/// One sample of irradiance, lx.
using IrradianceSample = std::function<Rgb(RandomStream&)>;
/// The mean of samples of any kind, of which `options` tells number, error, seed and item. `lit`: is there a
/// lamp, so that samples without light are not to be trusted?
PointIrradiance estimate_irradiance(const IrradianceSample& sample, bool lit, const PointOptions& options);

/// A sensor: where it is, and which way it faces (unit).
struct SensorPoint {
  Vec3 position{0}, normal{0, 1, 0};
};

/// Points as parse_points() reads them. Throws Error(bad_input) with the line at fault, or where there are
/// none.
std::vector<SensorPoint> parse_sensor_points(const std::string& csv, const std::string& where,
                                             const DVec3& origin_m = DVec3(0));

/// `x,y,z,nx,ny,nz,illuminance_lx,stderr_lx,r_lx,g_lx,b_lx` and a line per point, shortest round-trip
/// numbers, and nothing for a standard error that is not a number. Points are counted from origin_m, the
/// table's from the world's.
std::string sensor_csv(const std::vector<SensorPoint>& points, const std::vector<PointIrradiance>& light,
                       const DVec3& origin_m = DVec3(0));

}  // namespace phos::inline reference
