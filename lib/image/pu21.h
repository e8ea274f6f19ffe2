// Visual difference of pictures in absolute luminance.
#pragma once

#include <span>

namespace phos::inline image {

/// Perceptually uniform value of a luminance in cd/m2 (clamped to 0.005 .. 10,000): R. Mantiuk and M. Azimi,
/// "PU21: A novel perceptually uniform encoding for adapting existing quality metrics for HDR", Picture
/// Coding Symposium 2021, variant "banding + glare". 100 cd/m2 is about 256; a difference of 1 is about as
/// visible everywhere.
double pu21_encode(double luminance_cd_m2);

/// PSNR (dB, peak 256; infinite for equal pictures) and SSIM (1 for equal pictures; Wang et al. 2004:
/// Gaussian window of 1.5 pixels, K1 0.01, K2 0.03) of PU21 values. Rules of thumb: above 45 dB or 0.995 a
/// difference is hard to see.
struct Pu21 {
  double psnr_db = 0, ssim = 0;
};

/// Row-major luminances of width x height, cd/m2, finite. Means are over pixels where `counts` is not 0; the
/// pixels left out should be equal in both pictures. Does not depend on the number of threads.
Pu21 compare_pu21(std::span<const float> luminance, std::span<const float> reference,
                  std::span<const char> counts, int width, int height);

}  // namespace phos::inline image
