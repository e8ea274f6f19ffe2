#include "scene/material/passage.h"

#include <algorithm>
#include <cmath>

#include "scene/material/models.h"

namespace phos::inline scene {
namespace {

/// Faces are parallel up to 2 mrad: wedges of less bend light by less than that.
constexpr float kParallel = 1 - 2e-6f;
/// Panes are next to each other where their distance is at most this part of their size: light that goes to
/// and fro between them is then nowhere else than light that does not.
constexpr float kNextToEachOther = 0.1f;
/// Of two hits at one place of one instance, one counts: they are of triangles that share an edge there.
constexpr float kSamePlace = 4;  // rounding errors

bool parallel(const Vec3& a, const Vec3& b) { return std::fabs(glm::dot(a, b)) >= kParallel; }

/// Side of a square as large as the instance, m.
float size_m(const Scene& scene, const Instance& instance) {
  double sum = 0;
  constexpr std::uint32_t kEnough = 64;  // triangles: a pane has few
  for (std::uint32_t t = 0; t < std::min(instance.triangle_count, kEnough); ++t)
    sum += static_cast<double>(area_m2(scene, instance.first_triangle + t));
  return static_cast<float>(std::sqrt(sum));
}

}  // namespace

bool passes_straight(const Scene& scene, const Material& m) {
  if (m.alpha_mode == Material::Alpha::blend) {
    if (m.alpha < 1 || !scene.colour.empty()) return true;
    if (m.base_colour.used()) {
      const Texture& t = scene.texture[static_cast<std::size_t>(m.base_colour.texture)];
      for (std::size_t i = 0; i < t.size(); ++i)
        if (t.texel(i).w < 1) return true;
    }
  }
  const Passage passage = row_of(m).passage;
  return passage == Passage::pane || (passage == Passage::sheet && m.transmission > 0);
}

bool transmits(const Scene& scene, const Material& m) {
  return is_solid_glass(m) || passes_straight(scene, m);
}

void StraightLight::add(const Crossing& crossing, const Vec3& direction) {
  const Vec3& normal = crossing.point.normal;
  if (normal_ != Vec3(0) && !parallel(normal_, normal)) {
    before_ *= 0.5f * (pass_[0] + pass_[1]);
    pass_[0] = pass_[1] = Rgb(1);
    parallel_ = false;
  }
  normal_ = normal;
  cosine_ = std::fabs(glm::dot(normal, direction));
  for (int k = 0; k < 2; ++k) pass_[k] *= crossing.layer.pass[k];
  if (crossing.plate_m > 0) plate_.push_back({crossing.plate_m, crossing.plate_ior});
}

float StraightLight::nearer(float distance_m) const {
  if (plate_.empty() || !parallel_ || !std::isfinite(distance_m)) return 1;
  // Where a ray at angle i arrives, over its tangent: rho = tan i (air + sum of d cos i / (n cos t)).
  const auto c0 = static_cast<double>(cosine_), distance = static_cast<double>(distance_m);
  const double height = c0 * distance, rho = std::sqrt(std::max(0.0, 1 - c0 * c0)) * distance;
  double air = height;
  for (const Plate& p : plate_) air -= static_cast<double>(p.thickness_m);
  if (!(air > 0) || !(c0 > 0)) return 1;
  struct Place {
    double rho, slope;  // of a ray of angle i, and its derivative
  };
  const auto place = [&](double i) {
    const double c = std::cos(i), s = std::sin(i);
    Place at{air * s / c, air / (c * c)};
    for (const Plate& p : plate_) {
      const double n = static_cast<double>(p.ior), d = static_cast<double>(p.thickness_m);
      const double ct = std::sqrt(std::max(1e-12, 1 - s * s / (n * n)));
      at.rho += d * s / (n * ct), at.slope += d * c / (n * ct * ct * ct);
    }
    return at;
  };
  // rho grows with i: bisection, safe at any angle.
  double lo = std::acos(std::min(c0, 1.0)), hi = 0.5 * kPi;
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (lo + hi);
    (place(middle).rho < rho ? lo : hi) = middle;
  }
  const Place at = place(lo);
  const double straight = c0 / (distance * distance);
  // On the axis sin i / rho is 1 / slope.
  const double bundle = rho > 1e-6 * height ? std::sin(lo) / (rho * at.slope) : 1 / (at.slope * at.slope);
  return static_cast<float>(bundle / straight);
}

const PaneHit* find_crossings(const RayScene& rays, const Ray& ray, std::span<PaneHit> hits,
                              std::vector<Crossing>& crossings) {
  crossings.clear();
  std::sort(hits.begin(), hits.end(), [](const PaneHit& a, const PaneHit& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.triangle < b.triangle;
  });
  const Scene& scene = rays.scene();
  const auto point_of = [&](const PaneHit& h) {
    return rays.surface(ray, {h.distance_m, h.triangle, h.u, h.v});
  };
  const Vec3 wo = -ray.direction;
  struct Seen {
    std::uint32_t instance;
    bool front;
    float distance_m, slack_m;
  };
  std::vector<Seen> seen;  // at about this place
  const auto twice = [&](const SurfacePoint& p) {
    const float cosine = std::max(std::fabs(glm::dot(p.geometric_normal, wo)), 1e-3f);
    const Seen own{p.instance, p.front, p.distance_m, kSamePlace * p.error_m / cosine};
    std::erase_if(seen, [&](const Seen& s) { return s.distance_m + s.slack_m < own.distance_m; });
    const bool before = std::any_of(seen.begin(), seen.end(), [&](const Seen& s) {
      return s.instance == own.instance && s.front == own.front;
    });
    if (!before) seen.push_back(own);
    return before;
  };
  for (std::size_t i = 0; i < hits.size(); ++i) {
    Crossing next;
    next.point = point_of(hits[i]);
    if (twice(next.point)) continue;
    next.leave_m = next.point.distance_m;
    const Material& material = scene.material[next.point.material];
    if (is_solid_glass(material)) {
      SurfacePoint behind;
      std::size_t k = i + 1;
      for (; k < hits.size(); ++k) {
        behind = point_of(hits[k]);
        if (!twice(behind)) break;
      }
      const Vec3& n = next.point.geometric_normal;
      const bool plate = next.point.front && k < hits.size() && !behind.front &&
                         behind.material == next.point.material && parallel(n, behind.geometric_normal);
      if (!plate) return &hits[i];
      const float cosine = std::fabs(glm::dot(n, wo));
      next.leave_m = behind.distance_m;
      next.plate_m = (behind.distance_m - next.point.distance_m) * cosine;
      next.plate_ior = material.ior > 0 ? material.ior : 1;
      next.layer = Bsdf(scene, next.point).plate(wo, next.plate_m);
      next.own = false;
      i = k;
    } else {
      next.layer = Bsdf(scene, next.point).pane(wo);
    }
    // Only surfaces that reflect as mirrors do interact with the next surface.
    if (!crossings.empty() && max_component(next.layer.reflectance()) > 0) {
      Crossing& last = crossings.back();
      const Vec3& n = last.point.normal;
      const float gap_m = (next.point.distance_m - last.leave_m) * std::fabs(glm::dot(n, wo));
      const auto size = [&](const Crossing& c) { return size_m(scene, scene.instance[c.point.instance]); };
      if (max_component(last.layer.reflectance()) > 0 && parallel(n, next.point.normal) &&
          gap_m <= kNextToEachOther * std::min(size(last), size(next))) {
        last.layer = stack(last.layer, next.layer);
        last.leave_m = next.leave_m;
        if (next.plate_m > 0) last.plate_m += next.plate_m, last.plate_ior = next.plate_ior;
        last.own = false;
        continue;
      }
    }
    crossings.push_back(next);
  }
  return nullptr;
}

bool trace_straight(const RayScene& rays, const Ray& ray, SurfacePoint& point, Rgb& share) {
  share = Rgb(1);
  if (!rays.has_panes()) return trace(rays, ray, point);
  Hit hit;
  thread_local std::vector<Crossing> crossings;
  const bool found = rays.through(ray, hit, crossings);
  StraightLight light;
  for (const Crossing& c : crossings) light.add(c, ray.direction);
  share = light.transmittance();
  if (found) point = rays.surface(ray, hit);
  return found;
}

bool Way::next(SurfacePoint& point) {
  if (looked_ && at_ > 0 && at_ <= crossing_.size() && crossing_[at_ - 1].plate_m > 0) {
    // Out of solid glass light goes on beside the line it came along, by d sin(i - t) / cos t.
    const Crossing& plate = crossing_[at_ - 1];
    const Vec3 n = plate.point.geometric_normal;
    const float c = std::fabs(glm::dot(n, ray_.direction));
    const float ct = face_reflectance(c, plate.plate_ior).cos_refracted;
    const float along = ct > 0 ? plate.plate_m * (1 - c / (plate.plate_ior * ct)) : 0;
    // Along the plate it falls back by d (tan i - tan t), taken across the ray.
    const Vec3 level = ray_.direction + c * n;
    const Vec3 back = c > 0 ? level * (along / c) : Vec3(0);
    ray_.origin -= back - glm::dot(back, ray_.direction) * ray_.direction;
    ray_.t_min_m = plate.leave_m + 4 * plate.point.error_m;
    looked_ = false;
  }
  if (!looked_) {
    looked_ = true, at_ = 0;
    crossing_.clear();
    ends_ = rays_->through(ray_, end_, crossing_);
  }
  if (at_ < crossing_.size()) {
    point = crossing_[at_++].point;
    return true;
  }
  if (at_++ > crossing_.size() || !ends_) return false;
  point = rays_->surface(ray_, end_);
  return true;
}

Bsdf Way::bsdf(const SurfacePoint& point) const {
  Bsdf bsdf(rays_->scene(), point);
  if (at_ > 0 && at_ <= crossing_.size() && !crossing_[at_ - 1].own)
    bsdf.replace_pane(crossing_[at_ - 1].layer);
  return bsdf;
}

}  // namespace phos::inline scene
