// What a reference picture is asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/options.h"
#include "reference/eye_path_tracer.h"
#include "reference/map/map_options.h"
#include "reference/method.h"
#include "scene/scene.h"

namespace phos::inline reference {

struct ReferenceOptions {
  std::string camera;  ///< "" = the scene's first
  std::int64_t width = 0,
               height = 0;    ///< 0 = from the other and the camera's aspect (both 0: 512 on the longer side)
  std::int64_t samples = 64;  ///< a pixel (or a point); at most, where `error` is given
  std::optional<double> error;  ///< stop once ReferencePicture::error is at most this, and to be trusted
  bool adaptive = false;        ///< shares samples out by noise: `samples` are the mean (sample_shares.h)
  bool illuminance = false;     ///< also the illuminance.Y layer (one more path a sample)
  std::uint64_t seed = 0;
  ReferenceMethod method = ReferenceMethod::path;
  PathOptions path;
  MapOptions map;
};

/// The options of the command line, but the seed.
void declare_options(Options& options, ReferenceOptions& reference);

/// Fills width and height in. Throws Error(usage) for a picture of more than 2^28 pixels.
void resolve_size(ReferenceOptions& reference, const Camera& camera);

}  // namespace phos::inline reference
