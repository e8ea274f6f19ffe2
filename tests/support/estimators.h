// Estimators that cost nothing, to test the use of records.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.h"
#include "core/sampling.h"
#include "estimate/estimator.h"
#include "scene/rays.h"

namespace phos::test {

/// Light of 1 lx everywhere, a gradient along x of 1 / diagonal, and the harmonic mean distance of a few
/// rays, at most a quarter of the scene. Counts its records.
class DistanceEstimator : public Estimator {
 public:
  explicit DistanceEstimator(const RayScene& rays, int count = 32) : rays_(rays), count_(count) {}
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Worker>(); }

  Made make(const RecordSite& site, Worker& worker) const override {
    worker.counters.add("distances measured");
    const Frame frame = make_frame(site.normal);
    const float diagonal_m = rays_.scene().bounds.diagonal_m();
    const Vec3 origin = site.position + 1e-6f * diagonal_m * site.normal;
    RandomStream random(1, Stage::test, site.item);
    double sum = 0;
    for (int i = 0; i < count_; ++i) {
      Hit hit;
      const Ray ray{origin, frame.to_world(sample_cosine_hemisphere(random.uniform2()))};
      if (rays_.intersect(ray, hit)) sum += 1 / static_cast<double>(hit.distance_m + 1e-6f * diagonal_m);
    }
    IrradianceRecord r;
    r.position = site.position, r.normal = site.normal;
    r.irradiance = Rgb(1), r.stderr_lx = Rgb(0.1f);
    r.distance_m = sum > 0 ? static_cast<float>(count_ / sum) : kInfinity;
    r.radius_m = std::min(r.distance_m, 0.25f * diagonal_m);
    for (Vec3& g : r.translation_gradient) g = Vec3(1 / diagonal_m, 0, 0);
    return {r, 0, site.least_radius_m, site.most_radius_m};
  }

 private:
  const RayScene& rays_;
  int count_;
};

}  // namespace phos::test
