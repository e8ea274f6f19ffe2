#include "radiance/brdf/bases.h"

#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/parallel.h"
#include "hsh/comparison_bases.h"
#include "scene/material/bsdf.h"

namespace phos::inline radiance {

namespace {

constexpr int kMostCoefficients = 100, kRings = 96, kSectors = 192;

struct View {
  Vec3 direction;
  double share;
};

/// Even over the parabolic map, within its disc.
std::vector<View> views() {
  constexpr int kRadii = 6, kAzimuths = 8;
  std::vector<View> all;
  for (int i = 0; i < kRadii; ++i) {
    const float r = (static_cast<float>(i) + 0.5f) / kRadii, z = (1 - r * r) / (1 + r * r);
    for (int j = 0; j < kAzimuths; ++j) {
      const float phi = 2 * kPi * (static_cast<float>(j) + 0.25f) / kAzimuths, across = std::sqrt(1 - z * z);
      all.push_back({{across * std::cos(phi), across * std::sin(phi), z},
                     static_cast<double>(2 * i + 1) / (kRadii * kRadii * kAzimuths)});
    }
  }
  return all;
}

/// Values of a function at the points of the quadrature, and its integral squared.
struct Sampled {
  std::vector<double> value;  // times the weight of the point
  double energy = 0;
};

Sampled sampled(const Bsdf& bsdf, const Vec3& wo, bool cosine, const Quadrature& q) {
  Sampled out;
  out.value.reserve(q.size());
  for (std::size_t k = 0; k < q.size(); ++k) {
    const Vec3 wi(q.x[k], q.y[k], q.z[k]);
    const double f = static_cast<double>(luminance(bsdf.evaluate_gloss(wo, wi))) * (cosine ? q.z[k] : 1.0);
    out.value.push_back(q.weight[k] * f);
    out.energy += q.weight[k] * f * f;
  }
  return out;
}

/// Every function of a basis at every point, point by point.
struct Functions {
  Functions(ComparisonBasis b, const Quadrature& q) : basis(b) {
    while (comparison_count(basis, order + 1) <= kMostCoefficients) ++order;
    count = static_cast<std::size_t>(comparison_count(basis, order));
    value.resize(count * q.size());
    parallel_for(q.size(), 256, [&](std::size_t k) {
      evaluate_comparison(basis, order, q.x[k], q.y[k], q.z[k], value.data() + k * count);
    });
  }
  /// By order from 1, the share of the energy.
  std::vector<double> accuracy(const Sampled& f) const {
    std::vector<double> sum(count, 0), share;
    for (std::size_t k = 0; k < f.value.size(); ++k)
      for (std::size_t i = 0; i < count; ++i) sum[i] += f.value[k] * value[k * count + i];
    double held = 0;
    std::size_t i = 0;
    for (int n = 1; n <= order; ++n) {
      for (; i < static_cast<std::size_t>(comparison_count(basis, n)); ++i) held += sum[i] * sum[i];
      share.push_back(f.energy > 0 ? held / f.energy : 1);
    }
    return share;
  }
  ComparisonBasis basis;
  int order = 1;
  std::size_t count = 0;
  std::vector<double> value;
};

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string(2, c) : std::string(1, c);
  return out + "\"";
}

std::string title(const Scene& scene, std::uint32_t material) {
  const std::string& name = scene.material[material].name;
  return quoted(name.empty() ? text("material ", material) : name);
}

/// The rows of one basis for one weighted material.
std::string rows(const Functions& functions, const std::vector<Sampled>& lobes, const std::string& start) {
  const std::vector<View> all = views();
  std::vector<std::vector<double>> each(lobes.size());
  parallel_for(lobes.size(), 1, [&](std::size_t i) { each[i] = functions.accuracy(lobes[i]); });
  std::string out;
  for (int n = 1; n <= functions.order; ++n) {
    double mean = 0;
    for (std::size_t i = 0; i < each.size(); ++i)
      mean += all[i].share * each[i][static_cast<std::size_t>(n - 1)];
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.6f", mean);
    out += text(start, name(functions.basis), ",", comparison_count(functions.basis, n), ",", digits, "\n");
  }
  return out;
}

}  // namespace

std::string basis_accuracy_csv(const Scene& scene, std::span<const std::uint32_t> materials) {
  const Quadrature q = hemisphere_quadrature(kRings, kSectors);
  std::vector<Functions> bases;
  if (!materials.empty())
    for (const ComparisonBasis basis : kComparisonBases) bases.emplace_back(basis, q);
  std::string csv = "material,weight,basis,coefficients,accuracy\n";
  const std::vector<View> all = views();
  for (const std::uint32_t material : materials) {
    const Bsdf bsdf(scene, material);
    for (const bool cosine : {true, false}) {
      std::vector<Sampled> lobes(all.size());
      parallel_for(all.size(), 1,
                   [&](std::size_t i) { lobes[i] = sampled(bsdf, all[i].direction, cosine, q); });
      const std::string start = title(scene, material) + (cosine ? ",cosine," : ",none,");
      for (const Functions& functions : bases) csv += rows(functions, lobes, start);
    }
  }
  return csv;
}

}  // namespace phos::inline radiance
