// Records to draw, the result that drawing them must give, and the difference of two such results.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.h"
#include "record/irradiance_cache.h"
#include "splat/cpu/splatter.h"

namespace phos::test {

/// Records on the surfaces that the camera sees, random but for their places: irradiance 10..110 lx,
/// gradients that change it by up to its own value over the radius. radius_m is lo..hi, and distance_m is
/// less.
inline std::vector<IrradianceRecord> records_in_view(const RayScene& rays, const Camera& camera,
                                                     std::size_t count, float lo_m, float hi_m,
                                                     std::uint64_t seed = 1) {
  std::vector<IrradianceRecord> records;
  for (std::uint64_t item = 0; records.size() < count && item < 100 * count; ++item) {
    RandomStream random(seed, Stage::test, item);
    const Camera::Ray ray = camera.ray(random.uniform2(), 1);
    SurfacePoint point;
    if (!trace(rays, {ray.origin, ray.direction}, point)) continue;
    IrradianceRecord r;
    r.position = point.position, r.normal = point.smooth_normal;
    r.radius_m = lo_m + (hi_m - lo_m) * random.uniform();
    const Frame frame = make_frame(r.normal);
    for (int c = 0; c < 3; ++c) {
      r.irradiance[c] = 10 + 100 * random.uniform();
      r.stderr_lx[c] = 0.1f * r.irradiance[c];
      const Vec2 a = 2.f * random.uniform2() - 1.f, b = 2.f * random.uniform2() - 1.f;
      r.rotation_gradient[c] = r.irradiance[c] * (a.x * frame.x + a.y * frame.y);
      r.translation_gradient[c] = r.irradiance[c] / r.radius_m * (b.x * frame.x + b.y * frame.y);
    }
    r.distance_m = r.radius_m * random.uniform();
    records.push_back(r);
  }
  return records;
}

/// Every record at every pixel, by the functions of the cache, summed in double.
inline SplatBuffer splat_one_by_one(const std::vector<IrradianceRecord>& records, float accuracy,
                                    const GBuffer& g) {
  SplatBuffer buffer;
  buffer.unit_lx = splat_unit_lx(records);
  for (std::size_t i = 0; i < g.position.size(); ++i) {
    glm::dvec4 light(0), error(0), spread(0);
    const Vec3 p(g.position[i]), n(g.normal[i]);
    for (const IrradianceRecord& r : records) {
      if (!g.covered(i) || record_apart(r, p, n)) continue;
      float w = record_weight(record_error(r, p, n), accuracy);
      if (!(w > 1e-6f)) continue;
      w *= r.weight;
      const Rgb e = extrapolate(r, p, n);
      const double value = static_cast<double>(luminance(e) / buffer.unit_lx);
      light += glm::dvec4(w * e, w);
      spread += glm::dvec4(w * w, w * r.shared, static_cast<double>(w) * value * value, 0);
      error += glm::dvec4(w * r.stderr_lx, 1);
    }
    buffer.light.emplace_back(light);
    buffer.error.emplace_back(error);
    buffer.spread.emplace_back(spread);
  }
  return buffer;
}

struct SplatDifference {
  std::size_t other_records = 0;  ///< pixels to which another number of records added
  std::size_t drawn = 0;          ///< pixels to which any did
  double relative = 0;  ///< greatest difference of a mean irradiance, weight or mean error, of all others
  bool finite = true;
};

inline SplatDifference difference(const SplatBuffer& a, const SplatBuffer& b) {
  SplatDifference d;
  for (std::size_t i = 0; i < a.light.size(); ++i) {
    for (const Vec4& v : {a.light[i], a.error[i], b.light[i], b.error[i]}) {
      d.finite = d.finite && is_finite(Vec3(v)) && std::isfinite(v.w);
    }
    d.drawn += a.error[i].w > 0;
    if (a.error[i].w != b.error[i].w) {
      ++d.other_records;
      continue;
    }
    if (a.error[i].w == 0) {
      if (a.light[i] != Vec4(0) || b.light[i] != Vec4(0)) d.relative = 1;
      continue;
    }
    // A weight near 0 is 1 less something that is rounded: its rounding is measured against 1.
    const auto off = [](float x, float y, float unit) {
      return std::fabs(double(x) - double(y)) /
             std::max({double(std::fabs(x)), double(std::fabs(y)), double(unit)});
    };
    d.relative = std::max(d.relative, off(a.light[i].w, b.light[i].w, 0.1f));
    for (int c = 0; c < 3; ++c) {
      d.relative = std::max(d.relative, off(a.light[i][c], b.light[i][c], 1.f));
      d.relative = std::max(d.relative, off(a.error[i][c], b.error[i][c], 0.1f));
      // Squares of weights near 0 and of irradiance are rounded twice.
      d.relative = std::max(d.relative, off(a.spread[i][c], b.spread[i][c], 0.1f) / 2);
    }
  }
  return d;
}

}  // namespace phos::test
