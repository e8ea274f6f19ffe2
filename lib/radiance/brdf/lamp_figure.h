// A scene lit by one point lamp, exactly and through harmonics (Gautron et al. 2004, figure 6).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/json.h"
#include "image/image.h"
#include "radiance/brdf/lamp_figure_options.h"
#include "scene/rays.h"

namespace phos::inline radiance {

/// How far one material's pictures through one kind of harmonics are from the exact one.
struct FigureError {
  std::string material;
  BasisKind basis = BasisKind::hsh;
  int order = 0;
  std::uint64_t samples = 0;  ///< of pixels that see the material
  double mean_cd_m2 = 0;      ///< exact luminance
  double relative_rmse = 0;   ///< of the luminance drawn, over that mean; 0 where the mean is 0
  double least = 0;           ///< least luminance before it is cut off at 0, over the greatest exact one
  std::uint64_t traced = 0;   ///< samples that are black, as their lobe was too intricate to project
};

struct LampFigure {
  /// Beauty, cd/m2: from above exact, HSH, SH; a column for each order.
  Image image;
  std::vector<FigureError> errors;  ///< by material, order, HSH before SH
};

/// Throws Error(usage) for more than 2^28 pixels, or a camera that the scene has not; Error(bad_input) for a
/// scene without camera. `figure` must be checked.
void require_drawable(const Scene& scene, const LampFigureOptions& figure);

/// Draws every material by its whole BRDF without delta lobes, its textures at their mean. Nothing casts a
/// shadow; a surface that the lamp is not above (its triangle and its shading normal) is black in every
/// picture. Harmonics below 0 are cut off at 0. `resolution`: of the tables of directions of view. `figure`
/// must be checked. Throws as require_drawable() does, and Error(numerical) for a lamp that lies on a
/// surface. Parallel; the same bytes on any number of threads.
LampFigure draw_lamp_figure(const RayScene& rays, const LampFigureOptions& figure, int resolution);

/// "floor": order 7: ...
std::string sentence_of(const FigureError& hsh, const FigureError& sh);
/// For --stats.
Json figures_of(const FigureError& error);

}  // namespace phos::inline radiance
