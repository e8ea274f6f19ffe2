// How much a sequence of images differs from a reference, and how much of that flickers.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "file/frames.h"
#include "image/image.h"
#include "image/metrics.h"

namespace phos::inline image {

/// Differences d = image - reference of one layer (luminance, or its only component), over every pixel of
/// every frame that counts. What changes fast in them is
///
///   h_t = d_t - (d_{t-1} + d_{t+1}) / 2,
///
/// and flicker is sqrt(2/3 mean h^2): s for white noise of standard deviation s, 0 for errors that are
/// constant or drift evenly, 2 s sqrt(2/3) for errors that turn their sign from frame to frame. Noise of the
/// references that differs from frame to frame counts in; with a second reference it averages out.
struct FlickerMetrics {
  std::string layer, unit;  ///< as LayerMetrics
  std::size_t pixels = 0, ignored = 0,
              non_finite = 0;  ///< of all frames: compared; left out by the mask; left out, and a failure
  double reference_mean = 0;   ///< mean |reference|, which relative measures are divided by
  double rmse = 0, relative_rmse = 0, bias = 0, relative_bias = 0;
  double flicker = 0, relative_flicker = 0;  ///< root mean square over pixels and frames
  /// Without the noise of the references: from mean d d' and mean h h', 0 where these are negative.
  std::optional<double> converged_rmse, relative_converged_rmse, converged_flicker,
      relative_converged_flicker;
};

/// The same of one frame. The first and the last have no flicker: NaN.
struct FrameMetrics {
  std::int64_t frame = 0;
  std::string layer;
  double reference_mean = 0, rmse = 0, bias = 0;
  double flicker = std::numeric_limits<double>::quiet_NaN();
};

/// Takes the frames one after another, and holds the differences of three of them.
class FlickerMeter {
 public:
  explicit FlickerMeter(const CompareOptions& options) : options_(options) {}

  /// The frame after those added before; `second` (the reference once more, with another seed) at every frame
  /// or at none. Throws Error(mismatch) as compare_images(), and where size or layers differ from the first
  /// frame; Error(bad_input) for a layer asked for that is no single quantity (normals).
  void add(std::int64_t frame, const Image& image, const Image& reference, const Image* second = nullptr);

  /// One entry per layer. At least three frames, else flicker is 0.
  std::vector<FlickerMetrics> metrics() const;
  /// By frame, then by layer.
  const std::vector<FrameMetrics>& frames() const { return frames_; }
  /// Flicker at each pixel (channel Y of each layer; without the references' noise if there are two).
  Image picture() const;

 private:
  struct Sums {
    double d = 0, dd = 0, reference = 0, converged = 0;
    std::size_t n = 0, n_converged = 0, ignored = 0, non_finite = 0;
  };
  struct Layer {
    std::string name;
    std::vector<std::string> components;
    std::vector<float> d[3], second[3];  ///< of the last three frames, the oldest first; NaN where left out
    std::vector<double> hh, hh_second;   ///< sums at each pixel
    std::vector<std::uint32_t> n, n_second;  ///< of so many frames
    Sums sums;
  };
  void choose_layers(const Image& image, const Image& reference, const Image* second);
  void require_layers(const Image& image, const char* which) const;
  void take(Layer& layer, std::int64_t frame, const Image& image, const Image& reference, const Image* second,
            const std::vector<char>& counts);
  double add_high_frequencies(Layer& layer) const;

  CompareOptions options_;
  int width_ = 0, height_ = 0;
  bool two_references_ = false;
  std::size_t added_ = 0;
  std::vector<Layer> layers_;
  std::vector<FrameMetrics> frames_;
};

/// Reads the frames of sequences one after another. `seconds` may be null. Throws as read_image() and
/// FlickerMeter::add(), naming the file.
FlickerMeter measure_flicker(const FramePattern& images, const FramePattern& references,
                             const FramePattern* seconds, const FrameRange& range,
                             const CompareOptions& options);

/// Flicker at each pixel of a layer (the index of metrics()) in false colours, from 0 to `most`, with a
/// legend.
Picture flicker_picture(const FlickerMeter& meter, std::size_t layer, std::optional<double> most);

Json to_json(const FlickerMetrics& metrics);
/// A table, one row per layer.
std::string to_table(const std::vector<FlickerMetrics>& metrics);
/// CSV: frame, layer, reference_mean, rmse, relative_rmse, bias, relative_bias, flicker, relative_flicker;
/// cells of flicker are empty where there is none.
std::string to_csv(const std::vector<FrameMetrics>& frames);

}  // namespace phos::inline image
