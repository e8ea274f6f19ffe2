// Gradients and errors of hemispheres of rays against closed forms, and against the tables of independent
// programs.
#include <gtest/gtest.h>

#include <map>

#include "estimate/hemisphere/ray_gradients.h"
#include "support/golden_table.h"
#include "support/gradient_scenes.h"

namespace phos {
namespace {

using test::DVec2;
using test::Spread;

constexpr int kReps = 200;

DVec2 xy(const Vec3& v) { return {v.x, v.y}; }

struct Measured {
  double irradiance_lx = 0;
  DVec2 translation{0}, rotation{0};       // exact
  std::map<GradientMode, Spread> of_mode;  // translation
  Spread turned, value;                    // rotation; irradiance and its stated variance
};

/// Every estimator on `reps` hemispheres of one scene.
Measured measure(const std::string& name, int rings, int reps) {
  const test::GradientScene scene = test::gradient_scene(name);
  Measured m{scene.irradiance_lx(scene.receiver), scene.translation(), scene.rotation(), {}, {}, {}};
  const auto first = static_cast<std::uint64_t>(rings) << 32;
  for (int r = 0; r < reps; ++r) {
    RandomStream random(31, Stage::test, first + static_cast<std::uint64_t>(r));
    const Hemisphere h = test::seen_by_rays(scene, rings, slices_for(rings), random);
    for (const GradientMode mode : {GradientMode::analytic, GradientMode::hybrid, GradientMode::ward_heckbert,
                                    GradientMode::krivanek}) {
      const Gradients g = ray_gradients(h, mode, 1e-6f);
      m.of_mode[mode].add(xy(g.translation[1]));
      if (mode == GradientMode::analytic) m.turned.add(xy(g.rotation[1]));
    }
    const auto error = static_cast<double>(standard_error_of(h).y);
    m.value.add({irradiance_of(h).y, error * error});
  }
  return m;
}

const Measured& measured(const std::string& name, int rings) {
  static std::map<std::pair<std::string, int>, Measured> all;
  const auto [at, fresh] = all.try_emplace({name, rings});
  if (fresh) at->second = measure(name, rings, kReps);
  return at->second;
}

GradientMode mode_of(const std::string& table_name) {
  if (table_name == "WH92") return GradientMode::ward_heckbert;
  if (table_name == "KGBP05") return GradientMode::krivanek;
  if (table_name == "hybrid") return GradientMode::hybrid;
  return GradientMode::analytic;
}

/// Both ends of a comparison have spread: four standard errors of the difference, and the table's digits.
double tolerance(double sd, int reps_there) { return 4 * sd * std::sqrt(1.0 / kReps + 1.0 / reps_there); }

TEST(RayGradients, TranslationAgreesWithTheTable) {
  int rows = 0;
  for (auto& row : test::golden("B_gradients.csv")) {
    const Measured& m = measured(row["scene"], std::stoi(row["M"]));
    const Spread& s = m.of_mode.at(mode_of(row["estimator"]));
    const std::string what = row["scene"] + " " + row["estimator"] + " " + row["M"];
    const double e = std::stod(row["E_exact"]), sd = std::stod(row["sd_over_E_per_m"]) * e;
    EXPECT_NEAR(m.irradiance_lx, e, 1e-7 * e) << what;
    EXPECT_NEAR(m.translation.x, std::stod(row["gx_exact"]), 1e-6 * e) << what;
    EXPECT_NEAR(m.translation.y, std::stod(row["gy_exact"]), 1e-6 * e) << what;
    const double allowed = tolerance(sd, std::stoi(row["reps"])) + 1e-6 * e;
    EXPECT_NEAR(s.mean().x, std::stod(row["gx_mean"]), allowed) << what;
    EXPECT_NEAR(s.mean().y, std::stod(row["gy_mean"]), allowed) << what;
    EXPECT_NEAR(s.sd(), sd, 0.2 * sd + 1e-6 * e) << what;
    ++rows;
  }
  EXPECT_EQ(rows, 48);
}

TEST(RayGradients, HybridAgreesWithTheTable) {
  int rows = 0;
  for (auto& row : test::golden("B2_hybrid.csv")) {
    const int rings = std::stoi(row["M"]);
    if (rings > 16) continue;
    const Measured& m = measured(row["scene"], rings);
    const Spread& s = m.of_mode.at(mode_of(row["estimator"]));
    const std::string what = row["scene"] + " " + row["estimator"] + " " + row["M"];
    const double e = m.irradiance_lx, sd = std::stod(row["sd_over_E"]) * e;
    EXPECT_NEAR(glm::length(s.mean() - m.translation), std::stod(row["bias_over_E"]) * e,
                tolerance(sd, 300) + 1e-6 * e)
        << what;
    EXPECT_NEAR(s.sd(), sd, 0.2 * sd + 1e-6 * e) << what;
    ++rows;
  }
  EXPECT_EQ(rows, 48);
}

TEST(RayGradients, RotationAgreesWithTheTable) {
  int rows = 0;
  for (auto& row : test::golden("B3_rotational.csv")) {
    const int rings = std::stoi(row["M"]);
    if (rings > 16) continue;
    const Measured& m = measured(row["scene"], rings);
    const std::string what = row["scene"] + " " + row["M"];
    const double e = m.irradiance_lx, sd = std::stod(row["sd_over_E"]) * e;
    EXPECT_NEAR(m.rotation.x, std::stod(row["rx_exact"]), 1e-5 * e) << what;
    EXPECT_NEAR(m.rotation.y, std::stod(row["ry_exact"]), 1e-5 * e) << what;
    EXPECT_NEAR(glm::length(m.turned.mean() - m.rotation), std::stod(row["bias_over_E"]) * e,
                tolerance(sd, 200) + 1e-6 * e)
        << what;
    EXPECT_NEAR(m.turned.sd(), sd, 0.2 * sd + 1e-6 * e) << what;
    ++rows;
  }
  EXPECT_GE(rows, 12);
}

/// What occlusion adds by itself, of the light that is there and of even light.
TEST(RayGradients, OcclusionIsWhatTheHybridHasMore) {
  double most = 0;
  for (const test::GradientScene& scene : test::gradient_scenes()) {
    RandomStream random(32, Stage::test, 1);
    Hemisphere h = test::seen_by_rays(scene, 16, slices_for(16), random);
    const OcclusionGradient edges = occlusion_gradient(h, 1e-6f);
    const auto expect = [&](const Vec3& found, int channel, const char* what) {
      const Vec3 hybrid = ray_gradients(h, GradientMode::hybrid, 1e-6f).translation[channel],
                 blind = ray_gradients(h, GradientMode::analytic, 1e-6f).translation[channel];
      EXPECT_LE(glm::length(found - (hybrid - blind)), 1e-5f * (glm::length(hybrid) + glm::length(blind)))
          << scene.name << what;
      most = std::max(most, static_cast<double>(glm::length(found)));
    };
    for (int c = 0; c < 3; ++c) expect(edges.light[c], c, " light");
    std::fill(h.radiance.begin(), h.radiance.end(), Rgb(1 / kPi));
    expect(edges.even, 0, " even");
  }
  EXPECT_GT(most, 0.1);
}

/// What is unbiased must be so, whatever the tables say: within four standard errors of the closed form and a
/// bias that the width of the cells leaves (docs/methods.md#b1: of the order of 1/M^2).
TEST(RayGradients, AgreeWithClosedForms) {
  for (const test::GradientScene& scene : test::gradient_scenes()) {
    for (const int rings : {8, 16}) {
      const Measured& m = measured(scene.name, rings);
      const auto expect = [&](const Spread& s, const DVec2& exact, double bias, const char* what) {
        EXPECT_LT(glm::length(s.mean() - exact), 4 * s.sd() / std::sqrt(kReps) + bias * m.irradiance_lx)
            << scene.name << " " << rings << " " << what;
      };
      const double width = 64.0 / (rings * rings);  // 1 at eight rings
      if (!scene.occluded) expect(m.of_mode.at(GradientMode::analytic), m.translation, 0.01, "analytic");
      expect(m.of_mode.at(GradientMode::hybrid), m.translation, scene.occluded ? 0.04 * width : 0.01,
             "hybrid");
      expect(m.turned, m.rotation, 0.015 * width, "rotation");
    }
  }
}

/// The stated error is the true spread or somewhat more.
TEST(RayGradients, StatedErrorIsHonest) {
  for (const test::GradientScene& scene : test::gradient_scenes()) {
    if (scene.name == "white_furnace") continue;  // no spread
    for (const int rings : {4, 8, 16}) {
      const Measured& m = measured(scene.name, rings);
      const double mean = m.value.mean().x, truth = std::sqrt(m.value.squares.x / m.value.n - mean * mean);
      const double ratio = std::sqrt(m.value.mean().y) / truth;
      std::printf("%-16s %2d rings: error %.4f of the value, stated / true %.2f\n", scene.name.c_str(), rings,
                  truth / mean, ratio);
      EXPECT_GT(ratio, 0.9) << scene.name << " " << rings;
      EXPECT_LT(ratio, 1.5) << scene.name << " " << rings;
      EXPECT_NEAR(mean, m.irradiance_lx, 4 * truth / std::sqrt(kReps)) << scene.name << " " << rings;
    }
  }
}

}  // namespace
}  // namespace phos
