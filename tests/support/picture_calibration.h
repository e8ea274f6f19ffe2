// How often the truth of a pixel lies within two standard errors that the picture states, over many seeds.
#pragma once

#include <map>
#include <string>

#include "splat/gbuffer.h"
#include "splat/picture/render.h"
#include "support/calibration.h"

namespace phos::test {

/// One scene of known light, drawn again and again with other random numbers. Pixels are seen through their
/// middles, and count where a diffuse surface is lit.
class CalibratedPicture {
 public:
  CalibratedPicture(const AnalyticScene& s, const CalibrationOptions& options)
      : known_(known_light(s)), options_(options), rays_(known_.scene), lights_(known_.scene) {
    const Camera& camera = known_.scene.camera[0];
    const PixelRays pixel_rays(camera, kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        double light = 0;
        SurfacePoint p;
        if (trace(rays_, pixel_rays(x, y, Vec2(0.5f)), p)) {
          const double lx = s.irradiance_lx(p.position, p.normal);
          light = lx * double(known_.scene.material[p.material].kd.y) / std::numbers::pi;
        }
        truth_.push_back(light);
      }
  }

  const std::string& name() const { return known_.name; }

  /// By way of making records, and of direct light.
  void measure(std::uint64_t seed, std::map<std::string, Calibration>& table) const {
    const Lit lit =
        light_up(known_.scene, static_cast<std::int64_t>(double(options_.paths) * known_.paths), seed);
    for (const Estimate estimate : {Estimate::hull, Estimate::gather}) {
      if (estimate == Estimate::gather && !known_.interreflected) continue;  // there are no records
      const IrradianceCache cache = records(lit, estimate, seed);
      for (const DirectBy direct : {DirectBy::traced, DirectBy::interleaved}) {
        const std::string what = std::string(estimate == Estimate::hull ? "hull" : "gather") +
                                 (direct == DirectBy::traced ? ", traced" : ", interleaved");
        add(cache, direct, seed, table[what]);
      }
    }
  }

 private:
  static constexpr int kWidth = 32, kHeight = 24;

  IrradianceCache records(const Lit& lit, Estimate estimate, std::uint64_t seed) const {
    RecordOptions options;
    options.estimate = estimate, options.paths = Quantity::indirect, options.rays = options_.rays;
    options.resolve(known_.scene.bounds.diagonal_m() / 4);
    IrradianceCache cache;
    cache.accuracy = options.accuracy, cache.quantity = Quantity::indirect;
    if (!known_.interreflected) return cache;
    Counters counters;
    const auto place = [&](const Estimator& estimator) {
      place_records(cache, estimator, *lit.rays, options, {},
                    photon_candidates(lit.photons, Quantity::all, seed, options_.candidates), counters);
    };
    if (estimate == Estimate::hull) {
      place(DensityEstimator(lit.photons, *lit.rays, options, seed));
    } else {
      const CoarseLevel coarse(*lit.rays, lit.photons, options, seed);
      place(GatherEstimator(*lit.rays, lights_, coarse.source(), options, seed));
    }
    return cache;
  }

  void add(const IrradianceCache& cache, DirectBy direct, std::uint64_t seed, Calibration& found) const {
    RenderOptions options;
    options.width = kWidth, options.height = kHeight, options.pixel_samples = 1;
    options.splat = SplatBy::cpu, options.direct = direct, options.seed = seed;
    options.layers = {"direct", "indirect", "stderr"};
    resolve(options, known_.scene.camera[0], cache);
    const Image image = render_scene(rays_, cache, options).image;
    const std::vector<Rgb> straight = image.rgb("direct"), indirect = image.rgb("indirect"),
                           error = image.rgb("stderr");
    for (std::size_t i = 0; i < truth_.size(); ++i)
      if (truth_[i] > 0) found.add(double(straight[i].y + indirect[i].y), double(error[i].y), truth_[i]);
  }

  KnownLight known_;
  CalibrationOptions options_;
  RayScene rays_;
  Luminaires lights_;
  std::vector<double> truth_;  // of each pixel, cd/m2; 0: not to be looked at
};

}  // namespace phos::test
