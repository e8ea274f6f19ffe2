// Irradiance by gathered rays, again and again at one place.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "core/float_traps.h"
#include "estimate/gather.h"
#include "estimate/record_options.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "support/scenes.h"

namespace phos::test {

/// Values of one place with different random numbers, against the truth.
struct Trial {
  double mean = 0, stderr_of_mean = 0;
  double stated = 0;  ///< root mean square of (value - truth) / stated standard error
};

inline RecordOptions gather_options(const Scene& scene, Quantity paths, std::int64_t bounces,
                                    std::int64_t rays) {
  RecordOptions options;
  options.estimate = Estimate::gather;
  options.paths = paths;
  options.gather_bounces = bounces;
  options.rays = rays;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

struct Gathered {
  explicit Gathered(const Scene& s) : scene(s), rays(scene), lights(scene) {}
  Gathered(const Gathered&) = delete;

  std::vector<IrradianceRecord> records(const Vec3& p, const Vec3& n, const RecordOptions& options,
                                        const GatherSource& source, std::uint64_t count) {
    const GatherEstimator estimator(rays, lights, source, options, 1);
    const auto worker = estimator.make_worker();
    std::vector<IrradianceRecord> all;
    for (std::uint64_t i = 0; i < count; ++i) all.push_back(estimator.make({p, n, i}, *worker).record);
    counters.merge(worker->counters);
    return all;
  }

  Trial trial(const Vec3& p, const Vec3& n, const RecordOptions& options, const GatherSource& source,
              double truth, std::uint64_t count = 200) {
    Trial t;
    const auto all = records(p, n, options, source, count);
    const NoFloatTraps traps;  // a stated error may be zero, and one record has no spread
    const auto size = static_cast<double>(count);
    double squares = 0, z2 = 0;
    for (const IrradianceRecord& r : all) t.mean += static_cast<double>(r.irradiance.y) / size;
    for (const IrradianceRecord& r : all) {
      const double off = static_cast<double>(r.irradiance.y) - t.mean;
      const double wrong = static_cast<double>(r.irradiance.y) - truth;
      const double z = wrong == 0 ? 0 : wrong / static_cast<double>(r.stderr_lx.y);
      squares += off * off, z2 += z * z;
    }
    t.stderr_of_mean = std::sqrt(squares / (size * (size - 1)));
    t.stated = std::sqrt(z2 / size);
    return t;
  }

  Scene scene;
  RayScene rays;
  Luminaires lights;
  Counters counters;
};

/// A cache that says the same irradiance everywhere on the walls of a box, seen from inside.
inline RecordTree uniform_tree(const Vec3& lo, const Vec3& hi, float irradiance_lx) {
  Bounds bounds;
  bounds.include(lo), bounds.include(hi);
  RecordTree tree(bounds, 0.5);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool high : {false, true}) {
      IrradianceRecord r;
      r.position = bounds.centre();
      r.position[axis] = high ? hi[axis] : lo[axis];
      r.normal = Vec3(0);
      r.normal[axis] = high ? -1.f : 1.f;
      r.irradiance = Rgb(irradiance_lx);
      r.radius_m = 10 * bounds.diagonal_m();
      tree.insert(r);
    }
  }
  return tree;
}

/// The tree of records of furnace(0.5) for the light that its walls reflect.
inline RecordTree half_furnace_tree(const AnalyticScene& furnace) {
  const Bounds& b = furnace.scene.bounds;
  return uniform_tree(b.lo, b.hi, static_cast<float>(0.5 * furnace.mean_irradiance_lx));
}

}  // namespace phos::test
