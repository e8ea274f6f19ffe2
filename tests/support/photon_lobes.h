// The light that leaves a place through glossy lobes, computed from known light and from photons.
#pragma once

#include <string>
#include <vector>

#include "estimate/harmonics/cosine_fit.h"
#include "radiance/brdf/lobe_projection.h"
#include "support/gradient_scenes.h"
#include "support/radiance_scenes.h"
#include "support/reflections.h"

namespace phos::test {

struct NamedLobe {
  std::string name;
  Reflection f;  ///< of one direction of view
  Vec3 wo;
};

/// Of views from one side.
inline std::vector<NamedLobe> glossy_lobes(float azimuth_deg = 200) {
  std::vector<NamedLobe> lobes;
  for (const float angle : {0.f, 45.f, 70.f}) {
    const Vec3 wo = view(angle, azimuth_deg);
    const std::string at = " at " + std::to_string(static_cast<int>(angle));
    lobes.push_back({"phong 5" + at, phong_reflection(5, wo), wo});
    lobes.push_back({"phong 22" + at, phong_reflection(22, wo), wo});
    lobes.push_back({"ggx 0.5" + at, ggx_reflection(0.5f, wo), wo});
  }
  return lobes;
}

/// Coefficients of f cos, one channel.
inline std::vector<double> coefficients(const NamedLobe& lobe, int order) {
  const auto scouts = mirror_of(lobe.wo);
  return channel(project_lobe(lobe.f, scouts, HarmonicBasis<float>(order)).coefficients);
}

inline double through(const std::vector<double>& lobe, const std::vector<double>& light) {
  double sum = 0;
  for (std::size_t i = 0; i < lobe.size(); ++i) sum += lobe[i] * light[i];
  return sum;
}

/// Luminance that leaves a place of a scene without occluders, by quadrature over the luminous surfaces.
inline double outgoing(const GradientScene& scene, const NamedLobe& lobe, const DVec3& place) {
  constexpr int kNodes = 96;
  static const auto [node, weight] = [] {
    std::pair<std::vector<double>, std::vector<double>> rule;
    gauss_legendre(kNodes, rule.first, rule.second);
    return rule;
  }();
  double sum = 0;
  for (const Rectangle& r : scene.rectangles) {
    for (std::size_t i = 0; i < kNodes; ++i) {
      for (std::size_t j = 0; j < kNodes; ++j) {
        const DVec2 u(0.5 + 0.5 * node[i], 0.5 + 0.5 * node[j]);
        const DVec3 step = r.point(r.lo + u * (r.hi - r.lo)) - place;
        const double d = glm::length(step), cosines = std::fabs(step[r.axis]) * step.z / (d * d);
        if (!(step.z > 0)) continue;
        sum += 0.25 * weight[i] * weight[j] * r.area() * r.luminance * cosines / (d * d) *
               static_cast<double>(lobe.f(Vec3(step / d)).y);
      }
    }
  }
  return sum;
}

/// Light of these moments, one channel: CosineFit.
inline std::vector<double> fitted(const std::vector<double>& moments, int order) {
  std::vector<double> all, light;
  for (const double b : moments) all.insert(all.end(), 3, b);
  CosineFit(order).solve(all);
  for (std::size_t i = 1; i < all.size(); i += 3) light.push_back(all[i]);
  return light;
}

/// Standard error of the light that leaves through a lobe, as a lookup states it.
inline double stated(const std::vector<double>& lobe, const RadianceRecord& r) {
  double variance = 0;
  for (int l = 0; l < r.order(); ++l)
    for (int m = -l; m <= l; ++m) {
      const double c = lobe[static_cast<std::size_t>(harmonic_index(l, m))],
                   e = static_cast<double>(r.stderr_light[3 * static_cast<std::size_t>(l) + 1]);
      variance += c * c * e * e;
    }
  return std::sqrt(variance);
}

/// The estimator that divides each photon by its own cosine: sum of flux / (area cos) H. Its variance is
/// infinite in theory, for light along the horizon.
inline std::vector<double> by_inverse_cosines(const ZonePhotons& photons, double area_m2, int order) {
  const HarmonicBasis<double> basis(order);
  std::vector<double> sum(static_cast<std::size_t>(basis.count())), value(sum);
  for (std::size_t i = 0; i < photons.size(); ++i) {
    const DVec3 w(photons.direction[i]);
    basis.evaluate(BasisKind::hsh, w.x, w.y, w.z, value.data());
    for (std::size_t k = 0; k < sum.size(); ++k)
      sum[k] += static_cast<double>(photons.flux_lm[i].y) / (area_m2 * w.z) * value[k];
  }
  return sum;
}

}  // namespace phos::test
