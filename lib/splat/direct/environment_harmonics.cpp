#include "splat/direct/environment_harmonics.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/parallel.h"
#include "hsh/basis.h"
#include "hsh/limits.h"
#include "hsh/quadrature.h"
#include "hsh/rotation.h"
#include "radiance/brdf/projection.h"

namespace phos::inline splat {

namespace {

/// Points of a plane have one frame: each thread keeps its latest.
struct Latest {
  std::uint64_t owner = 0;
  Frame frame;
  std::vector<float> incident;
};

std::uint64_t next_id() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// cos and sin of k / n turns, k < n.
struct Circle {
  explicit Circle(int n) {
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * std::numbers::pi * k / n;
      cosine.push_back(std::cos(angle)), sine.push_back(std::sin(angle));
    }
  }
  std::vector<double> cosine, sine;
};

/// Integrals over a row's azimuths of the luminance times cos(m phi), sin(m phi), m < order.
struct RowIntegrals {
  std::vector<DVec3> cosine, sine;
};

RowIntegrals integrate_row(const Environment& map, int row, int order, const Circle& circle) {
  const int columns = map.width();
  const Rgb* texel = map.texels().data() + at(row) * at(columns);
  RowIntegrals sums;
  for (int m = 0; m < order; ++m) {
    // Azimuths fall from column to column; the first texel's middle is half a texel below half a turn.
    DVec3 c(0), s(0);
    for (int k = 0; k < columns; ++k) {
      const auto turned = static_cast<std::size_t>(std::int64_t{m} * k % columns);
      c += circle.cosine[turned] * DVec3(texel[k]), s -= circle.sine[turned] * DVec3(texel[k]);
    }
    // A texel's integral is the value at its middle times the integral of cos(m phi) about 0.
    const double width = 2 * std::numbers::pi / columns, half = 0.5 * m * width;
    const double own = m == 0 ? width : width * std::sin(half) / half;
    const double first = m * (std::numbers::pi + map.rotation_rad()) - half;
    const double cosine = own * std::cos(first), sine = own * std::sin(first);
    sums.cosine.push_back(cosine * c - sine * s), sums.sine.push_back(sine * c + cosine * s);
  }
  return sums;
}

/// What one row of the map adds to each coefficient.
void add_row(const Environment& map, int row, const Circle& circle, const HarmonicBasis<double>& basis,
             std::vector<DVec3>& sum) {
  const int order = basis.order();
  const RowIntegrals integrals = integrate_row(map, row, order, circle);
  const double height = std::numbers::pi / map.height();
  std::vector<double> points, weights, values(at(basis.count()));
  gauss_legendre(4 + static_cast<int>(std::ceil(order * height)), points, weights);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double theta = (row + 0.5 + 0.5 * points[k]) * height, sine = std::sin(theta);
    basis.evaluate(BasisKind::sh, sine, 0, std::cos(theta), values.data());
    const double weight = 0.5 * height * weights[k] * sine;
    for (int l = 0; l < order; ++l)
      for (int m = 0; m <= l; ++m) {
        const double v = weight * values[at(harmonic_index(l, m))];
        sum[at(harmonic_index(l, m))] += v * integrals.cosine[at(m)];
        if (m > 0) sum[at(harmonic_index(l, -m))] += v * integrals.sine[at(m)];
      }
  }
}

/// Integral of max(z, 0) Y_l^0, times the number that turns it into a factor of SH coefficients (Ramamoorthi
/// and Hanrahan 2001): irradiance is a convolution.
std::vector<double> cosine_factors(int order) {
  const HarmonicConversion conversion(2, order);
  std::vector<double> factors;
  for (int l = 0; l < order; ++l) {
    // z is sqrt(pi / 2) H_0^0 + sqrt(pi / 6) H_1^0.
    const double zonal = std::sqrt(std::numbers::pi / 2) * conversion.at(0, harmonic_index(l, 0)) +
                         std::sqrt(std::numbers::pi / 6) * conversion.at(2, harmonic_index(l, 0));
    factors.push_back(zonal * std::sqrt(4 * std::numbers::pi / (2 * l + 1)));
  }
  return factors;
}

/// A disc's coefficients are the coefficients of its middle, times the means of the Legendre polynomials over
/// it.
void add_sun(const Environment::Sun& sun, const HarmonicBasis<double>& basis, std::vector<DVec3>& sum) {
  const DVec3 towards = glm::normalize(sun.towards);
  const Frame frame = environment_frame();
  std::vector<double> values(at(basis.count()));
  basis.evaluate(BasisKind::sh, glm::dot(towards, DVec3(frame.x)), glm::dot(towards, DVec3(frame.y)),
                 glm::dot(towards, DVec3(frame.z)), values.data());
  // Mean of P_l over 1 - t(1 - cos r), by its integral (P_(l-1) - P_(l+1)) / (2 l + 1).
  const double x = std::cos(sun.radius_rad), sine = std::sin(sun.radius_rad);
  const double half = std::sin(sun.radius_rad / 2), drop = 2 * half * half;
  const DVec3 lx = DVec3(sun.illuminance_lx) * (2 * drop / (sine * sine));  // luminance times solid angle
  double before = 1, now = x;
  for (int l = 0; l < basis.order(); ++l) {
    double mean = 1;
    if (l > 0) {
      const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
      mean = (before - next) / ((2 * l + 1) * drop);
      before = now, now = next;
    }
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum[at(i)] += values[at(i)] * mean * lx;
  }
}

}  // namespace

std::vector<float> project_environment(const Environment& map, int order) {
  const HarmonicBasis<double> basis(order);
  const Circle circle(map.width());
  using Sums = std::vector<DVec3>;
  Sums sums = parallel_reduce(
      at(map.height()), 8, Sums(at(basis.count()), DVec3(0)),
      [&](std::size_t begin, std::size_t end) {
        Sums part(at(basis.count()), DVec3(0));
        for (std::size_t row = begin; row < end; ++row)
          add_row(map, static_cast<int>(row), circle, basis, part);
        return part;
      },
      [](Sums& total, const Sums& part) {
        for (std::size_t i = 0; i < total.size(); ++i) total[i] += part[i];
      });
  if (map.sun()) add_sun(*map.sun(), basis, sums);
  std::vector<float> coefficients;
  for (const DVec3& s : sums)
    for (int c = 0; c < 3; ++c) coefficients.push_back(static_cast<float>(s[c]));
  return coefficients;
}

EnvironmentHarmonics::EnvironmentHarmonics(const Scene& scene, const Environment& map, EnvironmentBy by,
                                           int order, std::span<const BrdfTable> tables)
    : id_(next_id()),
      sh_order_(by == EnvironmentBy::sh ? order : 2 * order),
      tables_(tables.begin(), tables.end()),
      table_of_(scene.material.size(), -1) {
  if (order < 1 || order > kMostOrder.most)
    throw Error(ExitCode::usage, "",
                text("order ", order, " of an environment is not in 1 .. ", kMostOrder.most));
  BrdfTableOptions options;
  options.max_order = order;
  for (const std::uint32_t material : glossy_materials(scene)) {
    const auto same = [&](const BrdfTable& t) { return t.material_index == material; };
    if (std::any_of(tables_.begin(), tables_.end(), same)) continue;
    Counters ignored;  // phos-brdf tells of them
    tables_.push_back(project_brdf(scene, material, options, ignored));
  }
  int most = 0;
  for (std::size_t t = 0; t < tables_.size(); ++t) {
    table_of_.at(tables_[t].material_index) = static_cast<std::int32_t>(t);
    most = std::max(most, tables_[t].order);
  }
  if (most > 0) to_hsh_.emplace(by == EnvironmentBy::sh ? most : std::min(most, order), sh_order_);

  map_ = project_environment(map, sh_order_);
  lambert_ = map_;
  const std::vector<double> factors = cosine_factors(sh_order_);
  for (int l = 0; l < sh_order_; ++l)
    for (std::size_t i = 3 * at(l * l); i < 3 * at((l + 1) * (l + 1)); ++i)
      lambert_[i] *= static_cast<float>(factors[at(l)]);
}

const BrdfTable* EnvironmentHarmonics::table_of(std::uint32_t material) const {
  const std::int32_t t = table_of_[material];
  return t >= 0 ? &tables_[static_cast<std::size_t>(t)] : nullptr;
}

Rgb EnvironmentHarmonics::irradiance_lx(const Vec3& normal) const {
  const HarmonicBasis<float> basis(sh_order_);
  const Vec3 n = environment_frame().to_local(normal);
  std::vector<float> values(at(basis.count()));
  basis.evaluate(BasisKind::sh, n.x, n.y, n.z, values.data());
  Rgb sum(0);
  for (std::size_t i = 0; i < values.size(); ++i)
    sum += values[i] * Rgb(lambert_[3 * i], lambert_[3 * i + 1], lambert_[3 * i + 2]);
  return glm::max(sum, Rgb(0));
}

std::vector<float> EnvironmentHarmonics::incident(const Frame& frame) const {
  std::vector<float> local(map_.size()), hsh(3 * at(harmonic_count(to_hsh_->hsh_order())));
  ShRotation(sh_order_, rotation_angles(environment_frame(), frame)).rotate(map_, local, 3);
  to_hsh_->sh_to_hsh(local, hsh, 3);
  return hsh;
}

std::optional<EnvironmentHarmonics::Light> EnvironmentHarmonics::light(const SurfacePoint& point,
                                                                       const Bsdf& bsdf,
                                                                       const Vec3& wo) const {
  const Frame frame{point.tangent, glm::cross(point.normal, point.tangent), point.normal};
  const Vec3 local = frame.to_local(wo);
  if (!(local.z > 0)) return {};
  Light light;
  if (bsdf.has_gloss()) {
    const BrdfTable* table = table_of(point.material);
    if (!table || BrdfLookup(*table).order(local) == 0) return {};
    static thread_local Latest latest;
    if (latest.owner != id_ || latest.frame.z != frame.z || latest.frame.x != frame.x)
      latest = {id_, frame, incident(frame)};
    light.gloss = BrdfLookup(*table).outgoing(local, latest.incident);
  }
  light.irradiance_lx = irradiance_lx(point.normal);
  const Rgb least = -light.irradiance_lx * bsdf.diffuse_reflectance() / kPi;
  light.clamped = glm::any(glm::lessThan(light.gloss, least));
  light.gloss = glm::max(light.gloss, least);
  return light;
}

}  // namespace phos::inline splat
