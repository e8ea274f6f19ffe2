// Records as dense as their light is uneven (docs/methods.md#h7), of an estimator whose light is known in
// closed form: that of a point in a box, with noise of a known size.
#include "place/refinement.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "place/on_surfaces.h"
#include "place/placement.h"
#include "place/placement_options.h"
#include "record/tree.h"
#include "support/scenes.h"

namespace phos {
namespace {

constexpr float kNoise = 0.01f, kGradientNoise = 0.2f;
const Vec3 kLamp(0.45f, 0.55f, 0.4f);

Scene box() {
  Scene scene;
  test::begin_instance(scene, "box", test::add_lambert(scene, "grey", 0.5f));
  test::add_room(scene, Vec3(0), Vec3(1));
  finalize(scene);
  return scene;
}

/// E = cos / d2, lx.
double light_at(const Vec3& p, const Vec3& n) {
  const DVec3 to = DVec3(kLamp) - DVec3(p);
  return std::max(0.0, glm::dot(to, DVec3(n))) / std::pow(glm::dot(to, to), 1.5);
}
/// Its gradient: with l = to . n, grad l d^-3 = -n d^-3 + 3 l to d^-5; along the surface, the latter's part.
Vec3 slope_at(const Vec3& p, const Vec3& n) {
  const Vec3 to = kLamp - p, along = to - glm::dot(to, n) * n;
  return 3 * glm::dot(to, n) * along / std::pow(glm::dot(to, to), 2.5f);
}
/// Harmonic distance, nearly: a wall at a distance x beside takes 2 / (3 pi x) of 1 / D.
float distance_at(const Vec3& p) {
  double over = 0.6;
  for (int axis = 0; axis < 3; ++axis)
    for (const double x : {static_cast<double>(p[axis]), 1 - static_cast<double>(p[axis])})
      if (x > 1e-4) over += 0.2122 / x;
  return static_cast<float>(1 / over);
}

/// Of unit variance.
float gauss(RandomStream& random) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += random.uniform_double();
  return static_cast<float>(sum - 6);
}

class PointInABox : public Estimator {
 public:
  std::unique_ptr<Worker> make_worker() const override { return std::make_unique<Worker>(); }
  Made make(const RecordSite& site, Worker&) const override {
    RandomStream random(5, Stage::test, site.item);
    IrradianceRecord r;
    r.position = site.position, r.normal = site.normal;
    const auto light = static_cast<float>(light_at(site.position, site.normal));
    r.distance_m = r.radius_m = distance_at(site.position);
    r.irradiance = Rgb(light * (1 + kNoise * gauss(random)));
    r.stderr_lx = Rgb(kNoise * light);
    const Frame frame = make_frame(site.normal);
    const float error = kGradientNoise * light / r.distance_m;
    const Vec3 slope =
        slope_at(site.position, site.normal) + error * (gauss(random) * frame.x + gauss(random) * frame.y);
    for (Vec3& g : r.translation_gradient) g = slope;
    return {r};
  }
};

struct Placed {
  IrradianceCache cache;
  PlacementReport report;
};

Placed place_in(const Scene& scene, std::optional<double> error) {
  const RayScene rays(scene);
  RecordOptions options;
  options.estimate = Estimate::gather;
  if (error) options.accuracy = 1 / 3.0;
  options.resolve(scene.bounds.diagonal_m() / 4);
  PlacementOptions placement{.place = Place::surface};
  placement.error = error;
  Placed placed;
  placed.cache.accuracy = options.accuracy;
  Counters counters;
  placed.report = place_on_surfaces(placed.cache, PointInABox(), rays, options, placement, counters);
  return placed;
}

struct Point {
  Vec3 position, normal;
};
/// Evenly over the six faces.
std::vector<Point> points_inside(std::size_t n) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(8, Stage::test, i);
    const int axis = static_cast<int>(i % 3);
    const float side = i % 2 == 0 ? 0.f : 1.f;
    const Vec2 uv = random.uniform2();
    Point p{Vec3(0), Vec3(0)};
    p.position[axis] = side, p.normal[axis] = 1 - 2 * side;
    p.position[(axis + 1) % 3] = uv.x, p.position[(axis + 2) % 3] = uv.y;
    points.push_back(p);
  }
  return points;
}

/// Root mean square error as readers see it, of the mean.
double error_of(const Scene& scene, const IrradianceCache& cache) {
  RecordTree tree(scene.bounds, reading_accuracy(cache.accuracy));
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  double squares = 0, light = 0;
  for (const Point& p : points_inside(6000)) {
    const double truth = light_at(p.position, p.normal);
    const auto read = static_cast<double>(tree.interpolate(p.position, p.normal).irradiance.x);
    squares += (read - truth) * (read - truth) / 6000, light += truth / 6000;
  }
  return std::sqrt(squares) / light;
}

/// Records inside of the box: there are some outside too, in the dark.
std::size_t lit(const IrradianceCache& cache) {
  return static_cast<std::size_t>(
      std::count_if(cache.records.begin(), cache.records.end(),
                    [](const IrradianceRecord& r) { return r.irradiance.x > 0; }));
}

TEST(Refinement, NoiseIsWhatPairsTell) {
  const PointInABox estimator;
  const auto worker = estimator.make_worker();
  std::vector<Made> first, second;
  std::uint64_t item = 0;
  for (const Point& p : points_inside(1000)) {
    first.push_back(estimator.make({p.position, p.normal, item++}, *worker));
    second.push_back(estimator.make({p.position, p.normal, item++}, *worker));
  }
  const RecordNoise noise = noise_of(first, second);
  // A variance from 1000 pairs: its root within 1/sqrt(2000) of itself; light weighs unevenly.
  EXPECT_NEAR(noise.irradiance, static_cast<double>(kNoise), 0.15 * static_cast<double>(kNoise));
  EXPECT_NEAR(noise.gradient, static_cast<double>(kGradientNoise), 0.1 * static_cast<double>(kGradientNoise));
  EXPECT_NEAR(noise.stated, 1, 0.15);
  EXPECT_EQ(noise_of({}, {}).irradiance, 0);
}

TEST(Refinement, FewRecordsMeetTheError) {
  const Scene scene = box();
  const Placed coarse = place_in(scene, 0.1), fine = place_in(scene, 0.01), by_rules = place_in(scene, {});
  EXPECT_LT(error_of(scene, coarse.cache), 0.1);
  EXPECT_LT(error_of(scene, fine.cache), 0.0125);
  EXPECT_LT(lit(coarse.cache), lit(fine.cache));
  EXPECT_LE(lit(fine.cache), 5000u);
  EXPECT_GT(lit(by_rules.cache), 8 * lit(fine.cache));
  EXPECT_LT(fine.report.uncovered_share.value(), 1e-3);
}

TEST(Refinement, NeighboursMakeGradientsBetter) {
  const Scene scene = box();
  const Placed placed = place_in(scene, 0.02);
  ASSERT_EQ(placed.cache.records.size(), placed.report.made_records.size());
  double own = 0, fitted = 0;
  for (std::size_t i = 0; i < placed.cache.records.size(); ++i) {
    const IrradianceRecord& r = placed.cache.records[i];
    if (!(r.irradiance.x > 0)) continue;
    const Vec3 slope = slope_at(r.position, r.normal);
    const double size = static_cast<double>(r.distance_m / r.irradiance.x);
    own += std::pow(size * static_cast<double>(glm::length(
                               placed.report.made_records[i].record.translation_gradient[0] - slope)),
                    2);
    fitted += std::pow(size * static_cast<double>(glm::length(r.translation_gradient[0] - slope)), 2);
  }
  EXPECT_LT(fitted, 0.25 * own);
}

TEST(Refinement, SameRecordsForAnyNumberOfThreads) {
  const Scene scene = box();
  set_threads(1);
  const Placed one = place_in(scene, 0.02);
  set_threads(2);
  const Placed many = place_in(scene, 0.02);
  set_threads(0);
  ASSERT_EQ(one.cache.records.size(), many.cache.records.size());
  for (std::size_t i = 0; i < one.cache.records.size(); ++i) {
    EXPECT_EQ(one.cache.records[i].position, many.cache.records[i].position);
    EXPECT_EQ(one.cache.records[i].radius_m, many.cache.records[i].radius_m);
    EXPECT_EQ(one.cache.records[i].translation_gradient[0], many.cache.records[i].translation_gradient[0]);
  }
}

}  // namespace
}  // namespace phos
