#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "core/sampling.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "support/records.h"
#include "support/run.h"

namespace phos {
namespace {

IrradianceRecord random_record(std::uint64_t i) {
  RandomStream random(3, Stage::test, i);
  IrradianceRecord r;
  r.position = Vec3(random.uniform(), random.uniform(), random.uniform());
  r.normal = sample_uniform_sphere(random.uniform2());
  r.irradiance = Vec3(random.uniform(), random.uniform(), random.uniform()) * 100.f;
  r.stderr_lx = r.irradiance * 0.1f;
  r.radius_m = r.distance_m = 0.05f * std::exp(4 * random.uniform());
  for (int c = 0; c < 3; ++c) {
    r.rotation_gradient[c] = Vec3(random.uniform(), random.uniform(), random.uniform());
    r.translation_gradient[c] = Vec3(random.uniform(), random.uniform(), random.uniform());
  }
  return r;
}

TEST(Records, ErrorAndWeightMatchTheTable) {
  int rows = 0;
  for (auto& row : test::golden("A_weights.csv")) {
    const double a = std::stod(row["a"]), eps = std::stod(row["eps"]), weight = std::stod(row["w_linear"]);
    const float angle = std::stof(row["normal_angle_deg"]) * kPi / 180;
    IrradianceRecord r;
    r.radius_m = row["R"] == "inf" ? kInfinity : std::stof(row["R"]);
    const float e = record_error(r, {std::stof(row["dist"]), 0, 0}, {std::sin(angle), 0, std::cos(angle)});
    EXPECT_NEAR(static_cast<double>(e), eps, 2e-6 * std::max(1.0, eps));
    EXPECT_NEAR(static_cast<double>(record_weight(e, static_cast<float>(a))), weight, 2e-5);
    ++rows;
  }
  EXPECT_EQ(rows, 56);
}

TEST(Records, NormalTermIsNeverNegative) {
  for (std::uint64_t i = 0; i < 10000; ++i) {
    RandomStream random(4, Stage::test, i);
    IrradianceRecord r;
    r.radius_m = 1;
    r.normal = sample_uniform_sphere(random.uniform2());
    EXPECT_EQ(record_error(r, r.position, r.normal), 0.f);
  }
}

TEST(Records, InFrontTestIsFreeOfScale) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    IrradianceRecord r;
    r.radius_m = scale;
    const Vec3 up(0, 0, 1);
    EXPECT_FALSE(record_apart(r, Vec3(0.1f, 0, 0) * scale, up));
    EXPECT_FALSE(record_apart(r, Vec3(0.1f, 0, -0.005f) * scale, up));
    EXPECT_TRUE(record_apart(r, Vec3(0.1f, 0, -0.05f) * scale, up));  // the point lies under the record
    EXPECT_FALSE(record_apart(r, Vec3(0.1f, 0, 0.05f) * scale, up));
    EXPECT_TRUE(record_apart(r, Vec3(0), Vec3(0, 0, -1)));
    EXPECT_TRUE(record_apart(r, Vec3(0), Vec3(1, 0, 0)));
  }
}

TEST(Records, LightNothingOverTheNicheTheyLieIn) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    IrradianceRecord r;
    r.radius_m = scale, r.distance_m = 0.05f * scale;
    const Vec3 up(0, 0, 1);
    EXPECT_FALSE(record_apart(r, Vec3(0.3f, 0, 0.04f) * scale, up));
    EXPECT_TRUE(record_apart(r, Vec3(0.3f, 0, 0.06f) * scale, up));
    r.distance_m = 0;  // a place that touches what it sees: rounding still counts for nothing
    EXPECT_FALSE(record_apart(r, Vec3(0.3f, 0, 0.005f) * scale, up));
    EXPECT_TRUE(record_apart(r, Vec3(0.3f, 0, 0.02f) * scale, up));
  }
}

TEST(Records, ExtrapolationIsLinearAndBounded) {
  IrradianceRecord r;
  r.irradiance = {10, 20, 0};
  r.translation_gradient[0] = {3, 0, 0};
  r.rotation_gradient[1] = {0, 5, 0};
  r.translation_gradient[2] = {7, 0, 0};
  EXPECT_EQ(extrapolate(r, {0, 0, 0}, r.normal), r.irradiance);
  EXPECT_NEAR(extrapolate(r, {0.5f, 9, 0}, r.normal).x, 11.5f, 1e-5f);
  EXPECT_EQ(extrapolate(r, {100, 0, 0}, r.normal).x, 20.f);
  EXPECT_EQ(extrapolate(r, {-100, 0, 0}, r.normal).x, 0.f);
  EXPECT_EQ(extrapolate(r, {100, 0, 0}, r.normal).z, 0.f);
  const float t = 0.1f;  // towards +x: z cross n is +y
  EXPECT_NEAR(extrapolate(r, {0, 0, 0}, {std::sin(t), 0, std::cos(t)}).y, 20 + 5 * std::sin(t), 1e-5f);
}

Interpolated brute_force(std::span<const IrradianceRecord> records, float accuracy, const Vec3& p,
                         const Vec3& n) {
  Interpolated sum;
  for (const IrradianceRecord& r : records) {
    const float w = record_weight(record_error(r, p, n), accuracy);
    if (w <= 1e-6f || record_apart(r, p, n)) continue;
    sum.add(r, w, p, n);
  }
  sum.finish();
  return sum;
}

void expect_same_as_brute_force(const RecordTree& tree, float accuracy) {
  int hits = 0;
  std::size_t record = 1000000;  // beyond all of them, at first
  for (std::uint64_t i = 0; i < 3000; ++i) {
    RandomStream random(5, Stage::test, i);
    const Vec3 p = Vec3(random.uniform(), random.uniform(), random.uniform()) * 1.6f - 0.3f;
    const Vec3 n = sample_uniform_sphere(random.uniform2());
    const Interpolated a = tree.interpolate(p, n), b = brute_force(tree.records(), accuracy, p, n);
    EXPECT_NEAR(a.weight, b.weight, 1e-5f);
    EXPECT_NEAR(a.irradiance.x, b.irradiance.x, 1e-3f);
    EXPECT_NEAR(a.stderr_lx.y, b.stderr_lx.y, 1e-3f);
    EXPECT_EQ(tree.covered(p, n), b.weight > 0);
    EXPECT_EQ(tree.covered(p, n, record), b.weight > 0);
    hits += b.weight > 0;
  }
  EXPECT_GT(hits, 300);
}

TEST(RecordTree, FindsWhatBruteForceFinds) {
  Bounds bounds;
  bounds.include(Vec3(0)), bounds.include(Vec3(1));
  const float accuracy = 0.5f;
  RecordTree tree(bounds, static_cast<double>(accuracy));
  for (std::uint64_t i = 0; i < 800; ++i) tree.insert(random_record(i));
  expect_same_as_brute_force(tree, accuracy);
  for (std::size_t i = 0; i < tree.size(); i += 3) tree.shrink(i, tree.records()[i].radius_m * 0.6f);
  expect_same_as_brute_force(tree, accuracy);
}

TEST(RecordTree, WorksWhereBoundsAreEmptyOrMissTheRecords) {
  for (const bool empty : {true, false}) {
    Bounds bounds;
    if (!empty) bounds.include(Vec3(50)), bounds.include(Vec3(51));
    RecordTree tree(bounds, 0.5);
    EXPECT_FALSE(tree.covered(Vec3(0), Vec3(0, 0, 1)));
    EXPECT_EQ(tree.interpolate(Vec3(0), Vec3(0, 0, 1)).weight, 0.f);
    for (std::uint64_t i = 0; i < 200; ++i) tree.insert(random_record(i));
    expect_same_as_brute_force(tree, 0.5f);
  }
}

TEST(RecordTree, RecordIsValidWhereItLies) {
  Bounds bounds;
  bounds.include(Vec3(0)), bounds.include(Vec3(1));
  for (std::uint64_t i = 0; i < 200; ++i) {
    RecordTree tree(bounds, 0.2);
    IrradianceRecord r = random_record(i);
    r.radius_m = std::pow(10.f, -6 + static_cast<float>(i % 9));
    tree.insert(r);
    EXPECT_TRUE(tree.covered(r.position, r.normal));
    EXPECT_EQ(tree.interpolate(r.position, r.normal).irradiance, r.irradiance);
  }
}

Provenance some_provenance() {
  Provenance p;
  p.tool = "test", p.command = "test", p.parameters = Json::Object{}, p.extra = Json::Object{};
  p.key = "0";
  return p;
}

TEST(IrradianceFile, RoundTrip) {
  const std::string path = test::scratch("irradiance") + "/a.irradiance";
  for (const std::size_t n : {0u, 1u, 37u}) {
    IrradianceCache cache;
    for (std::uint64_t i = 0; i < n; ++i) cache.records.push_back(random_record(i));
    if (n > 0) cache.records[0].distance_m = kInfinity;
    cache.accuracy = 0.15, cache.scene_hash = "abc", cache.quantity = Quantity::all;
    write_irradiance(path, cache, some_provenance());
    const Container file = Container::open(path, FileKind::irradiance);
    const IrradianceCache back = read_irradiance(file);
    EXPECT_EQ(back.accuracy, 0.15);
    EXPECT_EQ(back.quantity, Quantity::all);
    EXPECT_EQ(back.scene_hash, "abc");
    ASSERT_EQ(back.records.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      const IrradianceRecord &a = cache.records[i], &b = back.records[i];
      EXPECT_EQ(a.position, b.position);
      EXPECT_EQ(a.normal, b.normal);
      EXPECT_EQ(a.irradiance, b.irradiance);
      EXPECT_EQ(a.stderr_lx, b.stderr_lx);
      EXPECT_EQ(a.distance_m, b.distance_m);
      EXPECT_EQ(a.radius_m, b.radius_m);
      for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(a.rotation_gradient[c], b.rotation_gradient[c]);
        EXPECT_EQ(a.translation_gradient[c], b.translation_gradient[c]);
      }
    }
  }
}

TEST(IrradianceFile, DamagedRowsAreNamed) {
  const std::string path = test::scratch("irradiance-bad") + "/a.irradiance";
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ContainerWriter writer;
  const std::vector<Vec3> v(2, Vec3(0, 0, 1));
  const std::vector<float> radius{1, nan}, gradient(18, 0.f);
  for (const char* name : {"position", "normal", "irradiance", "stderr"}) writer.add_vectors(name, v, "1");
  for (const char* name : {"radius", "distance"}) writer.add<float>(name, radius, {2}, "m");
  for (const char* name : {"rotation_gradient", "translation_gradient"})
    writer.add<float>(name, gradient, {2, 3, 3}, "1");
  Provenance p = some_provenance();
  p.kind = FileKind::irradiance, p.extra["accuracy"] = 0.2, p.extra["quantity"] = "all";
  writer.write(path, p);
  try {
    read_irradiance(Container::open(path));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("row 1 of tensor \"distance\""), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace phos
