// What decides a record's light, against the same in long doubles: weights, extrapolation, gradients, and
// samples of lamps.
#include <gtest/gtest.h>

#include <numbers>

#include "core/random.h"
#include "core/sampling.h"
#include "estimate/hemisphere/hemisphere.h"
#include "estimate/hemisphere/ray_gradients.h"
#include "estimate/shading.h"
#include "estimate/zone/gradients.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/lamp/luminaires.h"
#include "support/rounding.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

Vec3 any_direction(RandomStream& random) { return sample_uniform_sphere(random.uniform2()); }
Vec3 above(const Frame& frame, RandomStream& random) {
  return frame.to_world(sample_cosine_hemisphere(random.uniform2()));
}
float decades(RandomStream& random, float from, float to) {
  return std::pow(10.f, from + (to - from) * random.uniform());
}
long double length(const LVec3& v) { return std::sqrt(glm::dot(v, v)); }

// --- records that are read ---

/// A record, and a point of its zone: as near as 1e-6 of its reach, its normal turned as little.
struct Read {
  IrradianceRecord record;
  Vec3 p, n;
  explicit Read(std::uint64_t i) {
    RandomStream random(5, Stage::test, i);
    const float size = decades(random, -6, 6);
    record.position = size * any_direction(random), record.normal = any_direction(random);
    record.radius_m = size * decades(random, -2, 0);
    const Frame frame = make_frame(record.normal);
    for (int c = 0; c < 3; ++c) {
      record.irradiance[c] = decades(random, -3, 3);
      record.rotation_gradient[c] = record.irradiance[c] * any_direction(random);
      record.translation_gradient[c] = record.irradiance[c] / record.radius_m * any_direction(random);
    }
    p = record.position + 0.2f * record.radius_m * decades(random, -6, 0) * any_direction(random);
    n = glm::normalize(record.normal + 0.2f * decades(random, -6, 0) * frame.x);
  }
};

TEST(Rounding, WeightsOfRecords) {
  constexpr float kAccuracy = 0.4f;
  Rounding weight;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Read r(i);
    const long double apart = length(LVec3(r.p) - LVec3(r.record.position)),
                      turn = length(LVec3(r.n) - LVec3(r.record.normal)),
                      eps = apart / static_cast<long double>(r.record.radius_m) + turn / std::sqrt(2.0L),
                      exact = std::max(0.0L, 1 - eps / static_cast<long double>(kAccuracy));
    const float found = record_weight(record_error(r.record, r.p, r.n), kAccuracy);
    weight.see(static_cast<double>(found), exact, 1);
  }
  weight.expect("the weight of a record, absolute", "distance over the record's reach", 1e-6, 1, 1e-6);
}

TEST(Rounding, ExtrapolatedIrradiance) {
  Rounding light;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Read r(i);
    const Rgb found = extrapolate(r.record, r.p, r.n);
    const LVec3 turn = glm::cross(LVec3(r.record.normal), LVec3(r.n)),
                step = LVec3(r.p) - LVec3(r.record.position);
    for (int c = 0; c < 3; ++c) {
      const auto e = static_cast<long double>(r.record.irradiance[c]);
      const long double exact = std::clamp(e + glm::dot(turn, LVec3(r.record.rotation_gradient[c])) +
                                               glm::dot(step, LVec3(r.record.translation_gradient[c])),
                                           0.0L, 2 * e);
      light.see(static_cast<double>(found[c]), exact, e);
    }
  }
  light.expect("two-gradient extrapolation, relative to the record's light",
               "distance over the record's reach", 1e-6, 1, 1e-6);
}

// --- gradients ---

/// translation_term() in long doubles.
LVec3 translation(const LVec3& w, const LVec3& source, long double nearness, const LVec3& n) {
  const LVec3 term = source / std::max(0.1L, -glm::dot(source, w)) + 4.0L * w;
  return (term - glm::dot(term, n) * n) * nearness;
}

/// Photons of a disc of any size, from surfaces at any distance of it; one in ten comes grazing.
struct Zone {
  Frame frame;
  ZonePhotons photons;
  std::vector<std::uint8_t> used;
  float radius_m;
  explicit Zone(std::uint64_t i) {
    RandomStream random(6, Stage::test, i);
    frame = make_frame(any_direction(random)), radius_m = decades(random, -6, 6);
    for (int k = 0; k < 300; ++k) {
      Vec3 w = sample_cosine_hemisphere(random.uniform2());
      if (k % 10 == 0) w = glm::normalize(Vec3(w.x, w.y, w.z * decades(random, -6, 0)));
      photons.direction.push_back(frame.to_world(w));
      photons.offset_m.push_back(radius_m * sample_disc(random.uniform2()));
      photons.flux_lm.push_back(decades(random, -6, 0) * Rgb(1, random.uniform(), 0.5f));
      photons.inverse_distance.push_back(decades(random, -3, 1) / radius_m);
      const Frame back = make_frame(-photons.direction.back());
      photons.source_normal.push_back(above(back, random));
    }
    used.assign(photons.size(), 1);
  }
};

TEST(Rounding, GradientsFromPhotons) {
  Rounding analytic, positional, curvature;
  for (std::uint64_t i = 0; i < 600; ++i) {
    const Zone z(i);
    const auto r = static_cast<long double>(z.radius_m), area = std::numbers::pi_v<long double> * r * r,
               moment = area * r * r / 4;
    const ComparedGradients found = compare_gradients(z.photons, z.used, static_cast<double>(area), z.frame,
                                                      disc_shape(static_cast<double>(z.radius_m)));
    LVec3 sums[3]{LVec3(0), LVec3(0), LVec3(0)}, places[3]{LVec3(0), LVec3(0), LVec3(0)};
    long double sizes[3]{}, apart[3]{};
    for (std::size_t k = 0; k < z.photons.size(); ++k) {
      const LVec3 n(z.frame.z), w(z.photons.direction[k]), source(z.photons.source_normal[k]);
      const auto nearness = static_cast<long double>(z.photons.inverse_distance[k]);
      const LVec3 term = translation(w, source, nearness, n);
      const LVec2 at = LVec2(z.photons.offset_m[k]) / moment;
      const LVec3 place = at.x * LVec3(z.frame.x) + at.y * LVec3(z.frame.y);
      for (int c = 0; c < 3; ++c) {
        const auto flux = static_cast<long double>(z.photons.flux_lm[k][c]);
        sums[c] += flux * term / area, sizes[c] += flux * length(term) / area;
        places[c] += flux * place, apart[c] += flux * length(place);
      }
      const LVec3 across = w - glm::dot(w, n) * n;
      const long double cosine = -glm::dot(source, w), unit = 40 * nearness * nearness;
      if (cosine > 0.9998L) continue;  // about where a surface is told from none
      const long double exact =
          nearness * nearness *
          (8 * glm::dot(source, across) / std::max(0.1L, cosine) + 24 * glm::dot(across, across) - 8);
      curvature.see(static_cast<double>(curvature_term(z.photons.direction[k], z.photons.source_normal[k],
                                                       z.photons.inverse_distance[k], z.frame.z)),
                    exact, unit);
    }
    for (int c = 0; c < 3; ++c) {
      analytic.see(found.analytic.translation[c], sums[c], sizes[c]);
      positional.see(found.positional.translation[c], places[c], apart[c]);
    }
  }
  analytic.expect("gradients from photons, analytic, relative to their terms",
                  "strongest over faintest photon", 1, 1e6, 1e-5);
  positional.expect("gradients from photons, positional, relative to their terms",
                    "strongest over faintest photon", 1, 1e6, 1e-5);
  curvature.expect("the curvature of a photon's light, relative to its terms", "elevation of the light, rad",
                   1e-6, 1.57, 1e-5);
}

TEST(Rounding, GradientsFromRays) {
  Rounding analytic, differences;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RandomStream random(8, Stage::test, i);
    Hemisphere h;
    h.frame = make_frame(any_direction(random)), h.rings = 8, h.slices = slices_for(8);
    const auto cells = static_cast<std::size_t>(h.rings * h.slices);
    h.resize(cells);
    const float size = decades(random, -6, 6);
    for (std::size_t k = 0; k < cells; ++k) {
      h.direction[k] = above(h.frame, random),
      h.radiance[k] = decades(random, -3, 3) * Rgb(1, 0.5f, random.uniform());
      h.distance_m[k] = size * decades(random, -3, 3),
      h.hit_normal[k] = above(make_frame(-h.direction[k]), random);
      h.projected_sr[k] = kPi / static_cast<float>(cells);
    }
    LVec3 terms[3]{LVec3(0), LVec3(0), LVec3(0)}, walls[3]{LVec3(0), LVec3(0), LVec3(0)};
    long double sizes[3]{}, lengths[3]{};
    const auto nearness = [&](std::size_t k) { return 1 / static_cast<long double>(h.distance_m[k]); };
    for (std::size_t k = 0; k < cells; ++k) {
      const LVec3 term =
          translation(LVec3(h.direction[k]), LVec3(h.hit_normal[k]), nearness(k), LVec3(h.frame.z));
      for (int c = 0; c < 3; ++c) {
        const long double light =
            static_cast<long double>(h.radiance[k][c]) * static_cast<long double>(h.projected_sr[k]);
        terms[c] += light * term, sizes[c] += light * length(term);
      }
    }
    // Ward and Heckbert 1992: walls between neighbours that move with the nearer of them.
    const auto wall = [&](std::size_t before, std::size_t cell, long double moved, long double angle) {
      const LVec3 way = std::cos(angle) * LVec3(h.frame.x) + std::sin(angle) * LVec3(h.frame.y);
      const long double speed = moved * std::max(nearness(before), nearness(cell));
      for (int c = 0; c < 3; ++c) {
        const auto a = static_cast<long double>(h.radiance[before][c]),
                   b = static_cast<long double>(h.radiance[cell][c]);
        walls[c] += speed * (b - a) * way, lengths[c] += speed * (a + b);
      }
    };
    const long double slice = 2 * std::numbers::pi_v<long double> / h.slices;
    for (int k = 0; k < h.slices; ++k)
      for (int j = 0; j < h.rings; ++j) {
        const long double inner = std::sqrt(static_cast<long double>(j) / h.rings),
                          outer = std::sqrt(static_cast<long double>(j + 1) / h.rings);
        if (j > 0) wall(h.at(j - 1, k), h.at(j, k), slice * inner * (1 - inner * inner), (k + 0.5L) * slice);
        wall(h.at(j, k - 1), h.at(j, k), outer - inner, k * slice + std::numbers::pi_v<long double> / 2);
      }
    const Gradients a = ray_gradients(h, GradientMode::analytic, 0),
                    w = ray_gradients(h, GradientMode::ward_heckbert, 0);
    for (int c = 0; c < 3; ++c)
      analytic.see(a.translation[c], terms[c], sizes[c]),
          differences.see(w.translation[c], walls[c], lengths[c]);
  }
  analytic.expect("gradients from rays, analytic, relative to their terms", "farthest over nearest surface",
                  1, 1e6, 1e-5);
  differences.expect("gradients from rays, differences, relative to their terms",
                     "farthest over nearest surface", 1, 1e6, 1e-5);
}

// --- light of lamps ---

/// A lamp of about a square metre at the origin that shines up, over nothing.
Scene lamp(bool square) {
  Scene scene;
  begin_instance(scene, "lamp", add_lambert(scene, "light", 0, 1000));
  if (square)
    add_quad(scene, {-0.5f, 0, -0.5f}, {0, 0, 1}, {1, 0, 0});
  else
    add_triangle(scene, {-0.5f, 0, -0.5f}, {0, 0, 0.7f}, {0.8f, 0, -0.4f});
  finalize(scene);
  return scene;
}

/// Solid angle of a triangle, its corners seen from the place.
long double seen_sr(LVec3 a, LVec3 b, LVec3 c) {
  a = a / length(a), b = b / length(b), c = c / length(c);
  const long double volume = glm::dot(a, glm::cross(b, c));
  return 2 * std::atan2(std::fabs(volume), 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

/// Each sample's share of irradiance, from where the lamp says that it lies: within two radii of the lamp's
/// middle by the solid angle of it.
void direct_light(bool square, const std::string& name) {
  const Scene scene = lamp(square);
  const Luminaires lights(scene);
  ASSERT_EQ(lights.size(), 1u);
  const auto area = static_cast<long double>(scene.light[0].area_m2);
  LVec3 middle(0);
  for (const Vec3& p : scene.position) middle += LVec3(p) / static_cast<long double>(scene.position.size());
  long double radius = 0;
  for (const Vec3& p : scene.position) radius = std::max(radius, length(LVec3(p) - middle));
  Rounding light;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    RandomStream random(9, Stage::test, i);
    const Frame up = make_frame({0, 1, 0});
    const Vec3 from = decades(random, -3, 4) * above(up, random), n = any_direction(random);
    Illumination e;
    if (!lights.illuminate(0, from, random.uniform(), random.uniform2(), e)) continue;
    const LVec3 way = LVec3(e.position) - LVec3(from);
    const long double d = length(way), facing = glm::dot(LVec3(n), way) / d, leaving = -way.y / d;
    if (facing < 0.01L || leaving < 0.01L) continue;  // grazing: what cosines lose is less than they matter
    const long double away = length(LVec3(from) - middle) / (2 * radius);
    if (std::fabs(away - 1) < 1e-5L) continue;
    long double sr = leaving * area / (d * d);
    if (away < 1) {
      sr = 0;
      for (const Triangle& t : scene.triangle)
        sr +=
            seen_sr(LVec3(scene.position[t.v[0]]) - LVec3(from), LVec3(scene.position[t.v[1]]) - LVec3(from),
                    LVec3(scene.position[t.v[2]]) - LVec3(from));
    }
    const long double exact = 1000 * facing * sr;
    light.see(static_cast<double>(e.value.x * (glm::dot(n, e.direction) / e.density)), exact, exact);
  }
  light.expect("direct light of a " + name, "distance over the size of the lamp", 1e-3, 1e4, 1e-4);
}

/// All samples of a far lamp are the same but for rounding: so little is the error that is stated, whether
/// there are few of them or many.
TEST(Rounding, ErrorsOfDirectLight) {
  Scene scene = lamp(true);
  begin_instance(scene, "floor", add_lambert(scene, "grey", 0.5f));
  add_quad(scene, {-10, 3e4f, -10}, {20, 0, 0}, {0, 0, 20});  // faces down
  finalize(scene);
  const RayScene rays(scene);
  const Luminaires lights(scene);
  const RecordTree none(scene.bounds, 0.2);
  const Shading shading(rays, lights, none, {});
  Rounding error;
  for (std::uint64_t i = 0; i < 1200; ++i) {
    RandomStream random(10, Stage::test, i);
    SurfacePoint point;
    const Vec3 under(10 * random.uniform(), 29999, 10 * random.uniform());
    ASSERT_TRUE(trace(rays, {under, {0, 1, 0}}, point));
    const Bsdf bsdf(scene, point);
    const DirectLight light =
        shading.direct(point, bsdf, {0, -1, 0}, SampleRange(static_cast<int>(2 + i % 300)), 0, random);
    ASSERT_GT(light.radiance.x, 0);
    error.see(std::sqrt(light.variance.x), 0, static_cast<long double>(light.radiance.x));
  }
  error.expect("the error of direct light", "samples", 2, 300, 2e-7);
}

TEST(Rounding, DirectLightOfATriangle) { direct_light(false, "triangle"); }
TEST(Rounding, DirectLightOfARectangle) { direct_light(true, "rectangle"); }

}  // namespace
}  // namespace phos::test
