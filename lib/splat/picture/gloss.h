// The radiance records of a picture, ready to be read.
#pragma once

#include <optional>

#include "core/counters.h"
#include "radiance/gloss_cache.h"
#include "splat/caches.h"
#include "splat/picture/render.h"

namespace phos::inline splat {

/// Who computes the gloss of a picture.
struct PictureGloss {
  std::optional<GlossCache> cache;  ///< nothing: all is traced
  Json report;                      ///< gloss_report(): per glossy material, the choice and its reason
  bool projected = false;           ///< tables were made here, for lack of a .brdf file
};

/// `render` is resolved. Takes the records out of `caches`. Throws Error(mismatch) for records of fewer bands
/// than the tables want, unless `allow_mismatch`: then all bands above count nothing.
PictureGloss gloss_of_picture(const RayScene& rays, SplatCaches& caches, const RenderOptions& render,
                              bool allow_mismatch, Counters& counters);

}  // namespace phos::inline splat
