// How far a picture or a table of lux is from a reference, with the reference's own noise taken out.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "image/image.h"

namespace phos::inline study {

/// The error of one result. Differences are d = result - reference, over all components of every place
/// (pixel, sensor) that counts; the reference is the mean of two where there are two. Relative measures are
/// divided by `magnitude`, and are 0 where both are black, infinite where only the reference is.
struct MeasuredError {
  std::string quantity;        ///< "beauty", "indirect", ... or "lux"
  std::string unit;            ///< "cd/m2" or "lx"
  std::size_t places = 0;      ///< compared
  std::size_t left_out = 0;    ///< by the mask of lamps
  std::size_t non_finite = 0;  ///< left out, and a failure
  double magnitude = 0;        ///< mean |reference|
  /// Root of mean d^2 less the variance of the reference; 0 where that is negative.
  double rmse = 0, relative_rmse = 0;
  double bias = 0, relative_bias = 0;   ///< mean d
  double p99 = 0, relative_p99 = 0;     ///< 99th percentile of |d|; the reference's noise is in it
  double max = 0;                       ///< largest |d|; so it is here
  std::optional<double> psnr_db, ssim;  ///< as the eye sees (image/pu21.h); of layers in cd/m2

  // What the reference can tell. Absent where nothing says how noisy it is.
  std::optional<double> noise;       ///< its standard error, RMS over places / magnitude
  std::optional<double> resolution;  ///< least relative_rmse that is told from none: two standard deviations
  std::optional<double> rmse_stderr, bias_stderr;  ///< of the relative ones, by the noise of the reference
  /// Is the error larger than the error that the reference's noise may feign? True where this is not known.
  bool resolved() const { return !resolution || relative_rmse > *resolution; }

  // What the result says of itself. Absent without a layer or column of standard errors.
  std::optional<double> stated;  ///< its standard error, RMS over places / magnitude
  /// Share of values within 2 standard errors, its own and the reference's in quadrature: the latter as it
  /// states it (half the difference of two is one draw, which is too small in half of all places).
  std::optional<double> inside;
};

struct MeasureOptions {
  std::string layer = "beauty";
  bool ignore_lamps = true;  ///< leave out pixels whose layer emission, if any, is not black in one of them
};

/// Error of one layer. Variance of the reference: from `second`, the reference once more with another seed,
/// ((a - b) / 2)^2; without it, from the reference's layer stderr (of the layer indirect: indirect_stderr).
/// Throws Error(mismatch) for images of other sizes or without the layer.
///
/// With two references of noise a, b (deviation s at a pixel) the mean square less the variance is mean
/// (e - a)(e - b) for a true error e: free of bias, and of variance (2 e^2 s^2 + s^4) / n. `resolution` is
/// its deviation at e = 0, doubled, under the root; components of a pixel share paths, so n counts pixels.
MeasuredError measure_picture(const Image& image, const Image& reference, const Image* second = nullptr,
                              const MeasureOptions& options = {});

/// Absent values are left out.
Json to_json(const MeasuredError& error);

}  // namespace phos::inline study
