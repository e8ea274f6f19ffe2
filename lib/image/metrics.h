// How much two images differ.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "image/image.h"
#include "image/pu21.h"

namespace phos::inline image {

/// Differences d = image - reference of one layer, over all its components of every pixel that counts.
/// Relative measures are free of the unit. Where the reference is zero everywhere, they are 0 if the image is
/// too, else infinite.
struct LayerMetrics {
  std::string layer;  ///< as the user names it: "beauty", "indirect", "Z", ...
  std::string unit;   ///< "cd/m2", "lx", "m" or "1"
  std::size_t pixels = 0, ignored = 0,
              non_finite = 0;                ///< compared; left out by the mask; left out, and a failure
  std::vector<std::string> components;       ///< "R", "G", "B"
  std::vector<double> mean, reference_mean;  ///< of each component
  double rmse = 0;                           ///< sqrt(mean d^2)
  double relative_rmse = 0;                  ///< rmse / mean |reference|
  double relative_mse = 0;                   ///< mean d^2 / (reference^2 + epsilon^2)
  double mean_relative_error = 0;            ///< mean |d| / (|reference| + epsilon)
  double bias = 0;                           ///< mean d
  double relative_bias = 0;                  ///< bias / mean |reference|
  double p99 = 0;                            ///< 99th percentile of |d|
  double max = 0;                            ///< largest |d|
  double epsilon = 0;          ///< 1 % of mean |reference|: keeps black pixels from ruling relative measures
  std::optional<Pu21> visual;  ///< of layers in cd/m2
  /// Of beauty: share of pixels whose luminance differs by more than 20 % of the reference's (and of epsilon)
  /// and by more than 5 standard errors of both, as far as these have a layer `stderr`.
  std::optional<double> outliers;
  /// rmse and relative_rmse against the limit of the reference, from two references of independent
  /// noise: root of mean (image - reference)(image - second), 0 where that is negative. A pixel that is not
  /// finite in the second counts as equal to it.
  std::optional<double> converged_rmse, relative_converged_rmse;
};

struct CompareOptions {
  std::vector<std::string> layers;  ///< empty: all that both images have
  bool ignore_emission = false;     ///< leave out pixels that show a lamp (emission_mask)
};

/// One entry per layer, in order of name, beauty first. A pixel with a component that is not finite in either
/// image is counted and left out. Throws Error(mismatch) for images of different size, without a common
/// layer, without the asked-for layer, or without `emission` where it is needed (the reference's; failing
/// that, the image's).
/// `second`: the reference once more, made with another seed.
std::vector<LayerMetrics> compare_images(const Image& image, const Image& reference,
                                         const CompareOptions& options, const Image* second = nullptr);

/// The layers that `options` ask for, "" for the beauty, in order. Throws as compare_images().
std::vector<std::string> common_layers(const Image& image, const Image& reference,
                                       const CompareOptions& options);
/// Pictures of one thing and size; null: none.
using Pictures = std::initializer_list<const Image*>;
/// Has any of them the layer `emission`?
bool show_emission(Pictures pictures);
/// 1 where a pixel counts, else 0. With `ignore_emission`, none counts whose `emission` is not black in any
/// of them: few samples miss a lamp at its edge. Throws Error(mismatch) if none has the layer.
std::vector<char> emission_mask(Pictures pictures, bool ignore_emission);

/// The layers of compare_images as pixels of `image - reference`; zero where left out, for a difference
/// picture.
Image difference_image(const Image& image, const Image& reference, const CompareOptions& options);

Json to_json(const LayerMetrics& metrics);
/// A table, one row per layer.
std::string to_table(const std::vector<LayerMetrics>& metrics);

/// Channels without the layer's name: {"R","G","B"}, {"Y"}, {"X","Y","Z"}, {""} for a channel that has no
/// layer ("Z"), and none for a layer that is not there.
std::vector<std::string> components_of(const Image& image, const std::string& layer);
/// Every layer, also those without R, G and B; "" first.
std::vector<std::string> all_layers(const Image& image);
/// "beauty" for "".
std::string layer_label(const std::string& layer);
/// "" for "beauty".
std::string layer_from_label(const std::string& label);
/// "cd/m2", "lx", "m" or "1", by the layer's name.
std::string layer_unit(const std::string& layer);

}  // namespace phos::inline image
