#include "radiance/brdf/projection.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/brdf/table.h"
#include "radiance/events.h"
#include "scene/material/bsdf.h"
#include "scene/report/describe.h"

namespace phos::inline radiance {

namespace {

constexpr int kScouts = 128;
/// Share of a lobe's magnitude, as its samples state it within some percent, that the quadrature must find.
constexpr double kFound = 0.7;
/// An albedo beyond this gains energy, whatever the quadrature's error.
constexpr float kMostAlbedo = 1.001f;
/// Values of f are the same if they differ by less of the lobe's greatest: a narrow lobe's rounding.
constexpr float kSame = 0.02f;
/// What a function without the cosine, which the quadrature puts in, is divided by at least.
constexpr float kLeastDivisor = 1e-6f;

Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }

/// Is f(turn wo, turn wi) = f(wo, wi)? Asked of directions wi at all distances from the mirror direction, as
/// lobes have all widths.
template <class Turn>
bool unchanged_by(const Bsdf& bsdf, const Turn& turn) {
  constexpr int kDirections = 24, kDistances = 11;
  for (int i = 0; i < kDirections; ++i) {
    const Vec3 wo = sample_cosine_hemisphere(r2_point(i, {0.5f, 0.5f}));
    float greatest = 0, change = 0;
    for (int k = 0; k < kDistances; ++k) {
      const Vec3 aside = sample_uniform_sphere(r2_point(kDistances * i + k, {0.25f, 0.75f}));
      const Vec3 wi = glm::normalize(mirrored(wo) + std::ldexp(1.f, -k) * aside);
      const Rgb f = bsdf.evaluate_gloss(wo, wi);
      greatest = std::max(greatest, max_component(glm::abs(f)));
      change = std::max(change, max_component(glm::abs(bsdf.evaluate_gloss(turn(wo), turn(wi)) - f)));
    }
    if (change > kSame * greatest) return false;
  }
  return true;
}

/// What a lobe keeps when directions are turned or mirrored.
struct Symmetry {
  bool isotropic, quadrants;

  explicit Symmetry(const Bsdf& bsdf) {
    const auto turned = [](float angle) {
      return [c = std::cos(angle), s = std::sin(angle)](const Vec3& w) {
        return Vec3(c * w.x - s * w.y, s * w.x + c * w.y, w.z);
      };
    };
    quadrants = unchanged_by(bsdf, [](const Vec3& w) { return Vec3(w.x, -w.y, w.z); }) &&
                unchanged_by(bsdf, [](const Vec3& w) { return Vec3(-w.x, w.y, w.z); });
    isotropic = quadrants && unchanged_by(bsdf, turned(0.7f)) && unchanged_by(bsdf, turned(1.9f));
  }
};

/// One direction of view.
struct Projected {
  std::vector<float> coefficients;  ///< [order^2][3]
  int order = 0;
  float error = 0, albedo = 0;
  bool resolved = true;
  std::size_t rejected = 0, evaluated = 0;
};

Projected project(const Bsdf& bsdf, const Vec3& wo, const HarmonicBasis<float>& basis,
                  const BrdfTableOptions& options, const LobeFunction& function) {
  // Samples of the lobe find it, and show whether the whole lobe was found.
  std::vector<Vec3> scouts{mirrored(wo)};
  double expected = 0;
  for (int i = 0; i < kScouts; ++i) {
    BsdfSample sample;
    if (!bsdf.sample_gloss(wo, r2_point(i, {0.5f, 0.5f}), sample)) continue;
    scouts.push_back(sample.direction);
    const Rgb w = glm::abs(sample.weight);
    expected += static_cast<double>(w.x + w.y + w.z) / kScouts;
  }
  const auto f = [&](const Vec3& wi) {
    const Rgb value = function.whole ? bsdf.evaluate(wo, wi) : bsdf.evaluate_gloss(wo, wi);
    return function.cosine ? value : value / std::max(wi.z, kLeastDivisor);
  };
  LobeProjection lobe = project_lobe(f, scouts, basis, function.basis);
  Projected p;
  p.resolved = lobe.resolved && (function.whole || lobe.magnitude >= kFound * expected);
  p.rejected = lobe.rejected, p.evaluated = lobe.evaluated;
  if (function.cosine)
    p.albedo = max_component(lobe.albedo + (function.whole ? Rgb(0) : bsdf.diffuse_reflectance()));
  p.order = lobe.lowest_order(options.error, p.error);
  if (p.order == 0 && options.too_sharp == TooSharp::cut) p.order = basis.order();
  if (!p.resolved) p.order = 0;
  p.coefficients = std::move(lobe.coefficients);
  p.coefficients.resize(3 * static_cast<std::size_t>(harmonic_count(p.order)));
  return p;
}

/// Coefficients of the same lobe with x, y or both mirrored: mirrored in y, sin(m phi) changes its sign; in
/// x, cos(m phi) for odd m and sin(m phi) for even m.
void mirror(std::vector<float>& coefficients, int order, bool in_x, bool in_y) {
  for (int l = 0; l < order; ++l) {
    for (int m = -l; m <= l; ++m) {
      const bool odd = (m & 1) != 0, sine = m < 0;
      const bool negative = (in_y && sine) != (in_x && odd != sine);
      if (!negative) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        float& v = coefficients[3 * static_cast<std::size_t>(harmonic_index(l, m)) + c];
        v = -v;
      }
    }
  }
}

/// Sines, which mirror symmetry makes 0, keep no rounding.
void drop_sines(std::vector<float>& coefficients, int order) {
  for (int l = 1; l < order; ++l) std::fill_n(coefficients.begin() + 3 * harmonic_index(l, -l), 3 * l, 0.f);
}

void require(bool valid, const char* option, const std::string& message) {
  if (!valid) throw Error(ExitCode::usage, option, message);
}

std::string note_of(const Material& material) {
  if (material.base_colour.used() || material.metallic_roughness.used()) return "textures at their mean";
  return "";
}

}  // namespace

BrdfTable project_brdf(const Scene& scene, std::uint32_t material, const BrdfTableOptions& options,
                       Counters& counters, const LobeFunction& function) {
  require(options.max_order >= 1 && options.max_order <= 30, "--max-order",
          text(options.max_order, " is not from 1 to 30"));
  require(options.resolution >= 2 && options.resolution <= 1024, "--resolution",
          text(options.resolution, " is not from 2 to 1024"));
  require(options.error >= 0 && options.error <= 1, "--error", text(options.error, " is not from 0 to 1"));
  const Bsdf bsdf(scene, material);
  const Symmetry symmetry(bsdf);
  BrdfTable table;
  table.material = scene.material[material].name;
  table.material_index = material;
  table.note = note_of(scene.material[material]);
  table.isotropic = symmetry.isotropic;
  table.resolution = static_cast<int>(options.resolution);
  const auto side = static_cast<std::size_t>(table.resolution);
  const std::size_t entries = table.isotropic ? side : side * side;
  table.orders.resize(entries), table.error.resize(entries);

  // The entry whose lobe, perhaps mirrored, is the entry's own.
  const auto source = [&](std::size_t entry) {
    if (table.isotropic || !symmetry.quadrants) return entry;
    const std::size_t j = entry / side, i = entry % side;
    return std::max(j, side - 1 - j) * side + std::max(i, side - 1 - i);
  };
  const HarmonicBasis<float> basis(static_cast<int>(options.max_order));
  std::vector<Projected> projected(entries);
  parallel_for(entries, 1, [&](std::size_t e) {
    if (source(e) == e && table.used(e))
      projected[e] = project(bsdf, table.direction(e), basis, options, function);
  });

  for (const Projected& p : projected) table.order = std::max(table.order, p.order);
  const std::size_t stride = 3 * static_cast<std::size_t>(harmonic_count(table.order));
  table.coefficients.assign(entries * stride, 0.f);
  std::size_t intricate = 0, gaining = 0, rejected = 0, evaluated = 0;
  for (std::size_t e = 0; e < entries; ++e) {
    const std::size_t from = source(e);
    const Projected& p = projected[from];
    table.orders[e] = static_cast<std::uint8_t>(p.order), table.error[e] = p.error;
    table.albedo = std::max(table.albedo, p.albedo);
    intricate += !p.resolved, gaining += p.albedo > kMostAlbedo, rejected += p.rejected;
    evaluated += p.evaluated;
    std::vector<float> coefficients = p.coefficients;
    if (from != e) mirror(coefficients, p.order, from % side != e % side, from / side != e / side);
    if (table.isotropic) drop_sines(coefficients, p.order);
    std::copy(coefficients.begin(), coefficients.end(),
              table.coefficients.begin() + static_cast<std::ptrdiff_t>(e * stride));
  }
  if (intricate > 0) counters.count(kIntricateLobeEvent, intricate);
  if (gaining > 0) counters.count(kGainsEnergyEvent, gaining);
  if (rejected > 0) {
    Counters own;
    own.count(kNonFiniteValueEvent, rejected);
    own.require_allowed(kNonFiniteValueEvent, evaluated);
    counters.merge(own);
  }

  return table;
}

std::vector<std::uint32_t> glossy_materials(const Scene& scene) {
  std::vector<std::uint32_t> out;
  const std::vector<MaterialSummary> all = summarize_materials(scene);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].glossy && all[i].triangles > 0) out.push_back(static_cast<std::uint32_t>(i));
  return out;
}

}  // namespace phos::inline radiance
