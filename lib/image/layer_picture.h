// Pictures for people of one layer of an image.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/options.h"
#include "image/contouring.h"
#include "image/false_colour.h"
#include "image/tone_map.h"

namespace phos::inline image {

enum class ScaleChoice { automatic, linear, logarithmic };

struct LayerPictureOptions {
  std::string layer = "beauty";
  ToneOptions tone;
  bool false_colour = false;
  ScaleChoice scale = ScaleChoice::automatic;
  Palette palette = Palette::viridis;
  std::optional<double> min, max;
  ContourOptions contours;  ///< drawn by show_image(), declared by their own declare_options()
  bool steady = false;      ///< one of a sequence: the legend is of one size
};
void declare_options(Options& options, LayerPictureOptions& picture);
/// Options::first_given() of these.
std::string given_picture_option(const Options& options);

/// The layer as colours: itself, grey of a single quantity, or directions as 0.5 + 0.5 n. Throws
/// Error(bad_input) for a layer that is absent.
std::vector<Rgb> layer_colours(const Image& image, const std::string& layer);

/// The options with the automatic values of this image, so that every frame of a sequence is shown
/// alike; as they are where the image is black.
LayerPictureOptions fixed_exposure(const Image& image, const LayerPictureOptions& options);

/// Tone mapped (directions: linear, white 1), or in false colours, which count in `non_finite` alone.
ToneMapped layer_picture(const Image& image, const LayerPictureOptions& options);

}  // namespace phos::inline image
