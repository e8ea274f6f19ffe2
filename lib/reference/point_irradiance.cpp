#include "reference/point_irradiance.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "core/origin.h"
#include "core/parallel.h"
#include "reference/central_moments.h"
#include "reference/moments.h"
#include "scene/point_table.h"

namespace phos::inline reference {

namespace {

constexpr std::size_t kChunk = 256;
constexpr std::int64_t kFirstPass = 256;

struct Partial {
  Moments red, green, blue, luminous;
  CentralMoments spread;  // of the luminance
  std::uint64_t rejected = 0;
};

/// Bound on the distance between a point given in floats and the surface it is meant to be on: a few dozen
/// units in the last place of the largest coordinate there is.
float rounding_error_m(const Scene& scene, const Vec3& p) {
  float size = max_component(glm::abs(p));
  if (!scene.bounds.empty())
    size =
        std::max({size, max_component(glm::abs(scene.bounds.lo)), max_component(glm::abs(scene.bounds.hi))});
  return 32 * std::numeric_limits<float>::epsilon() * size;
}

Partial sample_range(const IrradianceSample& sample, const PointOptions& options, std::uint64_t begin,
                     std::uint64_t end) {
  Partial part;
  for (std::uint64_t s = begin; s < end; ++s) {
    RandomStream random(options.seed, Stage::reference, (options.item << 32) | s);
    const Rgb lux = sample(random);
    if (!is_finite(lux)) {
      ++part.rejected;
      continue;
    }
    part.red.add(lux.x), part.green.add(lux.y), part.blue.add(lux.z), part.luminous.add(luminance(lux));
    part.spread.add(static_cast<double>(luminance(lux)));
  }
  return part;
}

}  // namespace

SurfacePoint sensor_at(const Scene& scene, const Vec3& p, const Vec3& n) {
  SurfacePoint sensor;
  sensor.position = p;
  sensor.geometric_normal = sensor.smooth_normal = sensor.normal = n;
  sensor.error_m = rounding_error_m(scene, p);
  return sensor;
}

PointIrradiance estimate_irradiance(const IrradianceSample& sample, bool lit, const PointOptions& options) {
  const auto join = [](Partial& sum, const Partial& part) {
    sum.red.merge(part.red), sum.green.merge(part.green), sum.blue.merge(part.blue);
    sum.luminous.merge(part.luminous), sum.spread.merge(part.spread);
    sum.rejected += part.rejected;
  };
  Partial sum;
  const auto settled = [&] { return !lit || trusted(sum.spread); };
  std::int64_t done = 0;
  while (done < options.samples) {
    std::int64_t next = options.samples;
    if (options.relative_error) next = std::min(next, std::max(kFirstPass, 2 * done));
    const auto start = static_cast<std::uint64_t>(done);
    sum = parallel_reduce(
        static_cast<std::size_t>(next - done), kChunk, std::move(sum),
        [&](std::size_t begin, std::size_t end) {
          return sample_range(sample, options, start + begin, start + end);
        },
        join);
    done = next;
    if (options.relative_error && done >= options.least_samples && settled() &&
        sum.luminous.standard_error() <= *options.relative_error * sum.luminous.mean())
      break;
  }
  PointIrradiance result;
  result.irradiance_lx = {sum.red.mean(), sum.green.mean(), sum.blue.mean()};
  result.stderr_lx = {sum.red.standard_error(), sum.green.standard_error(), sum.blue.standard_error()};
  result.illuminance_lx = sum.luminous.mean();
  result.illuminance_stderr_lx = sum.luminous.standard_error();
  result.samples = static_cast<std::uint64_t>(done);
  result.rejected = sum.rejected;
  result.trusted = settled();
  return result;
}

PointIrradiance estimate_irradiance(const RayScene& rays, const Luminaires& luminaires, const Vec3& p,
                                    const Vec3& n, const PointOptions& options) {
  const EyePathTracer tracer(rays, luminaires, options.path);
  const SurfacePoint sensor = sensor_at(rays.scene(), p, n);
  const auto sample = [&](RandomStream& random) { return tracer.irradiance(sensor, random); };
  return estimate_irradiance(sample, luminaires.size() > 0, options);
}

PointIrradiance estimate_irradiance(const RayScene& rays, const Luminaires& luminaires, const Vec3& p,
                                    const Vec3& n, std::int64_t samples, std::int64_t bounces,
                                    std::uint64_t seed) {
  PointOptions options;
  options.samples = samples;
  options.seed = seed;
  options.path.bounces = bounces;
  return estimate_irradiance(rays, luminaires, p, n, options);
}

std::vector<SensorPoint> parse_sensor_points(const std::string& csv, const std::string& where,
                                             const DVec3& origin_m) {
  const PointTable table = parse_points(csv, where, origin_m);
  if (table.position.empty())
    throw Error(ExitCode::bad_input, where, "holds no points; give lines of x,y,z,nx,ny,nz");
  std::vector<SensorPoint> points;
  for (std::size_t i = 0; i < table.position.size(); ++i)
    points.push_back({table.position[i], table.normal[i]});
  return points;
}

std::string sensor_csv(const std::vector<SensorPoint>& points, const std::vector<PointIrradiance>& light,
                       const DVec3& origin_m) {
  PHOS_CHECK(points.size() == light.size(), points.size(), " points, ", light.size(), " values");
  std::string out = "x,y,z,nx,ny,nz,illuminance_lx,stderr_lx,r_lx,g_lx,b_lx\n";
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 &p = points[i].position, &n = points[i].normal, &lux = light[i].irradiance_lx;
    for (int c = 0; c < 3; ++c) out.append(world_text(origin_m[c], p[c])).push_back(',');
    const float columns[] = {n.x,
                             n.y,
                             n.z,
                             static_cast<float>(light[i].illuminance_lx),
                             static_cast<float>(light[i].illuminance_stderr_lx),
                             lux.x,
                             lux.y,
                             lux.z};
    for (const float& value : columns) {
      if (&value != columns) out.push_back(',');
      if (!std::isnan(value)) out.append(shortest(value));
    }
    out.push_back('\n');
  }
  return out;
}

}  // namespace phos::inline reference
