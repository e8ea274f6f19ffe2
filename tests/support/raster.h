// How drawn hemispheres and the gathered ones that judge them are made.
#pragma once

#include "estimate/record_options.h"
#include "scene/scene.h"

namespace phos::test {

/// The first bounce, so that neither needs photons; many rays for the judge.
inline RecordOptions raster_options(const Scene& scene, Estimate estimate,
                                    RasterBorder border = RasterBorder::stretch) {
  RecordOptions options;
  options.estimate = estimate;
  options.raster_border = border;
  options.gather_bounces = 1;
  options.rays = 8192;
  options.resolve(scene.bounds.diagonal_m() / 4);
  return options;
}

}  // namespace phos::test
