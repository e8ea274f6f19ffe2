#include "splat/picture/overlay.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"
#include "image/false_colour.h"
#include "image/tone_map.h"
#include "splat/gbuffer.h"
#include "splat/projection.h"
#include "splat/tiles.h"

namespace phos::inline splat {
namespace {

// Of a picture of 1000 pixels on its longer side; larger ones get larger marks.
constexpr float kLinePixels = 1.1f, kDotPixels = 3.2f, kRimPixels = 1.2f;
constexpr float kLineOpacity = 0.85f;
/// A record is hidden if something stands before it by more than this share of its distance.
constexpr double kInFront = 1e-3;
constexpr float kBrightest = 0.85f;  // of a screen's white
// What lies below is shown as a darker, greyer picture, so that colours are the marks' own.
constexpr float kGrey = 0.75f, kDimmed = 0.35f;
constexpr double kOutliers = 0.01;  // share of the marks beyond either end of the colours

float srgb_to_linear(std::uint8_t code) {
  const float v = static_cast<float>(code) / 255;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// The luminance that the tone mapping shows as `screen` (0..1): Reinhard's curve turned over.
float scene_luminance(float screen, float key_cd_m2) {
  constexpr float kMiddleGrey = 0.18f;
  const float relative = std::min(screen, kBrightest);
  return relative / (1 - relative) * key_cd_m2 / kMiddleGrey;
}

/// A record that can be seen.
struct Mark {
  const IrradianceRecord* record;
  PixelRect zone;
  Vec2 pixel;  // of its place, in pixels from the top left corner
  float value;
  bool lasting = false;  // without a life, where lives are told
  Rgb colour{0};
};

class Drawing {
 public:
  Drawing(int width, int height, double accuracy, const RayScene& rays, const Camera& camera)
      : width_(width),
        height_(height),
        accuracy_(static_cast<float>(accuracy)),
        scale_(std::max(1.f, static_cast<float>(std::max(width, height)) / 1000)),
        rays_(rays),
        projection_(camera, width, height),
        gbuffer_(trace_gbuffer(rays, camera, width, height, {0.5f, 0.5f})) {}

  /// Where the record falls on the picture; false if it is hidden or outside.
  bool place(const IrradianceRecord& r, Vec2& pixel) const {
    const DVec3 way = DVec3(r.position) - projection_.eye(), v = projection_.axes() * way;
    const double depth = -v.z, unit = projection_.perspective() ? depth : 1;
    const DVec3 back = projection_.perspective() ? way : glm::transpose(projection_.axes()) * DVec3(0, 0, -1);
    if (!(depth > 0) || glm::dot(back, DVec3(r.normal)) >= 0) return false;
    const double x = 0.5 + 0.5 * v.x / (unit * projection_.half_width());
    const double y = 0.5 - 0.5 * v.y / (unit * projection_.half_height());
    if (!(x >= 0 && x < 1 && y >= 0 && y < 1)) return false;
    pixel = Vec2(static_cast<float>(x * width_), static_cast<float>(y * height_));
    const DVec3 direction = glm::normalize(back);
    const double distance = projection_.perspective() ? glm::length(way) : depth;
    Ray ray;
    ray.origin = Vec3(DVec3(r.position) - distance * direction), ray.direction = Vec3(direction);
    ray.t_max_m = static_cast<float>((1 - kInFront) * distance);
    return !rays_.occluded(ray);
  }

  void draw_zones(std::span<const Mark> marks, std::span<Rgb> picture) const {
    each_row(marks, picture, [&](const Mark& m, int y, std::span<Rgb> row) {
      if (y < m.zone.y0 || y >= m.zone.y1) return;
      for (int x = m.zone.x0; x < m.zone.x1; ++x)
        mix(row[static_cast<std::size_t>(x)], m.colour, kLineOpacity * on_outline(*m.record, x, y));
    });
  }

  void draw_dots(std::span<const Mark> marks, std::span<Rgb> picture) const {
    const float dot = kDotPixels * scale_, rim = dot + kRimPixels * scale_;
    each_row(marks, picture, [&](const Mark& m, int y, std::span<Rgb> row) {
      const float dy = static_cast<float>(y) + 0.5f - m.pixel.y;
      if (std::fabs(dy) > rim + 1) return;
      const int x0 = std::max(0, static_cast<int>(m.pixel.x - rim - 1));
      const int x1 = std::min(width_, static_cast<int>(m.pixel.x + rim + 2));
      for (int x = x0; x < x1; ++x) {
        const float r = std::hypot(static_cast<float>(x) + 0.5f - m.pixel.x, dy);
        mix(row[static_cast<std::size_t>(x)], Rgb(0), inside(rim - r));
        mix(row[static_cast<std::size_t>(x)], m.colour, inside(dot - r));
      }
    });
  }

 private:
  /// Share of a pixel within an edge that lies `pixels` beyond its centre.
  static float inside(float pixels) { return std::clamp(pixels + 0.5f, 0.f, 1.f); }
  static void mix(Rgb& under, const Rgb& over, float share) { under += share * (over - under); }

  /// Rows side by side; each draws all marks in their order.
  template <class Draw>
  void each_row(std::span<const Mark> marks, std::span<Rgb> picture, const Draw& draw) const {
    const auto width = static_cast<std::size_t>(width_);
    parallel_for(static_cast<std::size_t>(height_), 8, [&](std::size_t y) {
      for (const Mark& m : marks) draw(m, static_cast<int>(y), picture.subspan(y * width, width));
    });
  }

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  float error_at(const IrradianceRecord& r, std::size_t i) const {
    return record_error(r, Vec3(gbuffer_.position[i]), Vec3(gbuffer_.normal[i]));
  }

  /// Change of the record's error to the neighbours at i - step and i + step: the lesser of the two, as the
  /// other may lie on another surface.
  float change(const IrradianceRecord& r, std::size_t i, std::size_t step, bool before, bool after,
               float here) const {
    float least = kInfinity;
    if (before && gbuffer_.covered(i - step)) least = std::fabs(error_at(r, i - step) - here);
    if (after && gbuffer_.covered(i + step)) least = std::min(least, std::fabs(error_at(r, i + step) - here));
    return std::isfinite(least) ? least : 0;
  }

  /// Share of the pixel that the outline of the record's zone covers.
  float on_outline(const IrradianceRecord& r, int x, int y) const {
    const std::size_t i = at(x, y);
    if (!gbuffer_.covered(i)) return 0;
    const float here = error_at(r, i), off = std::fabs(here - accuracy_);
    // No pixel is as wide as this; most are ruled out at once.
    if (off > 0.5f * accuracy_ || record_apart(r, Vec3(gbuffer_.position[i]), Vec3(gbuffer_.normal[i])))
      return 0;
    const float dx = change(r, i, 1, x > 0, x + 1 < width_, here);
    const float dy = change(r, i, static_cast<std::size_t>(width_), y > 0, y + 1 < height_, here);
    const float per_pixel = std::hypot(dx, dy);
    return per_pixel > 0 ? inside(0.5f * kLinePixels * scale_ - off / per_pixel) : 0.f;
  }

  int width_, height_;
  float accuracy_, scale_;
  const RayScene& rays_;
  Projection projection_;
  GBuffer gbuffer_;
};

float value_of(const IrradianceRecord& r, OverlayColour colour) {
  if (colour == OverlayColour::radius) return r.radius_m;
  const float light = luminance(r.irradiance);
  return light > 0 ? luminance(r.stderr_lx) / light : 0;
}

/// Values of the first and last colour.
DrawnRecords scale_of(const std::vector<Mark>& marks, OverlayColour colour, const RecordLives& lives) {
  DrawnRecords drawn{.count = marks.size()};
  if (colour == OverlayColour::life) {
    drawn.least = 1, drawn.most = static_cast<double>(lives.most);
    return drawn;
  }
  std::vector<double> values;
  for (const Mark& m : marks)
    if (m.value > 0) values.push_back(static_cast<double>(m.value));
  std::sort(values.begin(), values.end());
  if (!values.empty()) {
    const auto out = static_cast<std::size_t>(kOutliers * static_cast<double>(values.size()));
    drawn.least = values[out], drawn.most = values[values.size() - 1 - out];
  }
  return drawn;
}

/// Colours from least to most; values beyond look like these. Values without a logarithm are least.
void paint(std::vector<Mark>& marks, const OverlayColourRow& row, const DrawnRecords& drawn) {
  for (Mark& m : marks) {
    double t = 0;
    if (static_cast<double>(m.value) > drawn.least && drawn.most > drawn.least)
      t = std::log(static_cast<double>(m.value) / drawn.least) / std::log(drawn.most / drawn.least);
    m.colour = scene_colour(m.lasting ? Colour8{255, 255, 255} : row.at(std::min(t, 1.0)), drawn.key_cd_m2);
  }
}

}  // namespace

const OverlayColourRow& row_of(OverlayColour colour) {
  return *std::find_if(std::begin(kOverlayColours), std::end(kOverlayColours),
                       [colour](const OverlayColourRow& row) { return row.colour == colour; });
}

Colour8 blue_to_red(double t) { return palette_colour(Palette::turbo, 0.1 + 0.76 * t); }

Colour8 red_to_green(double t) {
  // Dark enough that no picture shows them as white.
  constexpr double kStops[3][3] = {{160, 28, 22}, {160, 108, 12}, {14, 104, 36}};
  const int from = t < 0.5 ? 0 : 1;
  Colour8 colour;
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(
        std::lerp(kStops[from][c], kStops[from + 1][c], std::clamp(2 * t - from, 0.0, 1.0)) + 0.5);
  return colour;
}

Rgb scene_colour(const Colour8& code, double key_cd_m2) {
  const Rgb screen(srgb_to_linear(code[0]), srgb_to_linear(code[1]), srgb_to_linear(code[2]));
  const float y = luminance(screen);
  return y > 0 ? screen * (scene_luminance(y, static_cast<float>(key_cd_m2)) / y) : Rgb(0);
}

DrawnRecords draw_records(Image& image, std::span<const IrradianceRecord> records, double accuracy,
                          const RayScene& rays, const Camera& camera, OverlayColour colour,
                          const RecordLives& lives) {
  PHOS_CHECK(colour != OverlayColour::life || lives.frames.size() == records.size(), lives.frames.size(),
             " lives of ", records.size(), " records");
  const int width = image.width(), height = image.height();
  const Drawing drawing(width, height, accuracy, rays, camera);
  const std::vector<PixelRect> zones = record_bounds(records, accuracy, camera, width, height);
  std::vector<Mark> marks;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool told = colour == OverlayColour::life;
    Mark mark{
        &records[i], zones[i], {}, told ? static_cast<float>(lives.frames[i]) : value_of(records[i], colour)};
    mark.lasting = told && lives.frames[i] == 0;
    if (drawable(records[i]) && drawing.place(records[i], mark.pixel)) marks.push_back(mark);
  }
  std::vector<Rgb> picture = image.rgb("");
  const double key = tone_map(picture, width, height, {}).key_cd_m2;
  DrawnRecords drawn = scale_of(marks, colour, lives);
  drawn.key_cd_m2 = key > 0 ? key : 1;
  paint(marks, row_of(colour), drawn);
  for (Rgb& under : picture) under = kDimmed * glm::mix(under, Rgb(luminance(under)), kGrey);
  drawing.draw_zones(marks, picture);
  drawing.draw_dots(marks, picture);
  image.set_rgb("", picture);
  return drawn;
}

}  // namespace phos::inline splat
