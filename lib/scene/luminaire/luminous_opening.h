// The luminous opening of a luminaire: its shape, as files state it, and its surface.
#pragma once

#include <string>

#include "core/vector.h"
#include "scene/load_mesh.h"
#include "scene/luminaire/photometry.h"

namespace phos::inline scene {

/// Centred at the photometric centre, in the luminaire's axes (photometry.h). One size may be 0: a flat one.
struct LuminousOpening {
  enum class Form { point, box, cylinder_x, cylinder_y, cylinder_z, ellipsoid };
  Form form = Form::point;
  Vec3 size_m{0};  ///< along x (C0), y (C90), z
  /// "rectangle 1.2 x 0.3 m", "disc 0.2 m across", ...
  std::string describe() const;
};

/// As LM-63 codes it: by the signs of width (along C90), length (along C0) and height. Until 1995 the table
/// was another one (`from_2002` false); where the two do not contradict each other both are read. One that
/// has no area (a line) becomes a point.
LuminousOpening lm63_opening(const DVec3& width_length_height_m, bool from_2002);
/// Of a length along C90, a width along C0 (0: round, the length its diameter) and a height of sides.
LuminousOpening eulumdat_opening(double length_m, double width_m, double height_m);

/// Its surface, closed and convex, fronts outside; of a flat one a sheet that faces where the distribution
/// shines (down, or towards C0 if it stands upright), slightly before its centre, so that a ceiling in which
/// it lies does not hide it. Round ones are polygons of their area; an ellipsoid has a polyhedron's.
/// `both_sides`: a flat one that shines on both. Not for a point.
MeshData opening_mesh(const LuminousOpening& opening, const Photometry& photometry, bool& both_sides);

}  // namespace phos::inline scene
