#include "place/view_candidates.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "core/parallel.h"
#include "core/sampling.h"
#include "estimate/shading.h"
#include "place/candidates.h"
#include "scene/camera.h"
#include "scene/material/bsdf.h"

namespace phos::inline place {
namespace {

// As phos-splat follows them.
constexpr int kSpecularDepth = ShadingOptions().specular_depth;
constexpr float kLeastThroughput = 1e-4f;
constexpr int kGlossRays = 2;          // of a glossy visible point
constexpr float kLeastCosine = 0.05f;  // of a grazing pixel's patch

/// Number i of a square of 2^level pixels each way, coarse to fine: the first 4^k make the regular grid of
/// 2^k each way. Reads the bits of i two by two, from the lowest, as the bits of x and y from the highest
/// (grid_order() undoes that).
void spread(std::uint64_t i, int level, std::int64_t& x, std::int64_t& y) {
  x = y = 0;
  for (int bit = 0; bit < level; ++bit, i >>= 2) {
    x = 2 * x + static_cast<std::int64_t>(i & 1), y = 2 * y + static_cast<std::int64_t>(i >> 1 & 1);
  }
}

/// The sites that one ray from the eye finds.
class Sight {
 public:
  Sight(const RayScene& rays, const View& view, const CameraRays& eye, const MaterialFilter& wanted,
        const Vec2& st, std::vector<RecordSite>& sites)
      : rays_(rays), view_(view), eye_(eye), wanted_(wanted), st_(st), sites_(sites) {}

  void look(const Ray& ray, float travelled_m, const Rgb& throughput, int depth) {
    SurfacePoint point;
    if (!trace(rays_, ray, point)) return;
    travelled_m += point.distance_m;
    const Bsdf bsdf(rays_.scene(), point);
    if (wanted_ ? wanted_(point.material) : shows_illuminance(point, bsdf))
      add(point, travelled_m, -ray.direction);
    // What comes through a sheet is the light on its other side.
    if (!wanted_ && bsdf.transmits_diffusely()) add(point.other_side(), travelled_m, ray.direction);
    if (bsdf.has_specular()) follow(point, bsdf, -ray.direction, travelled_m, throughput, depth);
    if (depth == 0 && bsdf.has_gloss()) glance(point, bsdf, -ray.direction, travelled_m);
  }

 private:
  /// What reflects diffusely shows it in the picture; a black surface, unless it is a lamp's, as a layer.
  bool shows_illuminance(const SurfacePoint& point, const Bsdf& bsdf) const {
    const bool is_black = !bsdf.scatters() && !bsdf.has_specular();
    return bsdf.has_diffuse() || (is_black && !rays_.scene().material[point.material].emits());
  }

  void add(const SurfacePoint& point, float travelled_m, const Vec3& towards_eye) {
    RecordSite site{point.position, point.smooth_normal};
    if (view_.least_radius_pixels > 0 || view_.most_radius_pixels > 0) {
      const float side =
          pixel_side_m(view_, eye_, st_, travelled_m, glm::dot(point.geometric_normal, towards_eye));
      site.least_radius_m = static_cast<float>(view_.least_radius_pixels) * side;
      if (view_.most_radius_pixels > 0)
        site.most_radius_m = static_cast<float>(view_.most_radius_pixels) * side;
    }
    sites_.push_back(site);
  }

  void follow(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& towards_eye, float travelled_m,
              const Rgb& throughput, int depth) {
    BsdfSample branch[2];
    const int branches = bsdf.specular_branches(towards_eye, branch);
    for (int b = 0; b < branches; ++b) {
      const Rgb carried = throughput * branch[b].weight;
      if (depth >= kSpecularDepth || max_component(glm::abs(carried)) < kLeastThroughput) continue;
      look({point.leave(branch[b].direction), branch[b].direction}, travelled_m, carried, depth + 1);
    }
  }

  /// A few of the directions that gloss shows, the same for every pixel but for its place in the picture.
  void glance(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& towards_eye, float travelled_m) {
    for (int k = 0; k < kGlossRays; ++k) {
      const Vec2 u =
          r2_point(k, Vec2(0.5f)) +
          st_ * Vec2(static_cast<float>(view_.width), static_cast<float>(view_.height)) * 0.618034f;
      BsdfSample sample;
      if (!bsdf.sample_gloss(towards_eye, glm::min(u - glm::floor(u), Vec2(kBelowOne)), sample)) continue;
      look({point.leave(sample.direction), sample.direction}, travelled_m, Rgb(1), 1);
    }
  }

  const RayScene& rays_;
  const View& view_;
  const CameraRays& eye_;
  const MaterialFilter& wanted_;
  const Vec2 st_;
  std::vector<RecordSite>& sites_;
};

/// Placement comes by several times; the sites of a small picture are found once, and lie in memory as one
/// walks over each sample's square of 4^level places, so many places together.
constexpr std::size_t kRemembered = std::size_t{1} << 22, kTogether = 4096;

template <class Sites>
Candidates remember(std::size_t count, int level, const Sites& sites_of) {
  struct Found {
    std::vector<RecordSite> sites;
    std::vector<std::uint32_t> end;  // of each place's sites
  };
  const auto walked = [level, mask = (std::size_t{1} << 2 * level) - 1](std::size_t i) {
    return (i & ~mask) | grid_order(i & mask, level);
  };
  const auto found = std::make_shared<std::vector<Found>>((count + kTogether - 1) / kTogether);
  parallel_chunks(count, kTogether, [&](std::size_t begin, std::size_t end) {
    Found& part = (*found)[begin / kTogether];
    part.sites.reserve(kTogether), part.end.reserve(end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      sites_of(walked(i), part.sites);
      part.end.push_back(static_cast<std::uint32_t>(part.sites.size()));
    }
    part.sites.shrink_to_fit();
  });
  return {count,
          [found, walked](std::size_t i, std::vector<RecordSite>& out) {
            const std::size_t at = walked(i), place = at % kTogether;
            const Found& part = (*found)[at / kTogether];
            const std::uint32_t begin = place == 0 ? 0 : part.end[place - 1];
            out.insert(out.end(), part.sites.begin() + begin, part.sites.begin() + part.end[place]);
          },
          true};
}

CameraRays rays_of(const View& view) {
  return {view.camera, static_cast<float>(view.width) / static_cast<float>(view.height)};
}

}  // namespace

float pixel_side_m(const View& view, const Vec2& st, float travelled_m, float cosine) {
  return pixel_side_m(view, rays_of(view), st, travelled_m, cosine);
}

float pixel_side_m(const View& view, const CameraRays& eye, const Vec2& st, float travelled_m, float cosine) {
  const auto end = [&](const Vec2& at) {
    const Camera::Ray ray = eye(at);
    return DVec3(ray.origin) + static_cast<double>(travelled_m) * DVec3(ray.direction);
  };
  // Over a thousandth of the picture at least: a pixel may be too small for differences of floats.
  const Vec2 pixel(1 / static_cast<float>(view.width), 1 / static_cast<float>(view.height));
  const Vec2 step = glm::max(pixel, Vec2(1e-3f)), pixels = step / pixel;
  const DVec3 across = end(st + Vec2(step.x / 2, 0)) - end(st - Vec2(step.x / 2, 0));
  const DVec3 down = end(st + Vec2(0, step.y / 2)) - end(st - Vec2(0, step.y / 2));
  const auto upright = static_cast<float>(
      std::sqrt(glm::length(glm::cross(across, down)) / static_cast<double>(pixels.x * pixels.y)));
  return upright / std::sqrt(std::max(std::fabs(cosine), kLeastCosine));
}

Candidates view_candidates(const RayScene& rays, const View& view, const MaterialFilter& wanted) {
  const auto longer = static_cast<std::uint64_t>(std::max(view.width, view.height));
  const auto level = static_cast<int>(std::bit_width(longer - 1));
  const std::uint64_t square = std::uint64_t{1} << (2 * level);
  const auto sites = [&rays, view, eye = rays_of(view), wanted, level, square](std::size_t i,
                                                                               std::vector<RecordSite>& out) {
    std::int64_t x, y;
    spread(i % square, level, x, y);
    if (x >= view.width || y >= view.height) return;
    const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
    const Vec2 st = (Vec2(static_cast<float>(x), static_cast<float>(y)) +
                     r2_point(static_cast<int>(i / square), Vec2(0.5f))) /
                    size;
    const Camera::Ray ray = eye(st);
    const std::size_t first = out.size();
    Sight(rays, view, eye, wanted, st, out).look({ray.origin, ray.direction}, 0, Rgb(1), 0);
    // The first few of a pixel's sites have streams of their own; the rest, behind many mirrors, share.
    for (std::size_t k = first; k < out.size(); ++k)
      out[k].item = kViewItems + 16 * i + std::min<std::size_t>(k - first, 15);
  };
  const std::size_t count = kViewSamples * square;
  return count <= kRemembered ? remember(count, level, sites) : Candidates{count, sites, true};
}

}  // namespace phos::inline place
