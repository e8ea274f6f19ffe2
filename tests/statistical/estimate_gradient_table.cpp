// What each estimator of gradients is worth: bias and spread per sample count, on scenes with closed forms,
// in data/golden/irradiance/gradient_estimators.csv. The test measures a part of the table anew with other
// random numbers; run with --update to write all of it.
#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "estimate/hemisphere/ray_gradients.h"
#include "photon/hull.h"
#include "support/golden.h"
#include "support/golden_table.h"
#include "support/gradient_scenes.h"

namespace phos::test {
namespace {

constexpr const char* kTable = "irradiance/gradient_estimators.csv";
constexpr const char* kHeader =
    "quantity,samples,scene,estimator,count,radius_m,reps,exact_x_over_E,exact_y_over_E,mean_x_over_E,"
    "mean_y_over_E,bias_over_E,sd_over_E,rmse_over_E\n";

/// One row: everything over E, per m or per rad.
struct Row {
  std::string key;  // the first six columns
  DVec2 exact{0};
  Spread spread;
  double bias() const { return glm::length(spread.mean() - exact); }
  double rmse() const { return std::hypot(bias(), spread.sd()); }
};

/// The estimators of one scene and sample count.
class Measurement {
 public:
  Measurement(std::string samples, const GradientScene& scene, std::size_t count, double radius_m)
      : samples_(std::move(samples)), scene_(scene), place_(text(",", count, ",", radius_m)) {
    const double e = scene.irradiance_lx(scene.receiver);
    per_e_ = 1 / e, translation_ = scene.translation() / e, rotation_ = scene.rotation() / e;
  }
  void translation(const char* estimator, const Gradients& g) {
    add("translation", estimator, translation_, g.translation[1]);
  }
  void rotation(const char* estimator, const Gradients& g) {
    add("rotation", estimator, rotation_, g.rotation[1]);
  }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  void add(const char* quantity, const char* estimator, const DVec2& exact, const Vec3& value) {
    const std::string key = text(quantity, ",", samples_, ",", scene_.name, ",", estimator, place_);
    auto at = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.key == key; });
    if (at == rows_.end()) at = rows_.insert(rows_.end(), {key, exact, {}});
    at->spread.add(DVec2(value.x, value.y) * per_e_);
  }
  std::string samples_;
  const GradientScene& scene_;
  std::string place_;
  double per_e_ = 0;
  DVec2 translation_{0}, rotation_{0};
  std::vector<Row> rows_;
};

std::vector<Row> from_rays(const GradientScene& scene, int rings, int reps, std::uint64_t seed) {
  Measurement m("rays", scene, static_cast<std::size_t>(rings * slices_for(rings)), 0);
  for (int r = 0; r < reps; ++r) {
    RandomStream random(seed, Stage::test,
                        static_cast<std::uint64_t>(rings) << 32 | static_cast<unsigned>(r));
    Hemisphere h = seen_by_rays(scene, rings, slices_for(rings), random);
    for (const GradientMode mode :
         {GradientMode::analytic, GradientMode::hybrid, GradientMode::ward_heckbert, GradientMode::krivanek})
      m.translation(name_of(mode), ray_gradients(h, mode, 1e-6f));
    m.rotation("rings", ray_gradients(h, GradientMode::analytic, 1e-6f));
    h.rings = h.slices = 0;
    m.rotation("unstructured", ray_gradients(h, GradientMode::analytic, 1e-6f));
  }
  return m.rows();
}

std::vector<Row> from_photons(const GradientScene& scene, double radius_m, std::size_t expected, int reps,
                              std::uint64_t seed) {
  Measurement m("photons", scene, expected, radius_m);
  const PhotonSource source(scene, radius_m);
  const double area = source.area_m2();
  ZonePhotons zone;
  Hull hull;
  for (int r = 0; r < reps; ++r) {
    RandomStream random(seed, Stage::test, std::uint64_t{expected} << 32 | static_cast<unsigned>(r));
    source.draw_poisson(static_cast<double>(expected), random, zone);
    std::vector<std::uint8_t> used(zone.size(), 1);
    const ComparedGradients disc = compare_gradients(zone, used, area, Frame(), disc_shape(radius_m));
    const Gradients cells = hemisphere_gradients(zone, used, area, Frame(), 8);
    m.translation("analytic", disc.analytic), m.translation("hemisphere", cells);
    m.translation("positional", disc.positional), m.translation("blend", disc.blend);
    m.rotation("analytic", disc.analytic), m.rotation("hemisphere", cells);
    convex_hull(zone.offset_m, hull);
    for (const std::uint32_t v : hull.vertices) used[v] = 0;
    const ComparedGradients within =
        compare_gradients(zone, used, hull.area, Frame(), polygon_shape(zone.offset_m, hull.vertices));
    m.translation("analytic in hull", within.analytic);
    m.translation("positional in hull", within.positional), m.translation("blend in hull", within.blend);
  }
  return m.rows();
}

/// All of the table, or the part that is quick to make.
std::vector<Row> table(bool whole, std::uint64_t seed) {
  std::vector<Row> rows;
  const auto append = [&](const std::vector<Row>& more) {
    rows.insert(rows.end(), more.begin(), more.end());
  };
  for (const GradientScene& scene : gradient_scenes())
    for (const int rings : whole ? std::vector<int>{4, 8, 16, 32} : std::vector<int>{8, 16})
      append(from_rays(scene, rings, !whole ? 100 : rings > 16 ? 250 : 1000, seed));
  for (const char* name : {"rect_ceiling", "rect_wall_x1", "closed_box_5L", "rect_occluded"})
    for (const double radius_m : {0.1, 0.4})
      for (const std::size_t n :
           whole ? std::vector<std::size_t>{100, 1000, 10000} : std::vector<std::size_t>{100, 1000})
        append(from_photons(gradient_scene(name), radius_m, n,
                            !whole     ? static_cast<int>(20000 / n) + 80
                            : n > 1000 ? 250
                                       : 1000,
                            seed));
  return rows;
}

std::string csv(const std::vector<Row>& rows) {
  std::string out = kHeader;
  for (const Row& r : rows) {
    char numbers[200];
    const DVec2 mean = r.spread.mean();
    std::snprintf(numbers, sizeof numbers, ",%.0f,%.6g,%.6g,%.6g,%.6g,%.4g,%.4g,%.4g\n", r.spread.n,
                  r.exact.x, r.exact.y, mean.x, mean.y, r.bias(), r.spread.sd(), r.rmse());
    out += r.key + numbers;
  }
  return out;
}

TEST(GradientTable, IsWhatTheEstimatorsGive) {
  if (updating_golden()) return update_text(kTable, csv(table(true, 1)));
  std::map<std::string, std::map<std::string, std::string>> stored;
  for (auto& row : golden("gradient_estimators.csv"))
    stored[row["quantity"] + "," + row["samples"] + "," + row["scene"] + "," + row["estimator"] + "," +
           row["count"] + "," + row["radius_m"]] = row;
  for (const Row& fresh : table(false, 2)) {
    ASSERT_TRUE(stored.contains(fresh.key)) << fresh.key << ": run this program with --update";
    auto& row = stored[fresh.key];
    const auto number = [&](const char* column) { return std::stod(row[column]); };
    // Exact zeros come out as rounding.
    const double rounding = 1e-6, sd = number("sd_over_E");
    EXPECT_NEAR(fresh.exact.x, number("exact_x_over_E"), rounding * 10) << fresh.key;
    EXPECT_NEAR(fresh.exact.y, number("exact_y_over_E"), rounding * 10) << fresh.key;
    const double tolerance =
        4 * std::max(sd, fresh.spread.sd()) * std::sqrt(1 / fresh.spread.n + 1 / number("reps")) + rounding;
    EXPECT_NEAR(fresh.spread.mean().x, number("mean_x_over_E"), tolerance) << fresh.key;
    EXPECT_NEAR(fresh.spread.mean().y, number("mean_y_over_E"), tolerance) << fresh.key;
    // A blend is mostly one, sometimes the other of two estimators: few repetitions do not tell its spread.
    if (fresh.key.find("blend") != std::string::npos) continue;
    EXPECT_NEAR(fresh.spread.sd(), sd, 0.4 * sd + rounding) << fresh.key;
  }
}

}  // namespace
}  // namespace phos::test
