#include "cache/gradients.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/records.h"

namespace phos {
namespace {

/// Rectangles of uniform luminance round the receiver (origin, normal +z), as in the tables.
struct Rectangle {
  int axis;
  float at;
  Vec2 lo, hi;  // in the other two axes, ascending
  float sign;   // normal along axis
  float luminance;
  float area() const { return (hi.x - lo.x) * (hi.y - lo.y); }
  Vec3 point(const Vec2& u) const {
    const Vec2 q = lo + u * (hi - lo);
    return axis == 0 ? Vec3(at, q) : axis == 1 ? Vec3(q.x, at, q.y) : Vec3(q, at);
  }
  Vec3 normal() const {
    Vec3 n(0);
    n[axis] = sign;
    return n;
  }
};

std::vector<Rectangle> scene_of(const std::string& name) {
  if (name == "rect_ceiling") return {{2, 2, {-0.5f, -1}, {1.5f, 1}, -1, 1}};
  if (name == "rect_wall_x1") return {{0, 1, {-1, 0}, {2, 2}, -1, 1}};
  if (name == "rect_wall_x0.25") return {{0, 0.25f, {-1, 0}, {2, 2}, -1, 1}};
  return {{2, 2, {-1.2f, -1}, {0.8f, 1}, -1, 1},
          {0, -1.2f, {-1, 0}, {1, 2}, 1, 0.5f},
          {0, 0.8f, {-1, 0}, {1, 2}, -1, 0.2f},
          {1, -1, {-1.2f, 0}, {0.8f, 2}, 1, 0.8f},
          {1, 1, {-1.2f, 0}, {0.8f, 2}, -1, 0.1f}};
}

/// Draws photons that land in a disc of radius R about the origin: points on emitters and on the disc, kept
/// in proportion to cos cos / d2.
class PhotonSource {
 public:
  PhotonSource(const std::string& scene, float radius, std::uint64_t item)
      : rectangles_(scene_of(scene)), radius_(radius), random_(13, Stage::test, item) {
    float sum = 0;
    for (const Rectangle& r : rectangles_) cdf_.push_back(sum += r.luminance * r.area());
    for (int i = 0; i < 20000; ++i) most_ = std::max(most_, draw());
    most_ *= 1.2f;
  }
  void add_to(ZonePhotons& zone, float flux) {
    if (drawn_++ % 16 == 0)
      random_.start_bounce(1 + drawn_ / 16);  // a stream is long per bounce, not endless
    while (random_.uniform() * most_ >= draw()) {
    }
    zone.offset_m.push_back(Vec2(x_)), zone.flux_lm.push_back(Rgb(flux)), zone.direction.push_back(w_);
    zone.inverse_distance.push_back(1 / distance_), zone.source_normal.push_back(normal_);
  }

 private:
  float draw() {
    const float u = random_.uniform() * cdf_.back();
    std::size_t i = 0;
    while (cdf_[i] <= u) ++i;
    x_ = Vec3(radius_ * sample_disc(random_.uniform2()), 0);
    const Vec3 d = rectangles_[i].point(random_.uniform2()) - x_;
    distance_ = glm::length(d), w_ = d / distance_, normal_ = rectangles_[i].normal();
    return std::max(-glm::dot(normal_, w_), 0.f) * std::max(w_.z, 0.f) / (distance_ * distance_);
  }
  std::vector<Rectangle> rectangles_;
  std::vector<float> cdf_;
  float radius_, most_ = 0, distance_ = 0;
  RandomStream random_;
  std::uint32_t drawn_ = 0;
  Vec3 x_{0}, w_{0}, normal_{0};
};

struct Spread {
  Vec2 sum{0}, squares{0};
  float n = 0;
  void add(const Vec2& v) { sum += v, squares += v * v, n += 1; }
  Vec2 mean() const { return sum / n; }
  float sd() const {
    const Vec2 v = squares / n - mean() * mean();
    return std::sqrt(std::max(v.x, 0.f) + std::max(v.y, 0.f));
  }
};

TEST(Gradients, TranslationAgreesWithTheTable) {
  std::uint64_t item = 0;
  for (auto& row : test::golden("D_photon_gradients.csv")) {
    const float radius = std::stof(row["R"]), e = std::stof(row["E_exact"]);
    const auto n = static_cast<std::size_t>(std::stoi(row["n"]));
    const int reps = n <= 300 ? 400 : 100;
    const std::string& estimator = row["estimator"];
    PhotonSource source(row["scene"], radius, item++);
    const double area = std::numbers::pi * double(radius) * double(radius);
    const std::vector<std::uint8_t> used(n, 1);
    Spread spread;
    for (int r = 0; r < reps; ++r) {
      ZonePhotons zone;
      for (std::size_t i = 0; i < n; ++i)
        source.add_to(zone, e * static_cast<float>(area) / static_cast<float>(n));
      const Gradients g = estimator.starts_with("grid") ? hemisphere_gradients(zone, used, area, Frame(),
                                                                               std::stoi(estimator.substr(4)))
                                                        : photon_gradients(zone, used, area, Frame());
      spread.add(Vec2(g.translation[1]));
      EXPECT_NEAR(g.translation[0].z, 0, 1e-6f);
    }
    const float sd = std::stof(row["sd_over_E_per_m"]) * e;
    const float tolerance = 4 * sd * std::sqrt(2 / static_cast<float>(reps)) + 0.005f * e;
    EXPECT_NEAR(spread.mean().x, std::stof(row["gx_mean"]), tolerance)
        << row["scene"] << " " << estimator << " " << n;
    EXPECT_NEAR(spread.mean().y, std::stof(row["gy_mean"]), tolerance)
        << row["scene"] << " " << estimator << " " << n;
    EXPECT_NEAR(spread.sd() / sd, 1, 0.3) << row["scene"] << " " << estimator << " " << n;
  }
}

/// Exact values of grad_r from the closed form of E, with the bias that the table measured for 8 ring means.
TEST(Gradients, RotationAgreesWithTheClosedForm) {
  std::uint64_t item = 100;
  for (auto& row : test::golden("B3_rotational.csv")) {
    if (row["M"] != "8" || row["scene"] == "white_furnace") continue;
    const float radius = 0.005f, e = std::stof(row["E_exact"]);
    const std::size_t n = 40000;
    PhotonSource source(row["scene"], radius, item++);
    const double area = std::numbers::pi * double(radius) * double(radius);
    ZonePhotons zone;
    for (std::size_t i = 0; i < n; ++i)
      source.add_to(zone, e * static_cast<float>(area) / static_cast<float>(n));
    const std::vector<std::uint8_t> used(n, 1);
    const float tolerance = (2 * std::stof(row["bias_over_E"]) + 0.04f) * e;
    for (const Gradients& g :
         {photon_gradients(zone, used, area, Frame()), hemisphere_gradients(zone, used, area, Frame(), 8)}) {
      EXPECT_NEAR(g.rotation[0].x, std::stof(row["rx_exact"]), tolerance) << row["scene"];
      EXPECT_NEAR(g.rotation[0].y, std::stof(row["ry_exact"]), tolerance) << row["scene"];
    }
  }
}

/// Gradients are vectors: turning the frame about its normal changes nothing but the cells.
TEST(Gradients, DoNotDependOnTheFrame) {
  PhotonSource source("closed_box_5L", 0.1f, 200);
  ZonePhotons zone;
  for (int i = 0; i < 2000; ++i) source.add_to(zone, 1);
  const std::vector<std::uint8_t> used(zone.size(), 1);
  const Frame turned{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0}, {0, 0, 1}};
  const Gradients a = photon_gradients(zone, used, 1, Frame()), b = photon_gradients(zone, used, 1, turned);
  const Gradients c = hemisphere_gradients(zone, used, 1, Frame(), 16),
                  d = hemisphere_gradients(zone, used, 1, turned, 16);
  EXPECT_LT(glm::length(a.translation[0] - b.translation[0]), 1e-4f * glm::length(a.translation[0]) + 1e-2f);
  EXPECT_LT(glm::length(a.rotation[0] - b.rotation[0]), 1e-4f * glm::length(a.rotation[0]) + 1e-2f);
  EXPECT_LT(glm::length(c.rotation[0] - d.rotation[0]), 0.05f * glm::length(c.rotation[0]));
}

TEST(Gradients, LightFromInfinitelyFarHasNoTranslationGradient) {
  ZonePhotons zone;
  zone.offset_m = {{0, 0}}, zone.flux_lm = {Rgb(1)}, zone.direction = {normalized_or_zero({1, 0, 1})};
  zone.inverse_distance = {0}, zone.source_normal = {-zone.direction[0]};
  const std::vector<std::uint8_t> used{1};
  for (const Gradients& g :
       {photon_gradients(zone, used, 1, Frame()), hemisphere_gradients(zone, used, 1, Frame(), 4)}) {
    EXPECT_EQ(g.translation[0], Vec3(0));
    EXPECT_GT(g.rotation[0].y, 0.5f);
  }
}

}  // namespace
}  // namespace phos
