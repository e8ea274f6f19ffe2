// Tables of glossy reflection at the extremes: lobes of all widths, bad options, bad directions, bad files.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/sampling.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/lobe_projection.h"
#include "radiance/brdf/projection.h"
#include "radiance/brdf/table.h"
#include "radiance/events.h"
#include "scene/material/bsdf.h"
#include "support/one_material.h"
#include "support/reflections.h"
#include "support/run.h"

namespace phos {
namespace {

using test::make_material;
using test::view;

Material phong(float exponent, const Rgb& ks = Rgb(1)) {
  Material m = make_material(Model::phong, Rgb(0), ks);
  m.exponent = exponent;
  return m;
}

BrdfTable table_of(const Material& material, const BrdfTableOptions& options, Counters& counters) {
  return project_brdf(test::scene_of(material), 0, options, counters);
}

void expect_sound(const BrdfTable& table) {
  for (const float v : table.coefficients) ASSERT_TRUE(std::isfinite(v));
  for (const float v : table.error) ASSERT_TRUE(v >= 0 && v <= 1) << v;
  for (const std::uint8_t n : table.orders) ASSERT_LE(n, table.order);
  ASSERT_TRUE(std::isfinite(table.albedo));
}

// However narrow, a lobe is found: its albedo at the normal is that of the model, and it is marked to be
// traced rather than taken for nothing. (The rounding of unit vectors costs cos^1e6 a fifth of its albedo.)
TEST(BrdfExtremes, LobesOfAllWidths) {
  BrdfTableOptions options;
  options.resolution = 4;
  for (const float exponent : {0.f, 1.f, 1e2f, 1e3f, 1e4f, 1e5f, 1e6f}) {
    Counters counters;
    const BrdfTable table = table_of(phong(exponent), options, counters);
    expect_sound(table);
    EXPECT_NEAR(table.albedo, 1, exponent > 1e4f ? 0.25 : 2e-3) << exponent;
    EXPECT_EQ(table.order == 0, exponent >= 1e2f) << exponent;
    EXPECT_EQ(counters[kIntricateLobeEvent], 0u) << exponent;
  }
  for (const float alpha : {1e-3f, 1e-2f, 0.1f, 1.f}) {
    for (const float across : {1e-3f, 1.f}) {
      for (const Model model : {Model::ward, Model::conductor}) {
        Counters counters;
        const BrdfTable table =
            table_of(make_material(model, Rgb(0), Rgb(1), alpha, across), options, counters);
        expect_sound(table);
        EXPECT_GT(table.albedo, 0.6f) << alpha << ' ' << across;
        EXPECT_LT(table.albedo, 1.05f) << alpha << ' ' << across;
      }
    }
  }
}

// Streaks, a hundred times longer than wide, are found all along.
TEST(BrdfExtremes, Streaks) {
  BrdfTableOptions options;
  options.resolution = 3;
  for (const Model model : {Model::ward, Model::conductor}) {
    for (const auto& [ax, ay] : {std::pair{0.01f, 1.f}, std::pair{1.f, 0.01f}}) {
      const Material material = make_material(model, Rgb(0), Rgb(1), ax, ay);
      Counters counters;
      const BrdfTable table = table_of(material, options, counters);
      expect_sound(table);
      EXPECT_EQ(counters[kIntricateLobeEvent], 0u);
      EXPECT_EQ(table.order, 0);
      const Scene scene = test::scene_of(material);
      const Bsdf bsdf(scene, std::uint32_t{0});
      float greatest = 0;
      for (std::size_t e = 0; e < table.entries(); ++e) {
        constexpr int kSamples = 4096;
        BsdfSample sample;
        float sum = 0;
        for (int i = 0; i < kSamples; ++i)
          if (bsdf.sample_gloss(table.direction(e), r2_point(i, {0.5f, 0.5f}), sample))
            sum += sample.weight.x;
        greatest = std::max(greatest, sum / kSamples);
      }
      EXPECT_NEAR(table.albedo, greatest, 0.03f) << ax << ' ' << ay;
    }
  }
}

TEST(BrdfExtremes, PeaksAnywhereAreFound) {
  for (const float exponent : {1e2f, 1e4f}) {
    for (const Vec3& peak : {view(0), view(1e-4f), view(0.01f, 130), view(7, 45), view(45, 22.5f),
                             view(60, -90), view(70, 180)}) {
      const LobePoints p = lobe_points(
          [&](const Vec3& wi) {
            return Rgb((exponent + 1) / (2 * kPi) * std::pow(std::max(glm::dot(peak, wi), 0.f), exponent) /
                       wi.z);
          },
          std::array{peak}, 10);
      EXPECT_TRUE(p.resolved);
      EXPECT_NEAR(p.albedo.x, 1, 5e-3) << exponent << " at " << peak.x << ' ' << peak.y << ' ' << peak.z;
    }
  }
}

TEST(BrdfExtremes, BrightAndDark) {
  BrdfTableOptions options;
  options.resolution = 3;
  Counters counters;
  const BrdfTable reference = table_of(phong(10), options, counters);
  EXPECT_EQ(counters[kGainsEnergyEvent], 0u);
  for (const float ks : {1e-12f, 1e-6f, 1e6f, 1e12f}) {
    Counters own;
    const BrdfTable table = table_of(phong(10, Rgb(ks)), options, own);
    expect_sound(table);
    EXPECT_EQ(table.orders, reference.orders) << ks;
    EXPECT_NEAR(table.coefficients[0] / ks, reference.coefficients[0], 1e-5) << ks;
    EXPECT_EQ(own[kGainsEnergyEvent], ks > 1 ? 3u : 0u);
  }
  // No lobe at all, and one in red alone.
  const BrdfTable black = table_of(phong(10, Rgb(0)), options, counters);
  expect_sound(black);
  EXPECT_EQ(black.order, 1);
  for (const float v : black.coefficients) EXPECT_EQ(v, 0.f);
  const BrdfTable red = table_of(phong(10, Rgb(1, 0, 0)), options, counters);
  EXPECT_EQ(red.orders, reference.orders);
  EXPECT_EQ(red.coefficients[1], 0.f);
}

TEST(BrdfExtremes, NotANumberIsCountedAndLeftOut) {
  const HarmonicBasis<float> basis(3);
  const LobeProjection p = project_lobe([](const Vec3& wi) { return wi.x > 0.9f ? Rgb(NAN) : Rgb(1 / kPi); },
                                        test::mirror_of(view(0)), basis);
  EXPECT_GT(p.rejected, 0u);
  for (const float c : p.coefficients) EXPECT_TRUE(std::isfinite(c));
  EXPECT_NEAR(p.albedo.x, 1, 0.05);
}

// A function that no number of points resolves ends, and says so.
TEST(BrdfExtremes, IntricateLobes) {
  const LobePoints p = lobe_points([](const Vec3& wi) { return Rgb(std::sin(1e5f * wi.x) > 0 ? 1.f : 0.f); },
                                   test::mirror_of(view(0)), 10);
  EXPECT_FALSE(p.resolved);
  EXPECT_TRUE(std::isfinite(p.energy));
}

TEST(BrdfExtremes, OptionsOutOfRange) {
  const NoFloatTraps traps;  // one is not a number
  const auto refused = [](const BrdfTableOptions& options) {
    Counters counters;
    try {
      table_of(phong(10), options, counters);
    } catch (const Error& e) {
      return e.code() == ExitCode::usage;
    }
    return false;
  };
  for (const std::int64_t order : {std::int64_t{-1}, std::int64_t{0}, std::int64_t{31}, std::int64_t{200}})
    EXPECT_TRUE(refused({.max_order = order})) << order;
  for (const std::int64_t resolution : {std::int64_t{0}, std::int64_t{1}, std::int64_t{1} << 40})
    EXPECT_TRUE(refused({.resolution = resolution})) << resolution;
  for (const double error : {-0.1, 1.1, static_cast<double>(NAN)})
    EXPECT_TRUE(refused({.error = error})) << error;
  EXPECT_FALSE(refused({.error = 1, .max_order = 1, .resolution = 2}));
  EXPECT_FALSE(refused({.error = 0, .max_order = 30, .resolution = 2}));
}

// Below the horizon, not unit, not a number: a finite answer that reads nothing out of bounds.
TEST(BrdfExtremes, DirectionsOfTheLookup) {
  const NoFloatTraps traps;  // some are not numbers
  BrdfTableOptions options;
  options.resolution = 4, options.error = 0.9;
  Counters counters;
  const std::vector<float> light(3 * 100, 1.f);
  for (const Material& m : {phong(5), make_material(Model::ward, Rgb(0), Rgb(1), 0.6f, 0.3f)}) {
    const BrdfTable table = table_of(m, options, counters);
    const BrdfLookup lookup(table);
    for (const Vec3& wo : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1), Vec3(0.6f, 0, -0.8f),
                           Vec3(1e-30f, 0, 1), Vec3(0), Vec3(3, 4, 5), Vec3(-1e6f, 1e6f, 0)}) {
      EXPECT_GT(lookup.order(wo), 0) << wo.x << ' ' << wo.y << ' ' << wo.z;
      EXPECT_TRUE(is_finite(lookup.outgoing(wo, light))) << wo.x << ' ' << wo.y << ' ' << wo.z;
    }
    for (const float bad : {NAN, INFINITY}) {
      EXPECT_GE(lookup.order(Vec3(bad, 0, 1)), 0);
      lookup.outgoing(Vec3(0, bad, bad), light);
    }
  }
}

/// A file of one table, changed by `harm` before it is written.
std::string file_with(const std::string& name, const std::function<void(BrdfTable&)>& harm) {
  Counters counters;
  BrdfTableOptions options;
  options.resolution = 4;
  BrdfTable table = table_of(phong(10), options, counters);
  harm(table);
  const std::string path = test::scratch("brdf_damage") + "/" + name;
  write_brdf(path, std::vector{table}, Provenance{});
  return path;
}

void expect_refused(const std::string& path, const std::string& says) {
  try {
    read_brdf(Container::open(path, FileKind::brdf));
    ADD_FAILURE() << "accepted: " << says;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
  }
}

TEST(BrdfExtremes, DamagedFiles) {
  EXPECT_NO_THROW(read_brdf(Container::open(file_with("sound", [](BrdfTable&) {}), FileKind::brdf)));
  expect_refused(file_with("order", [](BrdfTable& t) { t.orders[2] = 200; }), "order 200");
  expect_refused(file_with("error", [](BrdfTable& t) { t.error[1] = NAN; }), "error");
  expect_refused(file_with("nan", [](BrdfTable& t) { t.coefficients[0] = NAN; }), "not finite");
  expect_refused(file_with("infinite", [](BrdfTable& t) { t.coefficients[0] = INFINITY; }), "not finite");

  const std::string path = file_with("bytes", [](BrdfTable&) {}), bytes = test::slurp(path);
  test::spill(path, bytes.substr(0, bytes.size() - 8));
  expect_refused(path, "");
  std::string flipped = bytes;
  flipped[flipped.size() - 5] = static_cast<char>(flipped[flipped.size() - 5] ^ 1);
  test::spill(path, flipped);
  expect_refused(path, "");
}

/// A file whose header says what it likes; its tensors are those of order 2 at 2 angles.
std::string file_saying(const std::string& name, const Json& extra, FileKind kind = FileKind::brdf) {
  const std::vector<std::uint8_t> orders(2, 2);
  const std::vector<float> error(2, 0.f), coefficients(2 * 3 * 3, 1.f);
  ContainerWriter file;
  file.add<std::uint8_t>("0.orders", orders, {2}, "1");
  file.add<float>("0.error", error, {2}, "1");
  file.add<float>("0.coefficients", coefficients, {2, 3, 3}, "1/sqrt(sr)");
  Provenance provenance;
  provenance.kind = kind, provenance.extra = extra;
  const std::string path = test::scratch("brdf_header") + "/" + name;
  file.write(path, provenance);
  return path;
}

TEST(BrdfExtremes, HeadersThatLie) {
  const Json sound = Json::Object{{"material", "floor"}, {"index", 0}, {"isotropic", true},
                                  {"resolution", 2},     {"order", 2}, {"albedo", 0.5}};
  const auto extra = [](const Json& table) { return Json(Json::Object{{"materials", Json::Array{table}}}); };
  EXPECT_EQ(read_brdf(Container::open(file_saying("sound", extra(sound)))).at(0).material, "floor");
  for (const auto& [name, value] : sound.as_object()) {
    Json other = sound;
    Json::Object members = sound.as_object();
    members.erase(name);
    expect_refused(file_saying("absent", extra(members)), name);
    other[name] = Json::Array{};
    expect_refused(file_saying("other", extra(other)), name);
  }
  const auto with = [&](const char* name, const Json& value) {
    Json changed = sound;
    changed[name] = value;
    return file_saying("changed", extra(changed));
  };
  expect_refused(with("resolution", 3), "0.");
  expect_refused(with("resolution", 0), "resolution");
  expect_refused(with("resolution", 1000000), "resolution");
  expect_refused(with("isotropic", false), "0.");
  expect_refused(with("order", 3), "0.coefficients");
  expect_refused(with("order", 1), "order");
  expect_refused(with("order", -1), "order");
  expect_refused(with("order", 31), "order");
  expect_refused(with("index", -1), "index");
  expect_refused(file_saying("none", Json(Json::Object{})), "list of materials");
  expect_refused(file_saying("two", Json(Json::Object{{"materials", Json::Array{sound, sound}}})), "1.");
  try {
    read_brdf(Container::open(file_saying("kind", extra(sound), FileKind::irradiance)));
    ADD_FAILURE() << "another kind was accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
  }
}

}  // namespace
}  // namespace phos
