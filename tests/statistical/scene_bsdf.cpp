// Each reflection model's samples follow its density.
#include <gtest/gtest.h>

#include "scene/material/bsdf.h"
#include "support/chi2.h"
#include "support/one_material.h"

using namespace phos;
using namespace phos::test;

namespace {

/// Along the normal, 45 and 85 degrees from it.
constexpr float kCosines[] = {1.f, 0.70710678f, 0.08715574f};
constexpr int kSamples = 200000;

}  // namespace

TEST(Chi2, TailMatchesTables) {
  EXPECT_NEAR(chi2_tail(3.841459, 1), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(18.307038, 10), 0.05, 1e-6);
  EXPECT_NEAR(chi2_tail(1074.679, 1000), 0.05, 1e-5);
  EXPECT_NEAR(chi2_tail(2.558212, 10), 0.99, 1e-6);
}

TEST(Chi2, RejectsAWrongDensity) {
  const Scene scene = scene_of(make_material(Model::lambert, Rgb(1), Rgb(0)));
  const Bsdf bsdf(scene, flat_point());
  const Chi2 result = chi2_directions(
      SphereGrid(), 1, kSamples,
      [&](RandomStream& random, Vec3& d) {
        BsdfSample s;
        const bool ok = bsdf.sample(Vec3(0, 0, 1), random.uniform(), random.uniform2(), s);
        d = s.direction;
        return ok;
      },
      [](const Vec3& d) {
        return d.z > 0 ? 0.97 * static_cast<double>(d.z) / M_PI + 0.03 / (2 * M_PI) : 0.0;
      });
  EXPECT_LT(result.p, 1e-4);
}

TEST(BsdfSamples, FollowTheirDensity) {
  const std::vector<Named> all = models();
  const double p_least = least_p(0.01, static_cast<int>(all.size() * std::size(kCosines)));
  for (const Named& named : all) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (const float cosine : kCosines) {
      const Vec3 wo = direction(cosine, 0.7f);
      const Chi2 result = chi2_directions(
          SphereGrid(), 2, kSamples,
          [&](RandomStream& random, Vec3& d) {
            const float u_lobe = random.uniform();
            BsdfSample s;
            const bool ok = bsdf.sample(wo, u_lobe, random.uniform2(), s) && !s.specular;
            d = s.direction;
            return ok;
          },
          [&](const Vec3& d) { return static_cast<double>(bsdf.density(wo, d)); });
      EXPECT_GT(result.p, p_least) << named.name << ", cosine " << cosine << ": " << result.statistic
                                   << " for " << result.degrees << " degrees of freedom";
    }
  }
}

TEST(BsdfSamples, OfTheGlossFollowTheirDensity) {
  std::vector<Named> all;
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    if (Bsdf(scene, flat_point()).has_gloss()) all.push_back(named);
  }
  const double p_least = least_p(0.01, static_cast<int>(all.size() * std::size(kCosines)));
  for (const Named& named : all) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    for (const float cosine : kCosines) {
      const Vec3 wo = direction(cosine, 2.1f);
      const Chi2 result = chi2_directions(
          SphereGrid(), 3, kSamples,
          [&](RandomStream& random, Vec3& d) {
            BsdfSample s;
            const bool ok = bsdf.sample_gloss(wo, random.uniform2(), s);
            d = s.direction;
            return ok;
          },
          [&](const Vec3& d) { return static_cast<double>(bsdf.density_gloss(wo, d)); });
      EXPECT_GT(result.p, p_least) << named.name << ", cosine " << cosine << ": " << result.statistic
                                   << " for " << result.degrees << " degrees of freedom";
    }
  }
}
