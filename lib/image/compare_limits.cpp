#include "image/compare_limits.h"

#include <cmath>

#include "core/error.h"
#include "core/text/append_item.h"

namespace phos::inline image {
namespace {

struct Limit {
  const char* option;
  const char* unit;
  const char* help;
  double (*measure)(const LayerMetrics&);                  ///< null: of sequences only
  double (*of_sequence)(const FlickerMetrics&) = nullptr;  ///< null: of two images only
  bool at_least = false;
};

constexpr Limit kTable[] = {
    {"max-rmse", "X", "root mean square difference, in the layer's unit",
     [](const LayerMetrics& m) { return m.rmse; }, [](const FlickerMetrics& m) { return m.rmse; }},
    {"max-relative-rmse", "X", "root mean square difference / mean magnitude of the reference",
     [](const LayerMetrics& m) { return m.relative_rmse; },
     [](const FlickerMetrics& m) { return m.relative_rmse; }},
    {"max-relative-mse", "X", "mean squared relative difference (rel.mse)",
     [](const LayerMetrics& m) { return m.relative_mse; }},
    {"max-relative-error", "X", "mean relative error (rel.err)",
     [](const LayerMetrics& m) { return m.mean_relative_error; }},
    {"max-bias", "X", "absolute value of the mean difference / mean magnitude of the reference",
     [](const LayerMetrics& m) { return std::fabs(m.relative_bias); },
     [](const FlickerMetrics& m) { return std::fabs(m.relative_bias); }},
    {"max-absolute-bias", "X", "absolute value of the mean difference, in the layer's unit",
     [](const LayerMetrics& m) { return std::fabs(m.bias); },
     [](const FlickerMetrics& m) { return std::fabs(m.bias); }},
    {"max-p99", "X", "99th percentile of the absolute differences, in the layer's unit",
     [](const LayerMetrics& m) { return m.p99; }},
    {"max-difference", "X", "largest absolute difference, in the layer's unit",
     [](const LayerMetrics& m) { return m.max; }},
    {"min-pu-psnr", "DB", "least PU21 PSNR of layers in cd/m2",
     [](const LayerMetrics& m) { return m.visual ? m.visual->psnr_db : INFINITY; }, nullptr, true},
    {"min-pu-ssim", "X", "least PU21 SSIM of layers in cd/m2",
     [](const LayerMetrics& m) { return m.visual ? m.visual->ssim : 1.0; }, nullptr, true},
    {"max-outliers", "X",
     "share of pixels whose luminance is off by more than 20 % and by more than 5 standard errors of both "
     "images (layer stderr)",
     [](const LayerMetrics& m) { return m.outliers.value_or(0); }},
    {"max-flicker", "X",
     "with --flicker: flicker / mean magnitude of the reference, without the noise of the references where a "
     "second one is given",
     nullptr,
     [](const FlickerMetrics& m) { return m.relative_converged_flicker.value_or(m.relative_flicker); }},
};

void add(std::string& all, const std::string& what) { append_item(all, what, "; "); }

void judge(std::string& all, const std::string& layer, const Limit& limit, double v, double bound) {
  if (limit.at_least ? v >= bound : v <= bound) return;
  add(all, text(layer, ": ", std::string(limit.option).substr(4), " ", shortest(static_cast<float>(v)),
                " is ", limit.at_least ? "below " : "above ", shortest(bound)));
}

}  // namespace

void CompareLimits::declare(Options& options) {
  static_assert(std::size(kTable) == kLimits);
  for (std::size_t i = 0; i < kLimits; ++i)
    options.number(kTable[i].option, values_[i], kTable[i].unit, kTable[i].help, kNotNegative);
}

void CompareLimits::require_measured(bool sequence) const {
  for (std::size_t i = 0; i < kLimits; ++i) {
    if (!values_[i]) continue;
    const std::string option = text("--", kTable[i].option);
    if (sequence && !kTable[i].of_sequence)
      throw Error(ExitCode::usage, option,
                  "is not measured of sequences; leave it out, or compare frames one by one");
    if (!sequence && !kTable[i].measure)
      throw Error(ExitCode::usage, option, "needs sequences; give --flicker and --frames too");
  }
}

std::string CompareLimits::verdict(std::span<const LayerMetrics> layers) const {
  std::string all;
  for (const LayerMetrics& m : layers) {
    if (m.non_finite > 0) add(all, text(m.layer, ": ", m.non_finite, " pixels are not finite"));
    for (std::size_t i = 0; i < kLimits; ++i)
      if (values_[i]) judge(all, m.layer, kTable[i], kTable[i].measure(m), *values_[i]);
  }
  return all;
}

std::string CompareLimits::verdict(std::span<const FlickerMetrics> layers) const {
  std::string all;
  for (const FlickerMetrics& m : layers) {
    if (m.non_finite > 0) add(all, text(m.layer, ": ", m.non_finite, " pixels are not finite"));
    for (std::size_t i = 0; i < kLimits; ++i)
      if (values_[i]) judge(all, m.layer, kTable[i], kTable[i].of_sequence(m), *values_[i]);
  }
  return all;
}

}  // namespace phos::inline image
