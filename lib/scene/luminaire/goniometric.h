// The polar plot of a luminaire's intensities.
#pragma once

#include "image/plot/polar_plot.h"
#include "scene/luminaire/photometric_file.h"

namespace phos::inline scene {

/// Planes C0-C180 and C90-C270 (C0 and C90 to the right), cd, with the luminaire's figures below. `absent` is
/// the title where the file states no name.
PolarPlot goniometric_plot(const PhotometricFile& file, const std::string& absent);

}  // namespace phos::inline scene
