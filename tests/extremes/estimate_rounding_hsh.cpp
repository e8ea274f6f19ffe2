// Harmonics in floats against doubles, and their rotations against looking the other way.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "hsh/basis.h"
#include "hsh/rotation.h"
#include "support/rounding.h"

namespace phos::test {
namespace {

/// Root mean square of a harmonic.
double size_of(BasisKind kind) { return std::sqrt(1 / ((kind == BasisKind::sh ? 4 : 2) * std::numbers::pi)); }

/// Anywhere, next to the pole and next to the horizon.
std::vector<Vec3> directions() {
  std::vector<Vec3> all{{0, 0, 1}, {1, 0, 0}, {0, -1, 0}};
  for (std::uint64_t i = 0; i < 600; ++i) {
    RandomStream random(3, Stage::test, i);
    Vec3 w = sample_cosine_hemisphere(random.uniform2());
    const float squeeze = std::pow(10.f, -6 * random.uniform());
    if (i % 3 == 1) w = glm::normalize(Vec3(squeeze * w.x, squeeze * w.y, w.z));
    if (i % 3 == 2) w = glm::normalize(Vec3(w.x, w.y, squeeze * w.z));
    all.push_back(w);
  }
  return all;
}

TEST(Rounding, Harmonics) {
  constexpr int kOrder = 30;
  const HarmonicBasis<float> narrow(kOrder);
  const HarmonicBasis<double> wide(kOrder);
  const auto n = static_cast<std::size_t>(narrow.count());
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    Rounding value, slope;
    std::vector<float> f(n), fx(n), fy(n);
    std::vector<double> d(n), dx(n), dy(n);
    for (const Vec3& w : directions()) {
      const glm::dvec3 v(w);
      narrow.evaluate(kind, w.x, w.y, w.z, f.data(), fx.data(), fy.data(), nullptr);
      wide.evaluate(kind, v.x, v.y, v.z, d.data(), dx.data(), dy.data(), nullptr);
      const double unit = size_of(kind);
      for (std::size_t i = 0; i < n; ++i) {
        value.see(static_cast<double>(f[i]), static_cast<long double>(d[i]), static_cast<long double>(unit));
        const auto steep = static_cast<long double>(unit * kOrder);
        slope.see(static_cast<double>(fx[i]), static_cast<long double>(dx[i]), steep);
        slope.see(static_cast<double>(fy[i]), static_cast<long double>(dy[i]), steep);
      }
    }
    const std::string name = kind == BasisKind::sh ? "spherical harmonics" : "hemispherical harmonics";
    value.expect(name, "order", 1, kOrder, 1e-3);
    slope.expect("slopes of " + name, "order", 1, kOrder, 1e-3);
  }
}

/// (R f)(w) = f(R^-1 w), in doubles.
glm::dvec3 turned_back(const ZyzAngles& by, const glm::dvec3& w) {
  const auto about_z = [](double a, const glm::dvec3& v) {
    return glm::dvec3(std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z);
  };
  const auto about_y = [](double a, const glm::dvec3& v) {
    return glm::dvec3(std::cos(a) * v.x + std::sin(a) * v.z, v.y, std::cos(a) * v.z - std::sin(a) * v.x);
  };
  const auto angle = [](float a) { return -static_cast<double>(a); };
  return about_z(angle(by.alpha), about_y(angle(by.beta), about_z(angle(by.gamma), w)));
}

TEST(Rounding, RotationOfHarmonics) {
  constexpr int kOrder = 30;
  const HarmonicBasis<double> wide(kOrder);
  const auto n = static_cast<std::size_t>(wide.count());
  Rounding rotated;
  std::vector<double> basis(n);
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    RandomStream random(4, Stage::test, trial);
    std::vector<float> in(n), out(n);
    double energy = 0;
    for (float& c : in)
      c = 2 * random.uniform() - 1, energy += static_cast<double>(c) * static_cast<double>(c);
    const ZyzAngles by{6.28f * random.uniform(), trial % 3 == 0 ? 1e-3f : 3.14f * random.uniform(),
                       6.28f * random.uniform()};
    ShRotation(kOrder, by).rotate(in, out);
    for (int k = 0; k < 40; ++k) {
      const glm::dvec3 w(sample_uniform_sphere(random.uniform2()));
      const auto value = [&](const std::vector<float>& c, const glm::dvec3& at) {
        const glm::dvec3 unit = glm::normalize(at);
        wide.evaluate(BasisKind::sh, unit.x, unit.y, unit.z, basis.data());
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(c[i]) * basis[i];
        return sum;
      };
      // Root mean square of the function over the sphere.
      const double unit = std::sqrt(energy) * size_of(BasisKind::sh);
      rotated.see(value(out, w), static_cast<long double>(value(in, turned_back(by, w))),
                  static_cast<long double>(unit));
    }
  }
  rotated.expect("rotated spherical harmonics", "order", 1, kOrder, 1e-3);
}

}  // namespace
}  // namespace phos::test
