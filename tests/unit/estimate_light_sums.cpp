// Sums of harmonics over directions that carry light: against sums in double, one direction after another.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/random.h"
#include "core/sampling.h"
#include "estimate/harmonics/light_sums.h"

namespace phos {
namespace {

constexpr int kOrder = 10;
constexpr std::size_t kCount = 100;

std::vector<DirectedLight> some_light(std::size_t n) {
  std::vector<DirectedLight> all;
  for (std::uint64_t i = 0; i < n; ++i) {
    RandomStream random(1, Stage::test, i);
    DirectedLight l;
    l.direction = sample_uniform_cone(random.uniform2(), 0.02f);
    l.value = Rgb(random.uniform(), random.uniform(), random.uniform());
    l.per_m = l.value * (0.2f + random.uniform());
    l.normal = 2.f * random.uniform2() - 1.f;
    all.push_back(l);
  }
  return all;
}

/// light, and both slopes by the surface gradients of the basis, in double.
struct Truth {
  std::vector<double> light, slope[2];
};
Truth truth_of(const std::vector<DirectedLight>& all, double power) {
  const HarmonicBasis<double> basis(kOrder);
  Truth t{std::vector<double>(3 * kCount),
          {std::vector<double>(3 * kCount), std::vector<double>(3 * kCount)}};
  std::vector<double> h(kCount), g[3] = {h, h, h};
  for (const DirectedLight& l : all) {
    const DVec3 w(l.direction);
    basis.evaluate(BasisKind::hsh, w.x, w.y, w.z, h.data(), g[0].data(), g[1].data(), g[2].data());
    for (std::size_t i = 0; i < kCount; ++i) {
      for (int c = 0; c < 3; ++c) {
        const std::size_t k = 3 * i + static_cast<std::size_t>(c);
        t.light[k] += static_cast<double>(l.value[c]) * h[i];
        for (const int axis : {0, 1})
          t.slope[axis][k] += static_cast<double>(l.per_m[c]) *
                              ((static_cast<double>(l.normal[axis]) + power * w[axis]) * h[i] - g[axis][i]);
      }
    }
  }
  return t;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double off = 0, all = 0;
  for (std::size_t i = 0; i < a.size(); ++i) off += (a[i] - b[i]) * (a[i] - b[i]), all += a[i] * a[i];
  return std::sqrt(off / all);
}

LightSums sums_of(const std::vector<DirectedLight>& all, SlopesBy by, Falloff falloff) {
  LightSums sums(kOrder);
  sums.start(by, falloff);
  for (const DirectedLight& l : all) sums.add(l);
  sums.finish();
  return sums;
}

TEST(LightSums, AreThoseInDouble) {
  // Less than a block, whole blocks, and some more.
  for (const std::size_t n : {1u, 63u, 64u, 640u, 777u}) {
    const std::vector<DirectedLight> all = some_light(n);
    for (const Falloff falloff : {Falloff::solid, Falloff::projected}) {
      const Truth truth = truth_of(all, static_cast<double>(falloff));
      const LightSums terms = sums_of(all, SlopesBy::terms, falloff),
                      differences = sums_of(all, SlopesBy::differences, falloff),
                      none = sums_of(all, SlopesBy::none, falloff);
      for (const LightSums* sums : {&terms, &differences, &none})
        EXPECT_LT(distance(truth.light, sums->light), 1e-6) << n;
      for (const int axis : {0, 1}) {
        EXPECT_LT(distance(truth.slope[axis], terms.slope[axis]), 1e-5) << n << ", axis " << axis;
        // Right to the square of the step times that of the bands.
        EXPECT_LT(distance(truth.slope[axis], differences.slope[axis]), 3e-3) << n << ", axis " << axis;
        EXPECT_EQ(std::vector<double>(3 * kCount), none.slope[axis]);
      }
    }
  }
}

TEST(LightSums, EdgesAddToSlopesAlone) {
  LightSums sums(kOrder);
  sums.start(SlopesBy::terms, Falloff::solid);
  const Vec3 w = glm::normalize(Vec3(0.3f, -0.5f, 0.7f));
  sums.add_edge(w, Rgb(1, 2, 3), Rgb(-4, 0, 5));
  sums.finish();
  const HarmonicBasis<double> basis(kOrder);
  std::vector<double> h(kCount);
  basis.evaluate(BasisKind::hsh, w.x, w.y, w.z, h.data());
  EXPECT_EQ(std::vector<double>(3 * kCount), sums.light);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_NEAR(2 * h[i], sums.slope[0][3 * i + 1], 1e-5);
    EXPECT_NEAR(-4 * h[i], sums.slope[1][3 * i], 1e-5);
    EXPECT_NEAR(5 * h[i], sums.slope[1][3 * i + 2], 1e-5);
  }
}

TEST(LightSums, StartForgets) {
  const std::vector<DirectedLight> all = some_light(100);
  LightSums sums(kOrder);
  for (const bool again : {false, true}) {
    sums.start(SlopesBy::terms, Falloff::solid);
    for (const DirectedLight& l : all) sums.add(l);
    sums.finish();
    EXPECT_EQ(sums_of(all, SlopesBy::terms, Falloff::solid).light, sums.light) << again;
  }
}

TEST(LightSums, AreTheSameBitsOnEveryMachine) {
#ifdef PHOS_ESTIMATE_AVX2
  if (&best_light_kernel() != &light_kernel_avx2) GTEST_SKIP() << "this machine has no AVX2";
  RandomStream random(3, Stage::test, 0);
  constexpr std::size_t kRows = 13;
  std::vector<float> harmonics(kRows * kLightBlock);
  struct alignas(32) Weights {
    float of[16 * kLightBlock];
  } weights;
  for (float& v : harmonics) v = random.uniform() - 0.5f;
  for (float& v : weights.of) v = random.uniform();
  for (const auto& [kernel, width] :
       {std::pair(&LightKernel::of_8, std::size_t{8}), std::pair(&LightKernel::of_16, std::size_t{16})}) {
    std::vector<double> plain(kRows * width, 1), avx2(plain);
    (light_kernel_plain.*kernel)(harmonics.data(), kRows, weights.of, plain.data());
    (light_kernel_avx2.*kernel)(harmonics.data(), kRows, weights.of, avx2.data());
    EXPECT_EQ(plain, avx2) << width;
  }
#else
  GTEST_SKIP() << "there is one kernel";
#endif
}

}  // namespace
}  // namespace phos
