// Irradiance records by drawing the scene over them (docs/methods.md#r1).
#pragma once

#include <cstdint>
#include <memory>

#include "estimate/estimator.h"
#include "estimate/gather_source.h"

namespace phos::inline estimate {
struct Hemisphere;
struct RecordOptions;
}  // namespace phos::inline estimate
namespace phos::inline scene {
class Luminaires;
class RayScene;
}  // namespace phos::inline scene

namespace phos::inline file {
class Tool;
}

namespace phos::inline splat {

/// The scene drawn by OpenGL from the record's place onto one plane above it, of raster_side pixels each way
/// (hemisphere_camera.h); the place that a pixel shows is lit like the place where a gathered ray lands.
/// Without noise but for the lamps' samples: stderr_lx does not contain the light between pixels. With
/// paths = all, direct light at the record is added from samples of the lamps.
class RasterEstimator : public Estimator {
 public:
  /// Draws in the thread that calls this. Throws Error(bad_input) if no OpenGL context can be had,
  /// Error(usage) if the plane has more pixels than it can draw.
  RasterEstimator(const RayScene& rays, const Luminaires& lights, const GatherSource& source,
                  const RecordOptions& resolved, std::uint64_t seed);
  ~RasterEstimator() override;
  std::unique_ptr<Worker> make_worker() const override;
  Made make(const RecordSite& site, Worker& worker) const override;
  bool one_thread() const override { return true; }

  /// What make() is made of: the plane's pixels, drawn and lit.
  void sample(const RecordSite& site, Hemisphere& h, Worker& worker) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Says so where the scene has panes, so that shadow rays stand in for the shadow maps that are asked for.
void tell_raster_light(const Tool& tool, const RayScene& rays, const RecordOptions& records);

/// Adds --estimate raster to the table of estimators (estimate/registry.h), of irradiance and of radiance
/// records.
void register_raster_estimator();

}  // namespace phos::inline splat
