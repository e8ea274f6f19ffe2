// What the runs of all triplets gave, joined: pictures, and readings of sensors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "file/csv.h"
#include "image/image.h"
#include "scene/scene.h"

namespace phos::inline scene {

/// The parts of one N, and the triplets of it that are dark: no lamp shines in them, so that there is no
/// part.
struct BandParts {
  std::vector<std::string> paths;
  std::vector<int> dark;
};

/// Pictures as one in linear Rec.709, with the layers that any of them has. Light is the exact sum; a
/// standard error is the greater of two, as if all bands erred alike (they share random numbers) or each on
/// its own; albedo is the colour under D65, and left out where triplets are dark; weight the least; what has
/// no colour (normal, position, Z) must be the same everywhere. Colours beyond Rec.709 keep negative
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

/// Tables of phos-sense as one: id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx (sums; stderr as
/// above), X_lx,Y_lx,Z_lx (CIE 1931), CCT_K,Duv,Ra (colour_rendering.h; empty where there is none), and each
/// band's share of E, band_1_of_N_lx, ... Throws likewise, for tables of other sensors too.
std::string join_readings(const BandParts& parts);

/// The triplet of such a table by its columns; nothing where it has no bands.
std::optional<BandTriplet> triplet_of(const CsvTable& table);

}  // namespace phos::inline scene
