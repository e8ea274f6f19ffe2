// The readings of sensors in all triplets of bands, joined.
#pragma once

#include <optional>
#include <string>

#include "file/csv.h"
#include "scene/spectral/join_parts.h"

namespace phos::inline scene {

/// Tables of phos-sense as one: id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx (sums; stderr as
/// join_pictures() has it), X_lx,Y_lx,Z_lx (CIE 1931), CCT_K,Duv,Ra (colour_rendering.h; empty where there is
/// none), and each band's share of E, band_1_of_N_lx, ... Throws as join_pictures() does, and for tables of
/// other sensors.
std::string join_readings(const BandParts& parts);

/// The triplet of such a table by its columns; nothing where it has no bands.
std::optional<BandTriplet> triplet_of(const CsvTable& table);

}  // namespace phos::inline scene
