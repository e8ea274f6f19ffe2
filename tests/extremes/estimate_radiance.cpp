// Radiance records where there is nothing to see, too much, or nothing right: a right answer, or a refusal.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <functional>

#include "core/error.h"
#include "core/float_traps.h"
#include "estimate/radiance_gather.h"
#include "radiance/tree.h"
#include "support/gathered.h"
#include "support/radiance_records.h"
#include "support/radiance_scenes.h"
#include "support/run.h"

namespace phos {
namespace {

/// The record at a place of a scene.
struct One {
  explicit One(const Scene& scene, std::int64_t rays = 1024, int order = 6)
      : gathered(scene),
        options(test::gather_options(scene, Quantity::indirect, 1, rays)),
        estimator(gathered.rays, gathered.lights, {}, options, order, RadianceGradient::hybrid, 1),
        worker(estimator.make_worker()) {}
  RadianceRecord at(const Vec3& p, const Vec3& n) {
    const RadianceRecord r = *estimator.make({p, n, 1}, *worker).radiance;
    EXPECT_TRUE(is_finite(r));
    EXPECT_GT(r.radius_m, 0);
    EXPECT_LE(r.radius_m, static_cast<float>(*options.max_radius_m));
    return r;
  }
  test::Gathered gathered;
  RecordOptions options;
  RadianceEstimator estimator;
  std::unique_ptr<Estimator::Worker> worker;
};

/// A room of a millionth and of a million times the size: the same light, slopes by the inverse.
TEST(Radiance, ScenesOfAnySize) {
  const test::AnalyticScene room = test::uniform_box(0.5f);
  const Vec3 p(0.5f, 0, 0.4f), n(0, 1, 0);
  const RadianceRecord expected = One(room.scene).at(p, n);
  for (const float factor : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    const RadianceRecord r = One(test::scaled(room.scene, factor)).at(factor * p, n);
    EXPECT_NEAR(r.radius_m / factor, expected.radius_m, 0.01f * expected.radius_m) << factor;
    EXPECT_NEAR(r.distance_m / factor, expected.distance_m, 0.01f * expected.distance_m) << factor;
    const auto relative = [&](std::vector<float> a, const std::vector<float>& b, float unit) {
      for (float& x : a) x *= unit;
      return test::distance(test::channel(a), test::channel(b)) / test::norm(test::channel(b));
    };
    EXPECT_LT(relative(r.light, expected.light, 1), 1e-2) << factor;
    EXPECT_LT(relative(r.gradient_x, expected.gradient_x, factor), 3e-2) << factor;
    EXPECT_LT(relative(r.gradient_y, expected.gradient_y, factor), 3e-2) << factor;
    EXPECT_LT(relative(r.stderr_light, expected.stderr_light, 1), 3e-2) << factor;
  }
}

/// Lamps of 1e-12 and 1e12 of the power.
TEST(Radiance, LightOfAnyStrength) {
  const test::AnalyticScene room = test::uniform_box(0.5f);
  const Vec3 p(0.5f, 0, 0.4f), n(0, 1, 0);
  const RadianceRecord expected = One(room.scene).at(p, n);
  for (const float factor : {1e-12f, 1e12f}) {
    Scene scene = room.scene;
    for (Light& light : scene.light) light.intensity *= factor;
    finalize(scene);
    const RadianceRecord r = One(scene).at(p, n);
    for (std::size_t i = 0; i < r.light.size(); ++i)
      EXPECT_NEAR(r.light[i] / factor, expected.light[i], 1e-4f * expected.light[0]);
    EXPECT_NEAR(r.radius_m, expected.radius_m, 1e-3f * expected.radius_m);
  }
}

/// Every ray escapes: no light, nothing near, and no noise.
TEST(Radiance, AllRaysEscape) {
  const test::AnalyticScene s = test::point_light_over_plane();
  One one(s.scene);
  const RadianceRecord r = one.at({0, 0, 0}, {0, 1, 0});
  EXPECT_EQ(test::norm(test::channel(r.light)), 0);
  EXPECT_EQ(test::norm(test::channel(r.gradient_x)), 0);
  EXPECT_EQ(test::norm(test::channel(r.stderr_light)), 0);
  EXPECT_TRUE(std::isinf(r.distance_m));
  EXPECT_EQ(r.radius_m, static_cast<float>(*one.options.max_radius_m));
  // Such a record is a record: black, known, and kept by a file.
  RadianceTree tree(s.scene.bounds, 0.2, 6);
  tree.insert(r);
  RadianceTree::Worker worker;
  EXPECT_GT(tree.interpolate({0.1f, 0, 0}, make_frame({0, 1, 0}), 6, worker), 0);
  EXPECT_EQ(test::norm(test::channel(worker.light)), 0);
  RadianceCache cache;
  cache.records.push_back(r);
  const std::string path = test::scratch("radiance") + "/black.radiance";
  write_radiance(path, cache, test::radiance_provenance());
  EXPECT_TRUE(std::isinf(read_radiance(Container::open(path)).records[0].distance_m));
}

/// Half of the hemisphere lies within a wall, or in the very edge of two: hits at no distance. There is light
/// as far as irradiance records find some, too.
TEST(Radiance, HalfInsideAWall) {
  const test::AnalyticScene room = test::uniform_box(0.5f);
  const Vec3 up(0, 1, 0);
  for (const Vec3& p : {Vec3(0, 0, 0.7f), Vec3(0, 0, 0), Vec3(2, 0, 1.5f), Vec3(1e-7f, 0, 0.7f)}) {
    One one(room.scene);
    const RadianceRecord r = one.at(p, up);
    const IrradianceRecord here = irradiance_of(r),
                           other = one.gathered.records(p, up, one.options, {}, 1)[0];
    EXPECT_NEAR(here.irradiance.y, other.irradiance.y, 3 * (here.stderr_lx.y + other.stderr_lx.y))
        << p.x << " " << p.z;
    EXPECT_LT(r.distance_m, 1e-5f) << "rays start on what they hit";
    EXPECT_LT(other.distance_m, 1e-5f) << "rays start on what they hit";
    EXPECT_LE(test::norm(test::channel(r.light)), 4 * static_cast<double>(r.light[1])) << p.x << " " << p.z;
  }
  // A normal that looks along the wall and into it.
  One one(room.scene);
  one.at({0, 0.5f, 0.7f}, {0, 1, 0});
  one.at({0, 0.5f, 0.7f}, {-1, 0, 0});
  one.at({0, 0.5f, 0.7f}, glm::normalize(Vec3(-1, 0.1f, 0)));
}

/// Few rays and many bands: the noise is as large as the light, and stated.
TEST(Radiance, ThirtyBandsFromSixteenRays) {
  const test::AnalyticScene room = test::uniform_box(0.5f);
  One one(room.scene, 16, 30);
  const RadianceRecord r = one.at({0.5f, 0, 0.4f}, {0, 1, 0});
  EXPECT_EQ(r.light.size(), 2700u);
  EXPECT_GT(r.stderr_light[3 * 29 + 1], 0.05f * r.light[1]);
}

/// Light beyond the range of numbers is an error that says where, never an infinite record.
TEST(Radiance, BeyondTheRangeOfNumbers) {
  const NoFloatTraps traps;  // differences of infinite light are none
  test::AnalyticScene room = test::scaled(test::uniform_box(0.5f), 1e-3f);
  for (Light& light : room.scene.light) light.intensity *= 1e37f;
  finalize(room.scene);
  One one(room.scene);
  try {
    one.estimator.make({{0.0005f, 0, 0.0004f}, {0, 1, 0}, 1}, *one.worker);
    FAIL() << "taken";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
    EXPECT_NE(std::string(e.what()).find("(5e-04, 0, 4e-04) m"), std::string::npos) << e.what();
  }
}

class DamagedRadiance : public ::testing::Test {
 protected:
  using Columns = std::map<std::string, std::pair<Shape, std::vector<float>>>;

  DamagedRadiance() {
    std::filesystem::create_directories(folder_);
    write_radiance(folder_ + "/good.radiance", test::random_radiance(5, 3), test::radiance_provenance());
    const Container file = Container::open(folder_ + "/good.radiance");
    provenance_ = file.provenance();
    for (const auto& [name, tensor] : file.tensors()) {
      const auto v = file.values<float>(name, tensor.shape);
      columns_[name] = {tensor.shape, {v.begin(), v.end()}};
    }
  }

  /// Written with proper checksums after `damage`; the complaint of the reader, "" if it took the file.
  std::string complaint(const std::function<void(Columns&, Provenance&)>& damage) {
    Columns columns = columns_;
    Provenance provenance = provenance_;
    damage(columns, provenance);
    ContainerWriter writer;
    for (const auto& [name, column] : columns) writer.add<float>(name, column.second, column.first, "1");
    if (!orders_.empty()) writer.add<std::uint8_t>("order", orders_, {orders_.size()}, "1");
    const std::string path = folder_ + "/bad.radiance";
    writer.write(path, provenance);
    try {
      read_radiance(Container::open(path));
      return "";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_EQ(e.where(), path);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
      return e.what();
    }
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  // In memory where that can be: each of the many files is flushed to the disk otherwise.
  std::string folder_ = std::filesystem::exists("/dev/shm") ? text("/dev/shm/phos-radiance-", getpid())
                                                            : test::scratch("damaged-radiance");
  Provenance provenance_;
  Columns columns_;
  std::vector<std::uint8_t> orders_;  // of a file where they differ
};

TEST_F(DamagedRadiance, TheGoodOneIsTaken) {
  EXPECT_EQ(complaint([](Columns&, Provenance&) {}), "");
}

TEST_F(DamagedRadiance, ColumnsThatLackOrDifferInOrder) {
  for (const auto& [name, column] : columns_) {
    EXPECT_NE(complaint([&, &n = name](Columns& c, Provenance&) { c.erase(n); }), "") << name;
    EXPECT_NE(complaint([&, &n = name](Columns& c, Provenance&) {
                // One row less.
                auto& [shape, values] = c[n];
                values.resize(values.size() / shape[0] * (shape[0] - 1));
                --shape[0];
              }),
              "")
        << name;
  }
  for (const char* name : {"coefficients", "gradient_x", "gradient_y", "stderr"})
    EXPECT_NE(complaint([&](Columns& c, Provenance&) {
                auto& [shape, values] = c[name];
                shape[2] += 1;
                values.resize(shape[0] * shape[1] * shape[2]);
              }),
              "")
        << name;
  for (const int order : {-1, 0, 2, 4, 31, 1 << 30})
    EXPECT_NE(complaint([&](Columns&, Provenance& p) { p.extra["order"] = order; }), "") << order;
  for (const double accuracy : {0., -1.})
    EXPECT_NE(complaint([&](Columns&, Provenance& p) { p.extra["accuracy"] = accuracy; }), "");
  EXPECT_NE(complaint([&](Columns&, Provenance& p) { p.extra["order"] = "three"; }), "");
  EXPECT_NE(complaint([&](Columns&, Provenance& p) { p.kind = FileKind::irradiance; }).find("irradiance"),
            std::string::npos);
}

TEST_F(DamagedRadiance, OrdersOfTheirOwn) {
  const auto with = [&](std::vector<std::uint8_t> orders, const std::string& damage = "") {
    orders_ = std::move(orders);
    return complaint([&](Columns& c, Provenance&) {
      for (const char* name : {"coefficients", "gradient_x", "gradient_y", "stderr"}) {
        // Record 2 is of order 2: of each colour, numbers of the last band are none.
        auto& [shape, values] = c[name];
        const std::size_t numbers = shape[2], used = numbers == 9 ? 4 : 2;
        for (std::size_t colour = 0; colour < 3; ++colour)
          for (std::size_t k = used; k < numbers; ++k)
            values[(2 * 3 + colour) * numbers + k] = damage == name && colour == 2 ? 1.f : 0.f;
      }
    });
  };
  EXPECT_EQ(with({3, 3, 2, 3, 3}), "");
  EXPECT_NE(with({3, 3, 2, 0, 3}).find("record 3"), std::string::npos);
  EXPECT_NE(with({3, 4, 2, 3, 3}).find("record 1"), std::string::npos);
  EXPECT_NE(with({3, 3, 2, 3}), "");
  EXPECT_NE(with({2, 3, 2, 3, 3}).find("record 0"), std::string::npos) << "its third band is not 0";
  for (const char* name : {"coefficients", "gradient_x", "gradient_y", "stderr"}) {
    const std::string said = with({3, 3, 2, 3, 3}, name);
    EXPECT_NE(said.find("record 2 has numbers beyond its own order"), std::string::npos) << name << said;
  }
}

TEST_F(DamagedRadiance, NumbersThatAreNone) {
  for (const auto& [name, column] : columns_) {
    for (std::size_t i = 0; i < column.second.size(); i += 1 + column.second.size() / 40) {
      const std::string said =
          complaint([&, &n = name](Columns& c, Provenance&) { c[n].second[i] = std::nanf(""); });
      const std::size_t row = i / (column.second.size() / 5);
      EXPECT_NE(said.find(text("row ", row, " of tensor \"", name, "\" is not")), std::string::npos) << said;
    }
  }
  const auto with = [&](const char* name, std::size_t i, float value) {
    return complaint([&](Columns& c, Provenance&) { c[name].second[i] = value; });
  };
  EXPECT_NE(with("radius", 1, 0), "");
  EXPECT_NE(with("radius", 1, -1), "");
  EXPECT_NE(with("radius", 1, kInfinity), "");
  EXPECT_NE(with("distance", 1, -1), "");
  EXPECT_EQ(with("distance", 1, kInfinity), "");
  EXPECT_NE(with("stderr", 4, -1e-3f), "");
  EXPECT_NE(with("frame", 3, 1.5f), "");
  EXPECT_NE(complaint([](Columns& c, Provenance&) {  // x along the normal
              auto& f = c["frame"].second;
              std::copy(f.begin() + 3, f.begin() + 6, f.begin());
            }),
            "");
}

}  // namespace
}  // namespace phos
