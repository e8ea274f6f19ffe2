// How a film's records are made, besides how each of them is.
#pragma once

#include <cstdint>
#include <optional>

#include "core/options.h"
#include "estimate/record_options.h"
#include "temporal/film/cache.h"

namespace phos::inline temporal {

/// What decides at which frames the light of a place is computed.
enum class Lives {
  midpoint,  ///< every max_life frames, and in the middle of any two where interpolation proves wrong there
  rate,      ///< after as many frames as the change expected from one frame to the next allows
             ///< (docs/methods.md#f4)
};
/// How a record is expected to be one frame on.
enum class LookAhead {
  none,       ///< as it is: lives are max_life
  reproject,  ///< the hits of its rays, moved and lit as they then are (docs/methods.md#f6)
  trace,      ///< by the same rays, or the same drawing, one frame on
};

struct FilmOptions {
  double temporal_accuracy = 0.05;  ///< a_t: relative change of light that may be missed
  std::int64_t max_life = 32;       ///< frames
  Lives lives = Lives::midpoint;
  TemporalGradients gradients = TemporalGradients::interpolated;
  LookAhead look_ahead = LookAhead::reproject;  ///< with Lives::rate
  std::int64_t checks = 1;  ///< halvings of max_life that are made whatever they show; with Lives::midpoint
  std::int64_t fade = 4;    ///< frames: of a place's first record in, of its last one out
  std::int64_t source_life = 8;  ///< frames between those at which photons are traced for rays and rasters
  std::int64_t photons =
      100'000;  ///< paths traced at each of those, or at each frame with estimates from photons

  /// Films of radiance are checked twice if nothing is given, and a raster looks ahead by LookAhead::trace.
  /// Throws Error(usage) for options that do not go together.
  void resolve(const Options& given, Estimate estimate, bool of_radiance);
};
void declare_options(Options& options, FilmOptions& film);

}  // namespace phos::inline temporal
