// How a figure of reflection through harmonics is drawn, and the lamp that lights it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/options.h"
#include "core/vector.h"
#include "hsh/rotation.h"

namespace phos::inline radiance {

/// Which function the harmonics of a figure hold.
enum class FigureWeight : unsigned char {
  cosine,  ///< the BRDF times the cosine of the incident direction, as `.brdf` files
  none,    ///< the BRDF alone, which the picture multiplies by the cosine (Gautron et al. 2004, figure 6)
};

struct LampFigureOptions {
  std::string file;  ///< OpenEXR; "": no figure is drawn
  std::string camera;
  std::int64_t width = 400, pixel_samples = 4;
  std::string lamp, lamp_from;  ///< X,Y,Z
  double intensity_cd = 1000, illuminance_lx = 1000;
  std::vector<std::string> orders{"7"};
  FigureWeight weight = FigureWeight::cosine;
  std::optional<HshRotation> rotation;
};
void declare_options(Options& options, LampFigureOptions& figure);

/// Throws Error(usage) for options that exclude or need each other, and for words that are no numbers.
void check_usage(const Options& options, const LampFigureOptions& figure);

/// A point lamp, the same in all directions; without a place, infinitely far.
struct FigureLamp {
  bool far = false;
  DVec3 at{0};          ///< its place, m, world axes; `far`: a unit vector towards it
  double strength = 0;  ///< cd; `far`: lx on a surface that faces it
};
/// Of checked options.
FigureLamp lamp_of(const LampFigureOptions& figure);

/// Of checked options, each once, as they were given: 1 .. 30.
std::vector<int> orders_of(const LampFigureOptions& figure);

}  // namespace phos::inline radiance
