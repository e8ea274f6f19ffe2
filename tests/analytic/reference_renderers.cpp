// The path tracer against pictures of the same scenes by another renderer (reference/README.md beside them):
// all bounces, emitters that reflect nothing, first camera, square picture. Skipped where those pictures are
// not there.
#include <gtest/gtest.h>

#include <filesystem>

#include "reference/render.h"
#include "reference/render_options.h"
#include "scene/load.h"

namespace {

using namespace phos;

std::string shared(const std::string& name) {
  const std::string path = std::string(PHOS_SOURCE) + "/../shared/" + name;
  return std::filesystem::exists(path) ? path : "";
}

/// Pixels in whose neighbourhood a lamp is seen: its outline is filtered differently by each renderer.
std::vector<bool> near_lamp(const Image& image) {
  const std::vector<Rgb> emission = image.rgb("emission");
  const int w = image.width(), h = image.height();
  std::vector<bool> near(emission.size());
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (int j = std::max(0, y - 1); j <= std::min(h - 1, y + 1); ++j)
        for (int i = std::max(0, x - 1); i <= std::min(w - 1, x + 1); ++i)
          if (luminance(emission[static_cast<std::size_t>(j * w + i)]) > 0)
            near[static_cast<std::size_t>(y * w + x)] = true;
  return near;
}

/// Means over the pixels away from lamps agree, per channel, within `tolerance` and four standard errors of
/// our mean; and the single pixels differ by no more than our noise explains (theirs is far smaller).
void expect_agreement(const std::string& scene_name, const std::string& picture_name, std::int64_t samples,
                      double tolerance) {
  const std::string scene_path = shared("scenes/" + scene_name),
                    picture_path = shared("reference/" + picture_name);
  if (scene_path.empty() || picture_path.empty())
    GTEST_SKIP() << "no " << scene_name << " and " << picture_name << " here";
  const Scene scene = load_scene(scene_path);
  const Image theirs = read_image(picture_path);
  const RayScene rays(scene);
  const Luminaires luminaires(scene);
  ReferenceOptions options;
  options.width = theirs.width(), options.height = theirs.height(), options.samples = samples;
  options.path.black_emitters = true;
  const Image ours = render_reference(rays, luminaires, scene.camera[0], options).image;
  const auto a = ours.rgb(""), b = theirs.rgb(""), error = ours.rgb("stderr");
  const std::vector<bool> skip = near_lamp(ours);
  for (int k = 0; k < 3; ++k) {
    double sum_a = 0, sum_b = 0, variance = 0, difference2 = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (skip[i]) continue;
      sum_a += a[i][k], sum_b += b[i][k];
      variance += double(error[i][k]) * double(error[i][k]);
      difference2 += double(a[i][k] - b[i][k]) * double(a[i][k] - b[i][k]);
    }
    EXPECT_NEAR(sum_a / sum_b, 1, tolerance + 4 * std::sqrt(variance) / sum_b)
        << scene_name << ", channel " << k;
    EXPECT_LT(4 * std::sqrt(variance) / sum_b, 0.02) << "too noisy to tell";
    EXPECT_LT(std::sqrt(difference2 / variance), 1.15) << scene_name << ", channel " << k;
  }
}

TEST(ReferenceRenderers, CornellBox) {
  expect_agreement("cornell-measured.glb", "cornell-measured_all.exr", 8, 0.005);
}
TEST(ReferenceRenderers, Sponza) { expect_agreement("sponza-flat.glb", "sponza-flat_all.exr", 8, 0.01); }

}  // namespace
