#include "radiance/brdf/lamp_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/counters.h"
#include "core/error.h"
#include "core/parallel.h"
#include "core/text/quantity.h"
#include "radiance/brdf/harmonic_reflection.h"
#include "scene/camera.h"
#include "scene/limits.h"
#include "scene/load.h"
#include "scene/material/bsdf.h"
#include "scene/picture.h"
#include "scene/report/describe.h"

namespace phos::inline radiance {

namespace {

constexpr int kRows = 3;  // exact, HSH, SH
constexpr BasisKind kBases[] = {BasisKind::hsh, BasisKind::sh};

/// One material: exactly, and through each kind of harmonics by order.
struct Lit {
  std::uint32_t material;
  Bsdf exact;
  std::vector<HarmonicReflection> through;  // order by order, HSH before SH
};

/// What the samples of one material add up to for one kind of harmonics.
struct Difference {
  double squares = 0, sum = 0, most = 0, least = 0;
  std::uint64_t samples = 0, traced = 0;
  void add(float exact, float through) {
    const double e = static_cast<double>(exact), t = static_cast<double>(through);
    const double off = std::max(t, 0.0) - e;
    squares += off * off, sum += e, ++samples;
    most = std::max(most, e), least = std::min(least, t);
  }
  void merge(const Difference& d) {
    squares += d.squares, sum += d.sum, samples += d.samples, traced += d.traced;
    most = std::max(most, d.most), least = std::min(least, d.least);
  }
};

/// Light of the lamp at a point: lx on a surface that faces it.
struct Arrival {
  Vec3 towards{0};
  float illuminance_lx = 0;
};

/// Infinite beyond the numbers of single precision.
float single(double lux) {
  return lux < static_cast<double>(std::numeric_limits<float>::max()) ? static_cast<float>(lux) : kInfinity;
}

/// Of each picture, pixels.
struct Size {
  std::size_t width, height;
};

Size size_of(const Scene& scene, const LampFigureOptions& figure) {
  std::int64_t width = figure.width, height = 0;
  resolve_size(find_camera(scene, figure.camera), kPictureSide, width, height);
  const std::size_t pictures = kRows * orders_of(figure).size();
  if (static_cast<double>(width) * static_cast<double>(height) * static_cast<double>(pictures) >
      kMostPicturePixels.as<double>())
    throw Error(ExitCode::usage, "--width",
                text(pictures, " pictures of ", width, " x ", height, " pixels are too many; at most ",
                     written(kMostPicturePixels), " in all"));
  return {static_cast<std::size_t>(width), static_cast<std::size_t>(height)};
}

class Drawer {
 public:
  Drawer(const RayScene& rays, const LampFigureOptions& figure, int resolution)
      : rays_(rays),
        figure_(figure),
        lamp_(lamp_of(figure)),
        orders_(orders_of(figure)),
        camera_(find_camera(rays.scene(), figure.camera)) {
    const Size size = size_of(rays.scene(), figure);
    width_ = size.width, height_ = size.height;
    project(resolution);
  }

  LampFigure draw() {
    const std::size_t columns = orders_.size();
    std::vector<Rgb> sheet(width_ * height_ * columns * kRows, Rgb(0));
    const std::size_t kinds = lit_.size() * through_each();
    using Differences = std::vector<Difference>;
    const Differences all = parallel_reduce(
        height_, 1, Differences(kinds),
        [&](std::size_t begin, std::size_t end) {
          Differences part(kinds);
          for (std::size_t row = begin; row < end; ++row)
            for (std::size_t column = 0; column < width_; ++column) pixel(row, column, sheet, part);
          return part;
        },
        [](Differences& total, const Differences& part) {
          for (std::size_t i = 0; i < total.size(); ++i) total[i].merge(part[i]);
        });
    LampFigure drawn{.image = Image(static_cast<int>(width_ * columns), static_cast<int>(height_ * kRows)),
                     .errors = {}};
    if (std::any_of(sheet.begin(), sheet.end(), [](const Rgb& c) { return !is_finite(c); }))
      throw Error(
          ExitCode::numerical, figure_.lamp.empty() ? "--figure-lamp-from" : "--figure-lamp",
          "the light is not finite: the lamp lies on a surface, or is too strong; move it, or lower it");
    drawn.image.set_rgb("", sheet);
    std::string names;
    for (const int order : orders_) names += text(names.empty() ? "" : ",", order);
    drawn.image.attributes["phos.figure"] = text("rows: exact, HSH, SH; columns: orders ", names);
    for (std::size_t i = 0; i < kinds; ++i) drawn.errors.push_back(error_of(i, all[i]));
    return drawn;
  }

 private:
  std::size_t through_each() const { return orders_.size() * std::size(kBases); }

  void project(int resolution) {
    const Scene& scene = rays_.scene();
    const std::vector<MaterialSummary> all = summarize_materials(scene);
    lit_of_.assign(scene.material.size(), -1);
    for (std::uint32_t m = 0; m < scene.material.size(); ++m) {
      const Bsdf exact(scene, m);
      if (all[m].triangles == 0 || !exact.scatters()) continue;
      lit_of_[m] = static_cast<std::int32_t>(lit_.size());
      Lit& lit = lit_.emplace_back(Lit{m, exact, {}});
      Counters told;  // FigureError::traced tells of lobes that are not resolved
      for (const int order : orders_)
        for (const BasisKind basis : kBases)
          lit.through.emplace_back(scene, m,
                                   ReflectionHarmonics{.basis = basis,
                                                       .order = order,
                                                       .cosine = figure_.weight == FigureWeight::cosine,
                                                       .resolution = resolution,
                                                       .rotation = figure_.rotation},
                                   told);
    }
  }

  /// Infinite where the lamp lies on the surface.
  Arrival arrival(const SurfacePoint& point) const {
    if (lamp_.far) return {Vec3(lamp_.at), single(lamp_.strength)};
    const DVec3 way = lamp_.at - (rays_.scene().origin_m + DVec3(point.position));
    const double length = glm::length(way);
    if (length <= static_cast<double>(point.error_m)) return {point.normal, kInfinity};
    return {Vec3(way / length), single(lamp_.strength / (length * length))};
  }

  void pixel(std::size_t row, std::size_t column, std::vector<Rgb>& sheet,
             std::vector<Difference>& differences) const {
    const Vec2 size(static_cast<float>(width_), static_cast<float>(height_));
    const Vec2 corner(static_cast<float>(column), static_cast<float>(row));
    const auto samples = static_cast<int>(figure_.pixel_samples);
    Rgb exact_sum(0);
    std::vector<Rgb> through_sum(through_each(), Rgb(0));
    for (int s = 0; s < samples; ++s) {
      const Camera::Ray eye = camera_.ray((corner + subpixel_offset(s, samples)) / size, size.x / size.y);
      SurfacePoint point;
      if (!trace(rays_, {eye.origin, eye.direction}, point)) continue;
      const std::int32_t lit = lit_of_[point.material];
      if (lit >= 0)
        sample(static_cast<std::size_t>(lit), point, -eye.direction, exact_sum, through_sum, differences);
    }
    const float share = 1 / static_cast<float>(samples);
    const std::size_t columns = orders_.size(), line = width_ * columns;
    for (std::size_t k = 0; k < columns; ++k) {
      const std::size_t at = row * line + k * width_ + column, below = height_ * line;
      sheet[at] = share * exact_sum;
      for (std::size_t b = 0; b < std::size(kBases); ++b)
        sheet[at + (b + 1) * below] = share * through_sum[k * std::size(kBases) + b];
    }
  }

  void sample(std::size_t lit, const SurfacePoint& point, const Vec3& towards_eye, Rgb& exact_sum,
              std::vector<Rgb>& through_sum, std::vector<Difference>& differences) const {
    const Arrival light = arrival(point);
    if (!std::isfinite(light.illuminance_lx)) {
      exact_sum = Rgb(kInfinity);  // draw() refuses it
      return;
    }
    const Frame frame{point.tangent, glm::cross(point.normal, point.tangent), point.normal};
    const Vec3 wo = frame.to_local(towards_eye), wi = frame.to_local(light.towards);
    const bool dark = !(wo.z > 0) || wi.z <= 0 || glm::dot(point.geometric_normal, light.towards) <= 0;
    const Rgb exact = dark ? Rgb(0) : lit_[lit].exact.evaluate(wo, wi) * wi.z * light.illuminance_lx;
    exact_sum += exact;
    for (std::size_t k = 0; k < through_each(); ++k) {
      Difference& difference = differences[lit * through_each() + k];
      const std::optional<Rgb> value = dark ? Rgb(0) : lit_[lit].through[k](wo, wi);
      difference.traced += !value;
      const Rgb through = value.value_or(Rgb(0)) * light.illuminance_lx;
      difference.add(luminance(exact), luminance(through));
      through_sum[k] += glm::max(through, Rgb(0));
    }
  }

  FigureError error_of(std::size_t i, const Difference& d) const {
    const std::size_t lit = i / through_each(), k = i % through_each();
    FigureError e;
    const std::uint32_t material = lit_[lit].material;
    e.material = rays_.scene().material[material].name;
    if (e.material.empty()) e.material = text("material ", material);
    e.basis = kBases[k % std::size(kBases)], e.order = orders_[k / std::size(kBases)];
    e.samples = d.samples, e.traced = d.traced;
    const auto n = static_cast<double>(d.samples);
    if (d.samples > 0) e.mean_cd_m2 = d.sum / n;
    if (d.sum > 0) e.relative_rmse = std::sqrt(d.squares / n) / (d.sum / n);
    if (d.most > 0) e.least = d.least / d.most;
    return e;
  }

  const RayScene& rays_;
  const LampFigureOptions& figure_;
  FigureLamp lamp_;
  std::vector<int> orders_;
  const Camera& camera_;
  std::size_t width_ = 0, height_ = 0;
  std::vector<Lit> lit_;
  std::vector<std::int32_t> lit_of_;  // per material; -1: the material does not scatter
};

}  // namespace

void require_drawable(const Scene& scene, const LampFigureOptions& figure) { size_of(scene, figure); }

LampFigure draw_lamp_figure(const RayScene& rays, const LampFigureOptions& figure, int resolution) {
  return Drawer(rays, figure, resolution).draw();
}

std::string sentence_of(const FigureError& hsh, const FigureError& sh) {
  if (!(hsh.mean_cd_m2 > 0))
    return text('"', hsh.material,
                hsh.samples > 0 ? "\": the lamp does not light this material" : "\": not in the picture");
  std::string out =
      text('"', hsh.material, "\", order ", hsh.order, ": HSH err by ", percent_to_tenths(hsh.relative_rmse),
           " of the mean luminance (RMS), SH by ", percent_to_tenths(sh.relative_rmse));
  if (hsh.least < 0 || sh.least < 0)
    out += text("; they ring down to ", percent_to_tenths(hsh.least), " and ", percent_to_tenths(sh.least),
                " of the greatest luminance, and are cut off at 0");
  return out;
}

Json figures_of(const FigureError& e) {
  Json j;
  j["material"] = e.material;
  j["basis"] = e.basis == BasisKind::hsh ? "hsh" : "sh";
  j["order"] = e.order;
  j["samples"] = e.samples;
  j["mean_cd_m2"] = e.mean_cd_m2;
  j["relative_rmse"] = e.relative_rmse;
  j["least"] = e.least;
  j["traced"] = e.traced;
  return j;
}

}  // namespace phos::inline radiance
