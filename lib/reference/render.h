// A picture by path tracing, or from a photon map, with the standard error of every pixel.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/counters.h"
#include "core/options.h"
#include "image/image.h"
#include "reference/eye_path_tracer.h"
#include "reference/method.h"
#include "reference/render_options.h"
#include "scene/rays.h"
#include "scene/scene.h"

namespace phos::inline reference {

/// Bytes that render_reference() takes for the pixels at most; width and height above 0.
double reference_bytes(const ReferenceOptions& options);

struct ReferencePicture {
  /// R G B; emission, direct, indirect (as in PathSample; glossy and specular where there is any); stderr and
  /// indirect_stderr: standard error per channel; illuminance.Y and illuminance_stderr.Y, lx, of the visible
  /// surface, where asked for; and through the centre of each pixel albedo (diffuse reflectance), normal,
  /// position (m) and Z (distance to the eye, m; 0 where nothing is seen).
  Image image;
  std::int64_t samples = 0;  ///< a pixel, taken; the mean where they are adaptive
  /// RMS over pixels of the standard error of the luminance, over the mean luminance: the relative RMSE that
  /// the picture has against its converged self. Of scattered light: emission is left out of both, as at the
  /// edges of a lamp nothing but the lamp's outline is sampled. 0 for one sample and for a black picture.
  /// Samples are stratified in fours over the pixel, so that this errs, where the picture has edges, on the
  /// high side.
  double error = 0;
  /// Is it to be trusted: do not few bright samples make it, and was there light (central_moments.h, of the
  /// picture as a whole)? Always where the scene has no lamp.
  bool trusted = true;
  Counters counters;  ///< "non-finite sample"
};

/// Box filter of one pixel; width and height above 0. `map`: the light of a method that reads a photon map,
/// null for the others; the noise of its photons is part of the standard errors. Same bytes for any number of
/// threads. Throws Error(numerical) if more than one sample in a million is not finite (such samples are left
/// out).
ReferencePicture render_reference(const RayScene& rays, const Luminaires& luminaires, const Camera& camera,
                                  const ReferenceOptions& options, const MapLight* map = nullptr);

}  // namespace phos::inline reference
