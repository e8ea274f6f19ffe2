// Scenes whose floats hold an offset: how far from the origin of coordinates each estimate stays right.
// (Scenes from files do not come to that: extremes/scene_origin.)
#include <gtest/gtest.h>

#include "core/random.h"
#include "direct/direct_light.h"
#include "estimate/gather.h"
#include "support/gathered.h"
#include "support/records.h"
#include "support/sweep.h"

namespace phos::test {
namespace {

/// Error of an estimate beside its own standard errors, relative to the truth.
using OffBy = std::function<double(const AnalyticScene&)>;

double beyond_noise(double value, double stderr_lx, double truth) {
  const double off = std::max(0.0, std::fabs(value - truth) - 4.5 * stderr_lx) / truth;
  return std::isfinite(off) ? off : HUGE_VAL;
}

/// Off by 1 to 2^24 diagonals, until it is wrong by 2 %.
void sweep_offsets(const std::string& quantity, const AnalyticScene& s, const OffBy& off_by) {
  const float diagonal = s.scene.bounds.diagonal_m();
  double last = 0, worst = off_by(s);
  EXPECT_LT(worst, 0.02) << quantity << " at home";
  std::string beyond = "above: not tested";
  for (int n = 0; n <= 24; n += 2) {
    const Vec3 by = std::ldexp(diagonal, n) * Vec3(0.6f, -0.3f, 0.75f);
    double off = HUGE_VAL;
    try {
      off = off_by(moved(s, by));
      beyond = "above: wrong";
    } catch (const Error& e) {
      beyond = "above: refused";
      std::printf("%s, 2^%d diagonals: %s\n", quantity.c_str(), n, e.what());
    }
    if (!(off <= 0.02)) break;
    last = std::ldexp(1.0, n), worst = std::max(worst, off);
  }
  EXPECT_GE(last, 1000) << quantity;
  expect_limit({quantity, "offset of the coordinates, diagonals", 0, last, worst, beyond, true});
}

TEST(Offset, DirectLight) {
  for (const AnalyticScene& s : {rectangle_light_parallel(), point_light_over_plane()}) {
    sweep_offsets("direct light, " + s.name, s, [](const AnalyticScene& there) {
      const RayScene rays(there.scene);
      const Luminaires lights(there.scene);
      double worst = 0;
      for (const Check& check : there.checks) {
        RandomStream random(1, Stage::test, 0);
        const DirectIrradiance e = direct_irradiance(
            rays, lights, receiver(there.scene, check.position, check.normal), 1024, random);
        worst = std::max(worst, beyond_noise(static_cast<double>(e.irradiance.y),
                                             static_cast<double>(e.stderr_lx.y), check.irradiance_lx));
      }
      return worst;
    });
  }
}

double worst_record(const AnalyticScene& s, const Estimator& estimator) {
  double worst = 0;
  for (const Check& check : s.checks) {
    const IrradianceRecord r = record_at(estimator, check.position, check.normal);
    worst = std::max(worst, beyond_noise(static_cast<double>(r.irradiance.y),
                                         static_cast<double>(r.stderr_lx.y), s.mean_irradiance_lx));
  }
  return worst;
}

TEST(Offset, Photons) {
  sweep_offsets("irradiance from photons", furnace(0.5f), [](const AnalyticScene& there) {
    const Lit lit = light_up(there.scene, 20000);
    return worst_record(there, DensityEstimator(lit.photons, *lit.rays, all_light(there.scene), 1));
  });
}

TEST(Offset, Gather) {
  sweep_offsets("irradiance by gathering rays", furnace(0.5f), [](const AnalyticScene& there) {
    const Gathered gathered(there.scene);
    const RecordTree tree = half_furnace_tree(there);
    const GatherSource source{.indirect = &tree};
    const RecordOptions options = gather_options(there.scene, Quantity::all, -1, 512);
    return worst_record(there, GatherEstimator(gathered.rays, gathered.lights, source, options, 1));
  });
}

TEST(Offset, EnergyOfPhotons) {
  sweep_offsets("flux on the walls of a closed room", uniform_box(0.5f), [](const AnalyticScene& there) {
    const Lit lit = light_up(there.scene, 20000);
    const double law = there.mean_irradiance_lx * there.area_m2,
                 stored = static_cast<double>(lit.photons.totals.stored_flux_lm.y);
    const double escaped = static_cast<double>(lit.photons.totals.escaped_flux_lm.y);
    return beyond_noise(stored, 100 * std::sqrt(2.0 / 20000), law) + escaped / law;
  });
}

}  // namespace
}  // namespace phos::test
