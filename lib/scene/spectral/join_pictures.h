// The pictures of all triplets of bands, joined.
#pragma once

#include <cstddef>

#include "image/image.h"
#include "scene/spectral/join_parts.h"

namespace phos::inline scene {

/// Pictures as one in linear Rec.709, with the layers that any of them has. Light is the exact sum; a
/// standard error is the greater of two, as if all bands erred alike (they share random numbers) or each on
/// its own; albedo is the colour under D65, and left out where triplets are dark; weight the least; layers
/// without colour (normal, position, Z) must be the same everywhere. Colours beyond Rec.709 keep negative
/// components.
struct JoinedPicture {
  Image image;
  int bands = 0;
  std::size_t beyond = 0;  ///< pixels of the beauty that have such components
};
/// Throws Error(bad_input) for files that are no pictures in bands, Error(mismatch), naming files, for those
/// of another N, scene, program or parameters, for a triplet that is there twice, dark as well or not at all,
/// and for pictures of another size.
JoinedPicture join_pictures(const BandParts& parts);

}  // namespace phos::inline scene
