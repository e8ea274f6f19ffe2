// From cd/m2 to the values of a screen.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "image/colour8.h"

namespace phos::inline image {

enum class ToneOperator {
  reinhard,  ///< E. Reinhard et al. 2002, eq. 4: L (1 + L / white^2) / (1 + L)
  filmic,    ///< J. Hable 2010 ("Uncharted 2"), divided by its value at white
  linear,    ///< L / white
};

struct ToneOptions {
  ToneOperator curve = ToneOperator::reinhard;
  double exposure_ev = 0;             ///< stops brighter than automatic, or than `white`
  std::optional<double> white_cd_m2;  ///< luminance that becomes full white; else the 99.5th percentile
  std::optional<double> key_cd_m2;    ///< luminance that becomes a middle grey; else the log average
};

struct ToneMapped {
  Picture picture;
  std::size_t non_finite = 0;  ///< pixels shown as kNotFinite
  double key_cd_m2 = 0;        ///< luminance that becomes a middle grey of 0.18
  double white_cd_m2 = 0;
};

/// The options with everything automatic as it is for these values, so that other pictures are exposed alike.
/// Black values leave them as they are.
ToneOptions fixed_exposure(std::span<const Rgb> values, const ToneOptions& options);

/// The curve works on luminance, colours keep their hue: one that a screen cannot show is mixed with grey of
/// its own luminance. Black images stay black. Negative components count as 0.
ToneMapped tone_map(std::span<const Rgb> values, int width, int height, const ToneOptions& options);

}  // namespace phos::inline image
