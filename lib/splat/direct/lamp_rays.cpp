#include "splat/direct/lamp_rays.h"

#include <algorithm>
#include <cmath>

#include "core/sampling.h"
#include "direct/lamp_sampler.h"

namespace phos::inline splat {
namespace {

constexpr std::size_t kMost = 8192;  // rays on their way at once

}  // namespace

void PooledVisibility::add(const LampVisibility& s, float weight) {
  seen += weight * s.seen, sent += weight * s.sent;
  rays += weight * static_cast<float>(s.rays), rays2 += weight * weight * static_cast<float>(s.rays);
}

void PooledVisibility::add(const Brought& b, float weight) {
  light += weight * b.light, light2 += static_cast<double>(weight) * b.light2;
}

void SharedLight::add_mean(const PooledVisibility& found) {
  const Rgb mean = found.light / found.rays;
  illuminance += mean;
  if (found.independent() > 1)
    variance +=
        glm::max(found.light2 / static_cast<double>(found.rays) - DVec3(mean) * DVec3(mean), DVec3(0)) /
        static_cast<double>(found.independent() - 1);
}

void SharedLight::add_share(const Rgb& whole_lx, float share, float variance_of_share) {
  illuminance += whole_lx * share;
  variance += DVec3(whole_lx) * DVec3(whole_lx) * static_cast<double>(variance_of_share);
}

AimedLamps::AimedLamps(const RayScene& the_rays, const Luminaires& the_lights)
    : rays(the_rays), lights(the_lights) {
  for (std::size_t i = 0; i < lights.size(); ++i) {
    panel.emplace_back(rays.scene(), lights[i]);
    // How much of a lamp arrives behind panes depends on the angle and the channel: no one share tells it.
    form.emplace_back(rays.has_panes() ? LampPanel() : panel.back());
    even.push_back(LampForm(panel.back()).closed());
    // Not quite a parallelogram: a number that chooses among its patches would not be drawn.
    if (panel.back().patches().size() > 1 && lights.by_u_alone(i)) panel.back() = LampPanel();
  }
}

void LampRays::add(const Ray& ray, const Aim& aim) {
  ray_.push_back(ray);
  if (!(ray.t_max_m > 0)) ray_.back().t_max_m = -1;  // too close to each other for anything to stand between
  aim_.push_back(aim);
  if (ray_.size() == kMost) send();
}

void LampRays::aim(std::size_t lamp, const SurfacePoint& p, float u_triangle, const Vec2& u,
                   LampVisibility& sight, Brought* brought) {
  ++sight.rays;
  if (const LampPanel& panel = lamps_.panel[lamp]; !panel.empty() && !panel.near(p.position)) {
    const LampPanel::Way way = panel.way(p, u_triangle, u);
    if (!(way.weight_sr > 0)) return;
    sight.sent += way.weight_sr;
    if (way.above) add(way.ray, {&sight, brought, way.weight_sr, panel.luminance() * way.weight_sr});
    return;
  }
  Illumination light;
  if (!lamps_.lights.illuminate(lamp, p.position, std::min(u_triangle, kBelowOne),
                                glm::min(u, Vec2(kBelowOne)), light))
    return;
  const float density = lamps_.lights[lamp].extended() ? light.density : 1;
  const float weight = glm::dot(p.normal, light.direction) / density;
  if (!(weight > 0) || !std::isfinite(weight)) return;
  sight.sent += weight;
  if (!(glm::dot(p.geometric_normal, light.direction) > 0)) return;
  add(shadow_ray(p, light), {&sight, brought, weight, light.value * weight});
}

void LampRays::send() {
  share_.resize(ray_.size());
  lamps_.rays.transmittance(ray_, share_);
  for (std::size_t k = 0; k < aim_.size(); ++k) {
    const Rgb share = ray_[k].t_max_m > 0 ? share_[k] : Rgb(1);
    if (share == Rgb(0)) continue;
    const auto& [sight, brought, weight, brings] = aim_[k];
    sight->seen += weight;
    const Rgb light = share * brings;
    if (brought) brought->light += light, brought->light2 += DVec3(light) * DVec3(light);
  }
  ray_.clear(), aim_.clear();
}

}  // namespace phos::inline splat
