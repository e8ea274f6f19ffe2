// Radiance records: their file, interpolation between them, and light that leaves by a glossy lobe.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/error.h"
#include "core/parallel.h"
#include "estimate/radiance_gather.h"
#include "radiance/brdf/projection.h"
#include "radiance/tree.h"
#include "support/gathered.h"
#include "support/one_material.h"
#include "support/radiance_records.h"
#include "support/radiance_scenes.h"
#include "support/run.h"

namespace phos {
namespace {

using test::radiance_record;

const Frame kFlat;

Rgb sky(const Vec3& w) { return Rgb(1 + 0.5f * w.x, 1 + 0.4f * w.y * w.z, 0.5f + 0.3f * w.x * w.y); }

Bounds unit_box() {
  Bounds b;
  b.include(Vec3(-1)), b.include(Vec3(1));
  return b;
}

/// Largest difference of two sets of numbers.
float farthest(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  float most = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, std::fabs(a[i] - b[i]));
  return most;
}

BrdfTable phong(float exponent) {
  Material m = test::make_material(Model::phong, Rgb(0.1f), Rgb(0.8f, 0.5f, 0.2f));
  m.exponent = exponent;
  Counters counters;
  return project_brdf(test::scene_of(m), 0, {}, counters);
}

void expect_kept(RadianceCache cache, std::size_t columns) {
  for (const bool gradients : {true, false}) {
    if (!gradients)
      for (RadianceRecord& r : cache.records) r.gradient_x.clear(), r.gradient_y.clear();
    const std::string path = test::scratch("radiance") + "/a.radiance";
    write_radiance(path, cache, test::radiance_provenance());
    const Container file = Container::open(path, FileKind::radiance);
    EXPECT_EQ(file.tensors().size(), columns + (gradients ? 2 : 0));
    EXPECT_EQ(file.provenance().extra.find("order")->as_integer(), 4);
    const RadianceCache back = read_radiance(file);
    EXPECT_EQ(back.accuracy, cache.accuracy);
    EXPECT_EQ(back.scene_hash, "none");
    ASSERT_EQ(back.records.size(), cache.records.size());
    for (std::size_t i = 0; i < cache.records.size(); ++i) {
      const RadianceRecord &a = cache.records[i], &b = back.records[i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(a.frame.x, b.frame.x);
      EXPECT_EQ(a.frame.z, b.frame.z);
      EXPECT_LT(glm::length(a.frame.y - b.frame.y), 1e-6f);
      EXPECT_EQ(a.distance_m, b.distance_m);
      EXPECT_EQ(a.radius_m, b.radius_m);
      EXPECT_EQ(a.light, b.light);
      EXPECT_EQ(a.gradient_x, b.gradient_x);
      EXPECT_EQ(a.gradient_y, b.gradient_y);
      EXPECT_EQ(a.stderr_light, b.stderr_light);
      EXPECT_EQ(a.footprint_m, b.footprint_m);
    }
  }
}

TEST(RadianceFile, KeepsEveryNumber) { expect_kept(test::random_radiance(7, 4), 6); }
TEST(RadianceFile, KeepsRecordsOfDifferentOrders) {
  expect_kept(test::random_radiance({2, 4, 1, 4, 3}), 7);
  EXPECT_EQ(test::random_radiance({2, 4, 1}).order(), 4);
}

TEST(RadianceFile, KeepsFootprints) {
  RadianceCache cache = test::random_radiance(7, 4);
  for (std::size_t i = 0; i < cache.records.size(); ++i)
    for (float& length_m : cache.records[i].footprint_m.emplace()) length_m = 0.01f + static_cast<float>(i);
  cache.records[2].footprint_m->at(5) = 0.25f;
  expect_kept(cache, 7);
}

/// Colour before coefficient, as the format says.
TEST(RadianceFile, ColumnsAreByColour) {
  const RadianceCache cache = test::random_radiance(2, 3);
  const std::string path = test::scratch("radiance") + "/b.radiance";
  write_radiance(path, cache, test::radiance_provenance());
  const Container file = Container::open(path);
  const auto column = file.values<float>("coefficients", {2, 3, 9});
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 9; ++k)
        EXPECT_EQ(column[(i * 3 + c) * 9 + k], cache.records[i].light[3 * k + c]);
}

TEST(RadianceFile, SameCacheSameBytesAndNoneIsAFileToo) {
  const std::string folder = test::scratch("radiance");
  const auto bytes = [](const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  for (const std::string name : {"/c.radiance", "/d.radiance"})
    write_radiance(folder + name, test::random_radiance(5, 2), test::radiance_provenance());
  EXPECT_EQ(bytes(folder + "/c.radiance"), bytes(folder + "/d.radiance"));
  write_radiance(folder + "/none.radiance", {}, test::radiance_provenance());
  EXPECT_TRUE(read_radiance(Container::open(folder + "/none.radiance")).records.empty());
}

TEST(RadianceTree, ARecordAtItsOwnPlaceIsItself) {
  RadianceTree tree(unit_box(), 0.3, 5);
  const RadianceRecord r = radiance_record(sky, Vec3(0), kFlat, 5);
  tree.insert(r);
  RadianceTree::Worker worker;
  EXPECT_FLOAT_EQ(tree.interpolate(Vec3(0), kFlat, 5, worker), 1);
  EXPECT_LT(farthest(worker.light, r.light), 1e-6f);
  EXPECT_LT(farthest(worker.stderr_light, r.stderr_light), 1e-6f);
  // Beyond its reach, or seen from the back, there is nothing.
  EXPECT_EQ(tree.interpolate({0.31f, 0, 0}, kFlat, 5, worker), 0);
  EXPECT_EQ(farthest(worker.light, std::vector<float>(75)), 0);
  EXPECT_EQ(tree.interpolate(Vec3(0), make_frame({0, 0, -1}), 5, worker), 0);
}

/// A function turned about the normal has the coefficients of the other frame, whatever bands are asked for.
TEST(RadianceTree, TurnsAboutTheNormal) {
  RadianceTree tree(unit_box(), 0.3, 6);
  tree.insert(radiance_record(sky, Vec3(0), kFlat, 6));
  RadianceTree::Worker worker;
  for (const float angle : {0.3f, 2.f, -1.2f}) {
    const Frame frame = test::turned_about_z(kFlat, angle);
    for (const int order : {1, 3, 6, 9}) {
      tree.interpolate(Vec3(0), frame, order, worker);
      EXPECT_LT(farthest(worker.light, test::projected(sky, frame, std::min(order, 6))), 3e-6f)
          << angle << " " << order;
    }
  }
}

/// Tilted, light that is the same from everywhere stays so, and other light nearly so: what comes from below
/// the old horizon is not known.
TEST(RadianceTree, TurnsToAnotherNormal) {
  RadianceTree even(unit_box(), 0.5, 8), tree(unit_box(), 0.5, 8);
  const auto one = [](const Vec3&) { return Rgb(1); };
  even.insert(radiance_record(one, Vec3(0), kFlat, 8));
  const RadianceRecord r = radiance_record(sky, Vec3(0), kFlat, 8);
  tree.insert(r);
  RadianceTree::Worker worker;
  for (const float tilt : {0.05f, 0.15f, 0.3f}) {
    const Frame frame = make_frame({0.6f * std::sin(tilt), -0.8f * std::sin(tilt), std::cos(tilt)});
    EXPECT_GT(even.interpolate(Vec3(0), frame, 8, worker), 0);
    EXPECT_LT(farthest(worker.light, test::projected(one, frame, 8)), 2e-3f) << tilt;
    tree.interpolate(Vec3(0), frame, 8, worker);
    const auto off = [&](const std::vector<float>& light) {
      const std::vector<double> truth = test::channel(test::projected(sky, frame, 8));
      return test::distance(test::channel(light), truth) / test::norm(truth);
    };
    EXPECT_LT(off(worker.light), 0.1 * static_cast<double>(tilt));
    // It was turned: left as it is, the light would be wrong by more.
    EXPECT_GT(off(r.light), 2.5 * off(worker.light)) << off(r.light);
  }
}

/// Light that changes evenly with the place is right between records, in whatever frames they keep it.
TEST(RadianceTree, ExtrapolatesByGradients) {
  const auto light_at = [](const Vec3& p) {
    return [p](const Vec3& w) { return (1 + 0.5f * p.x - 0.3f * p.y) * sky(w); };
  };
  RadianceTree tree(unit_box(), 0.5, 4);
  for (const Vec3& p : {Vec3(0), Vec3(0.2f, 0.1f, 0), Vec3(-0.1f, 0.2f, 0)}) {
    const Frame frame = test::turned_about_z(kFlat, 3 * p.x);
    RadianceRecord r = radiance_record(light_at(p), p, frame, 4);
    const std::vector<float> base = test::projected(sky, frame, 4);
    for (std::size_t i = 0; i < base.size(); ++i) {
      r.gradient_x[i] = base[i] * (0.5f * frame.x.x - 0.3f * frame.x.y);
      r.gradient_y[i] = base[i] * (0.5f * frame.y.x - 0.3f * frame.y.y);
    }
    tree.insert(r);
  }
  RadianceTree::Worker worker;
  const Vec3 p(0.05f, 0.1f, 0);
  const float weight = tree.interpolate(p, kFlat, 4, worker);
  EXPECT_EQ(worker.found.size(), 3u);
  EXPECT_LT(farthest(worker.light, test::projected(light_at(p), kFlat, 4)), 5e-6f);
  EXPECT_FLOAT_EQ(weight, tree.irradiance().interpolate(p, {0, 0, 1}).weight);
  const Rgb e = tree.irradiance().interpolate(p, {0, 0, 1}).irradiance;
  EXPECT_NEAR(e.x, 1.2533141f * worker.light[0] + 0.7236013f * worker.light[6], 1e-5f);
}

/// A step that would change the light by more than its own energy is shortened to that.
TEST(RadianceTree, BoundsTheExtrapolation) {
  RadianceTree tree(unit_box(), 0.5, 3);
  RadianceRecord r = radiance_record(sky, Vec3(0), kFlat, 3);
  for (std::size_t i = 0; i < r.light.size(); ++i) r.gradient_x[i] = -100 * r.light[i];
  tree.insert(r);
  RadianceTree::Worker worker;
  tree.interpolate({0.005f, 0, 0}, kFlat, 3, worker);
  EXPECT_NEAR(worker.light[0], 0.5f * r.light[0], 1e-4f);
  tree.interpolate({0.4f, 0, 0}, kFlat, 3, worker);
  EXPECT_NEAR(worker.light[0], 0, 1e-4f);
}

/// Light leaving by a lobe is the integral of the lobe and the light: what the table's own lookup says of the
/// light projected there.
TEST(RadianceTree, LightThatLeaves) {
  const BrdfTable table = phong(8);
  const BrdfLookup brdf(table);
  RadianceTree tree(unit_box(), 0.3, 10);
  tree.insert(radiance_record(sky, Vec3(0), test::turned_about_z(kFlat, 1), 10));
  RadianceTree::Worker worker;
  const std::vector<float> light = test::projected(sky, kFlat, 10);
  for (const Vec3& towards : {Vec3(0, 0, 1), Vec3(0.5f, 0.2f, 0.8f), Vec3(-0.9f, 0.1f, 0.4f)}) {
    const Vec3 wo = glm::normalize(towards);
    if (brdf.order(wo) == 0) continue;
    std::vector<float> lobe;
    const int order = brdf.coefficients(wo, lobe);
    const GlossyLight out = tree.outgoing(Vec3(0), kFlat, lobe, Rgb(0), worker);
    EXPECT_EQ(out.weight, tree.interpolate(Vec3(0), kFlat, order, worker));
    const Rgb expected = brdf.outgoing(wo, light);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(out.radiance[c], expected[c], 1e-5f);
      EXPECT_GT(out.radiance[c], 0);
      // All bands err by 0.01: as much as the lobe is large.
      float energy = 0;
      for (std::size_t i = static_cast<std::size_t>(c); i < worker.light.size(); i += 3)
        energy += lobe[i] * lobe[i];
      EXPECT_NEAR(out.stderr_cd[c], 0.01f * std::sqrt(energy), 1e-6f);
    }
  }
  const float lobe[] = {1, 1, 1};
  EXPECT_EQ(tree.outgoing({0.5f, 0, 0}, kFlat, lobe, Rgb(0), worker).weight, 0);
}

/// Whether light is turned to the point or the lobe to each record, in frames of all kinds, grey or coloured.
TEST(RadianceTree, TurnsLobesAsItTurnsLight) {
  RadianceTree tree(unit_box(), 0.6, 7);
  for (std::uint64_t i = 0; i < 12; ++i) {
    RandomStream random(3, Stage::test, i);
    const Vec3 tilt = 0.25f * sample_uniform_sphere(random.uniform2());
    RadianceRecord r = test::random_radiance({7}).records[0];
    r.position = {0.1f * random.uniform(), 0.1f * random.uniform(), 0};
    r.frame = test::turned_about_z(make_frame(glm::normalize(Vec3(0, 0, 1) + tilt)), 6 * random.uniform());
    r.radius_m = 1;
    for (std::size_t k = 0; k < r.light.size(); ++k) r.light[k] += 0.1f * random.uniform();
    tree.insert(r);
  }
  RadianceTree::Worker worker;
  const Frame frame = test::turned_about_z(make_frame(glm::normalize(Vec3(0.1f, -0.05f, 1))), 2);
  const Vec3 p(0.05f, 0.04f, 0);
  for (const int order : {1, 4, 7}) {
    for (const bool grey : {true, false}) {
      std::vector<float> lobe(3 * static_cast<std::size_t>(harmonic_count(order)));
      for (std::size_t i = 0; i < lobe.size(); ++i)
        lobe[i] = std::sin(static_cast<float>(grey ? i / 3 : i) + 1);
      const GlossyLight out = tree.outgoing(p, frame, lobe, Rgb(-1e6f), worker);
      EXPECT_EQ(out.weight, tree.interpolate(p, frame, order, worker));
      ASSERT_GT(worker.found.size(), 5u);
      DVec3 sum(0), size(0);
      for (std::size_t i = 0; i < lobe.size(); i += 3)
        for (int c = 0; c < 3; ++c) {
          const auto at = i + static_cast<std::size_t>(c);
          const double term = static_cast<double>(lobe[at]) * static_cast<double>(worker.light[at]);
          sum[c] += term, size[c] += std::fabs(term);
        }
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(out.radiance[c], sum[c], 1e-5 * size[c]) << order << ' ' << grey;
    }
  }
}

/// Light from one narrow direction rings in the harmonics: what would be negative is black.
TEST(RadianceTree, NeverLessThanBlack) {
  const BrdfTable table = phong(30);
  const BrdfLookup brdf(table);
  RadianceTree tree(unit_box(), 0.3, 10);
  const Vec3 lamp = glm::normalize(Vec3(0.6f, 0, 0.8f));
  tree.insert(
      radiance_record([&](const Vec3& w) { return Rgb(std::pow(std::max(0.f, glm::dot(w, lamp)), 200.f)); },
                      Vec3(0), kFlat, 10));
  RadianceTree::Worker worker;
  float least_before = 0;
  for (int i = 0; i < 60; ++i) {
    const float a = 0.1f * static_cast<float>(i);
    const Vec3 wo(0.5f * std::cos(a), 0.5f * std::sin(a), 0.8660254f);
    if (brdf.order(wo) == 0) continue;
    std::vector<float> lobe;
    const int order = brdf.coefficients(wo, lobe);
    const Rgb out = tree.outgoing(Vec3(0), kFlat, lobe, Rgb(0), worker).radiance;
    tree.interpolate(Vec3(0), kFlat, order, worker);
    least_before = std::min(least_before, brdf.outgoing(wo, worker.light).x);
    EXPECT_GE(std::min({out.x, out.y, out.z}), 0);
  }
  EXPECT_LT(least_before, 0) << "nothing rang: the test tests nothing";
}

TEST(RadianceTree, SameFromAnyThread) {
  const RadianceCache cache = test::random_radiance(200, 5);
  RadianceTree tree(unit_box(), 0.5, 5);
  for (const RadianceRecord& r : cache.records) tree.insert(r);
  const auto look = [&](std::size_t i, RadianceTree::Worker& worker) {
    const RadianceRecord& r = cache.records[i % cache.records.size()];
    return tree.interpolate(r.position + Vec3(0.01f), r.frame, 5, worker);
  };
  std::vector<std::vector<float>> alone(400), together(400);
  RadianceTree::Worker worker;
  for (std::size_t i = 0; i < alone.size(); ++i) look(i, worker), alone[i] = worker.light;
  set_threads(4);
  parallel_chunks(together.size(), 16, [&](std::size_t begin, std::size_t end) {
    RadianceTree::Worker own;
    for (std::size_t i = begin; i < end; ++i) look(i, own), together[i] = own.light;
  });
  set_threads(0);
  EXPECT_EQ(alone, together);
}

TEST(RadianceTree, RefusesOrdersThatItDoesNotHold) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_THROW(RadianceTree(unit_box(), 0.3, 0), Error);
  EXPECT_THROW(RadianceTree(unit_box(), 0.3, 31), Error);
  EXPECT_THROW(RadianceProjector(0), Error);
  RadianceTree tree(unit_box(), 0.3, 4);
  EXPECT_DEATH(tree.insert(radiance_record(sky, Vec3(0), kFlat, 5)), "order 5 among records of order 4");
}

TEST(RadianceEstimator, RaysLieInCellsOfEqualSolidAngle) {
  test::Gathered g(test::uniform_box(0.5f).scene);
  const RecordOptions options = test::gather_options(g.scene, Quantity::indirect, 1, 1000);
  const RadianceEstimator estimator(g.rays, g.lights, {}, options, 2, RadianceGradient::none, 1);
  const auto worker = estimator.make_worker();
  estimator.make({{0.5f, 0, 0.5f}, {0, 1, 0}, 1}, *worker);
  const Hemisphere& h = RadianceEstimator::seen(*worker);
  EXPECT_EQ(h.measure, Measure::solid);
  double solid = 0, projected = 0;
  for (int j = 0; j < h.rings; ++j) {
    for (int k = 0; k < h.slices; ++k) {
      const std::size_t i = h.at(j, k);
      const Vec3 w = h.frame.to_local(h.direction[i]);
      EXPECT_NEAR((1 - w.z) * static_cast<float>(h.rings), static_cast<float>(j) + 0.5f, 0.5001f);
      const float turns = std::atan2(w.y, w.x) / (2 * kPi);
      EXPECT_NEAR((turns < 0 ? turns + 1 : turns) * static_cast<float>(h.slices),
                  static_cast<float>(k) + 0.5f, 0.501f);
      EXPECT_NEAR(h.projected_sr[i], h.solid_sr(i) * w.z, 1e-6f * h.solid_sr(i));
      solid += static_cast<double>(h.solid_sr(i)), projected += static_cast<double>(h.projected_sr[i]);
    }
  }
  EXPECT_NEAR(solid, 2 * std::numbers::pi, 1e-4);
  EXPECT_NEAR(projected, std::numbers::pi, 0.01);
}

/// The same record from any thread and in any order of places; another item, another record.
TEST(RadianceEstimator, DependsOnSiteAndSeedAlone) {
  test::Gathered g(test::uniform_box(0.5f).scene);
  const RecordOptions options = test::gather_options(g.scene, Quantity::indirect, 1, 256);
  const auto make = [&](std::uint64_t item, std::uint64_t seed) {
    const RadianceEstimator estimator(g.rays, g.lights, {}, options, 4, RadianceGradient::analytic, seed);
    const auto worker = estimator.make_worker();
    estimator.make({{1, 0, 1}, {0, 1, 0}, 77}, *worker);
    return *estimator.make({{0.5f, 0, 0.5f}, {0, 1, 0}, item}, *worker).radiance;
  };
  EXPECT_EQ(make(3, 1).light, make(3, 1).light);
  EXPECT_NE(make(3, 1).light, make(4, 1).light);
  EXPECT_NE(make(3, 1).light, make(3, 2).light);
}

/// Lower orders are the first bands of higher ones, and gradients can be left out at no change of the rest.
TEST(RadianceEstimator, OrdersAndGradientsAreIndependent) {
  test::Gathered g(test::uniform_box(0.5f).scene);
  const RecordOptions options = test::gather_options(g.scene, Quantity::indirect, 1, 256);
  const auto make = [&](int order, RadianceGradient gradient) {
    const RadianceEstimator estimator(g.rays, g.lights, {}, options, order, gradient, 1);
    const auto worker = estimator.make_worker();
    return *estimator.make({{0.5f, 0, 0.5f}, {0, 1, 0}, 1}, *worker).radiance;
  };
  const RadianceRecord high = make(7, RadianceGradient::hybrid), low = make(3, RadianceGradient::hybrid),
                       without = make(7, RadianceGradient::none);
  EXPECT_LT(farthest(low.light, {high.light.begin(), high.light.begin() + 27}), 1e-6f * high.light[0]);
  EXPECT_LT(farthest(low.stderr_light, {high.stderr_light.begin(), high.stderr_light.begin() + 9}),
            1e-6f * high.light[0]);
  EXPECT_LT(farthest(without.light, high.light), 1e-6f * high.light[0]);
  EXPECT_TRUE(without.gradient_x.empty() && without.gradient_y.empty());
  EXPECT_EQ(without.radius_m, high.radius_m) << "the radius asks for gradients all the same";
}

/// What a spot of light at (0.6, 0.2, 0.8) m sends to p of the plane z = 0: nearly a lobe of 15 degrees.
std::vector<float> from_spot(const Vec3& p) {
  const Vec3 towards = glm::normalize(Vec3(0.6f, 0.2f, 0.8f) - p);
  return test::projected([&](const Vec3& w) { return Rgb(std::exp(30 * (glm::dot(w, towards) - 1))); }, kFlat,
                         10);
}

/// A record that knows its slopes exactly, read as far as records are: with the slopes in full, with none,
/// and with what settle_slopes() keeps. Of the squared error of all coefficients at places that it serves,
/// counted by its weight, the last is by far the least.
TEST(RadianceRecord, SettledSlopesErrLessThanFullOnesAndThanNone) {
  constexpr double kAccuracy = 0.75;
  constexpr float kStep = 1e-3f;
  RadianceRecord record = radiance_record([](const Vec3&) { return Rgb(0); }, Vec3(0), kFlat, 10);
  record.radius_m = record.distance_m = glm::length(Vec3(0.6f, 0.2f, 0.8f));
  record.light = from_spot(Vec3(0));
  for (const int axis : {0, 1}) {
    Vec3 step(0);
    step[axis] = kStep;
    const std::vector<float> after = from_spot(step), before = from_spot(-step);
    std::vector<float>& slope = axis == 0 ? record.gradient_x : record.gradient_y;
    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = (after[i] - before[i]) / (2 * kStep);
  }
  RadianceRecord settled = record, none = record;
  settle_slopes(settled, kAccuracy);
  none.gradient_x.assign(300, 0), none.gradient_y.assign(300, 0);
  const auto error = [&](const RadianceRecord& r, const Vec2& step, const std::vector<float>& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < truth.size(); i += 3)
      sum += std::pow(
          static_cast<double>(r.light[i] + step.x * r.gradient_x[i] + step.y * r.gradient_y[i] - truth[i]),
          2);
    return sum;
  };
  double of_full = 0, of_none = 0, of_settled = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec2 u = (Vec2(static_cast<float>(k % 10), static_cast<float>(k / 10)) + 0.5f) / 5.f - 1.f;
    const double weight = 1 - static_cast<double>(glm::length(u));
    if (weight <= 0) continue;
    const Vec2 step = static_cast<float>(kAccuracy) * record.radius_m * u;
    const std::vector<float> truth = from_spot(Vec3(step, 0));
    of_full += weight * error(record, step, truth), of_none += weight * error(none, step, truth);
    of_settled += weight * error(settled, step, truth);
  }
  EXPECT_LT(of_settled, 0.8 * of_none);
  EXPECT_LT(of_settled, 0.8 * of_full);
}

TEST(RadianceRecord, SettledSlopesAreTheSlopesWhereTheReachIsSmall) {
  RadianceRecord near = radiance_record(sky, Vec3(0), kFlat, 4);
  std::fill(near.gradient_x.begin(), near.gradient_x.end(), 2.f), near.gradient_y = near.gradient_x;
  RadianceRecord little = near;
  near.distance_m = 0;  // and the radius is not
  settle_slopes(near, 0.6), settle_slopes(little, 1e-4);
  EXPECT_LT(farthest(little.gradient_y, std::vector<float>(48, 2)), 1e-6f);
  // Nothing but the first band, which does not turn.
  EXPECT_EQ(2, near.gradient_x[2]);
  EXPECT_EQ(std::vector<float>(45), std::vector<float>(near.gradient_x.begin() + 3, near.gradient_x.end()));
}

}  // namespace
}  // namespace phos
