// Films whose irradiance has a closed form at every frame, by each way of estimating it: a floor beside a
// wall that a directional lamp lights evenly (docs/methods.md#f).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "splat/raster/hemisphere_raster.h"
#include "support/animated.h"
#include "support/scenes.h"
#include "temporal/make_film.h"

namespace phos::test {
namespace {

constexpr double kHalfWidth = 3, kHeight = 4, kAlbedo = 0.8, kLux = 1000;
constexpr int kLast = 16;
constexpr Estimate kEstimates[] = {Estimate::gather, Estimate::hull, Estimate::raster};

Json lambert(const char* name, double albedo) {
  Json m;
  m["name"] = name, m["extras"]["phos"]["brdf"] = "lambert";
  m["extras"]["phos"]["kd"] = Json::Array{albedo, albedo, albedo};
  return m;
}

/// The wall's heading: askew to the axes of the floor, and of the pixels over it.
constexpr double kHeading = 0.4;
const DVec3 kAlong(std::cos(kHeading), 0, -std::sin(kHeading)),
    kOut(std::sin(kHeading), 0, std::cos(kHeading));

/// About the vertical.
Json::Array turned_by(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }

/// A nearly black floor about (0, 0, 1.6), the wall, which stands on its plane about the origin and faces
/// kOut, the lamp, which shines straight on it, and a camera that sees the floor alone. The floor sends the
/// wall 0.3 % of its light.
struct WallOnTheFloor : Animated {
  WallOnTheFloor() {
    slab("floor", 2, 0, 0, 1.6f, lambert("black", 0.01));
    constexpr auto kSide = static_cast<float>(kHalfWidth), kTop = static_cast<float>(kHeight);
    Json p, wall_node;
    p["attributes"]["POSITION"] = vec3({-kSide, 0, 0, kSide, 0, 0, kSide, kTop, 0, -kSide, kTop, 0});
    p["attributes"]["NORMAL"] = vec3({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    p["indices"] = indices({0, 1, 2, 0, 2, 3});
    p["material"] = material(lambert("bright", kAlbedo));
    wall_node["mesh"] = mesh(p), wall_node["name"] = "wall";
    wall_node["rotation"] = turned_by(kHeading);
    wall = node(wall_node);
    sun = lamp("sun", "directional", static_cast<float>(kLux), 0, 1, 2);
    const int eye = camera("eye");
    Json::Array nodes = json.find("nodes")->as_array();
    nodes[static_cast<std::size_t>(sun)]["rotation"] = turned_by(kHeading);
    Json& looks_down = nodes[static_cast<std::size_t>(eye)];
    looks_down["translation"] = Json::Array{0, 1.5, 1.6};
    looks_down["rotation"] = Json::Array{-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    json["nodes"] = nodes;
  }
  int wall = 0, sun = 0;
};

/// Light of the wall on the floor, lx, where the wall has gone `back_m` and its light is `lux`.
double truth_lx(const Vec3& p, double back_m, double lux) {
  const double x = glm::dot(DVec3(p), kAlong), c = glm::dot(DVec3(p), kOut) + back_m;
  return kAlbedo * lux *
         (corner_form_factor_perpendicular(kHalfWidth - x, kHeight, c) +
          corner_form_factor_perpendicular(kHalfWidth + x, kHeight, c));
}

Film film_of_floor(const std::string& scene, Estimate estimate, const FilmOptions& options,
                   const std::function<void(RecordOptions&)>& more = {}) {
  register_raster_estimator();
  FilmJob job;
  job.survey = survey(scene, {}, {0, kLast});
  job.options = options;
  FrameScenes scenes(scene, {}, "");
  const auto first = scenes.at(0);
  RecordOptions& records = job.light.records;
  records.estimate = estimate;
  records.accuracy = 0.3, records.rays = 1024, records.raster_side = 128, records.gather_bounces = 1;
  records.min_photons = 200, records.max_photons = 400;
  if (more) more(records);
  job.light.photons.paths = 200'000, job.light.seed = 1;
  job.placement.width = 24;
  resolve_film_places(job.placement, first->scene, records.accuracy);
  records.resolve(1.f);
  Counters counters;
  const FilmChains made = make_chains(job, scenes, nullptr, counters);
  return film_of(made.chains, info_of(job), records.paths);
}

/// Mean, over the records of a frame, of what they hold over what is true.
double mean_ratio(const Film& film, const std::string& scene, int frame, double back_m, double lux) {
  double sum = 0;
  const IrradianceCache cache = cache_at(film, frame, load_frame(scene, {}, frame));
  EXPECT_GT(cache.records.size(), 3u) << frame;
  for (const IrradianceRecord& r : cache.records)
    sum += static_cast<double>(r.irradiance.y) / truth_lx(r.position, back_m, lux);
  return sum / static_cast<double>(cache.records.size());
}

/// What is allowed of that mean. Rays: twice their noise. Photons: their noise and the borders of the floor.
/// A raster of 128 pixels a side: a part of one row of them where the wall ends.
double allowed(Estimate estimate) {
  return estimate == Estimate::gather ? 0.02 : estimate == Estimate::hull ? 0.06 : 0.025;
}

double angle_at(double frame) { return frame / kLast * std::numbers::pi / 3; }

/// By 60 degrees, about the vertical.
std::string with_turning_sun(const std::string& name) {
  WallOnTheFloor scene;
  std::vector<float> frames, turns;
  for (int f = 0; f <= kLast; f += 4) {
    const double half = (kHeading + angle_at(f)) / 2;
    frames.push_back(static_cast<float>(f));
    for (const double q : {0.0, std::sin(half), 0.0, std::cos(half)}) turns.push_back(static_cast<float>(q));
  }
  scene.animate(scene.sun, "rotation", frames, turns);
  return scene.write(name, kLast + 1);
}

constexpr double kWallStep_m = 0.05;  // a frame, away from the floor
std::string with_moving_wall(const std::string& name) {
  WallOnTheFloor scene;
  const DVec3 end = -kLast * kWallStep_m * kOut;
  scene.animate(scene.wall, "translation", {0, kLast},
                {0, 0, 0, static_cast<float>(end.x), 0, static_cast<float>(end.z)});
  return scene.write(name, kLast + 1);
}

// E(t) = rho E0 F cos(angle): interpolated from few frames.
TEST(Film, LightOfATurningLamp) {
  const std::string scene = with_turning_sun("film-sun");
  for (const Estimate estimate : kEstimates) {
    const Film film = film_of_floor(scene, estimate, {.temporal_accuracy = 0.02});
    for (int frame = 0; frame <= kLast; frame += 3)
      EXPECT_NEAR(mean_ratio(film, scene, frame, 0, kLux * std::cos(angle_at(frame))), 1,
                  allowed(estimate) + 0.01)
          << static_cast<int>(estimate) << " at " << frame;
  }
}

// E(t) = rho E0 F(c + v t): what is seen moves.
TEST(Film, LightOfAMovingWall) {
  const std::string scene = with_moving_wall("film-wall");
  for (const Estimate estimate : kEstimates) {
    const Film film = film_of_floor(scene, estimate, {.temporal_accuracy = 0.02});
    for (int frame = 0; frame <= kLast; frame += 3)
      EXPECT_NEAR(mean_ratio(film, scene, frame, kWallStep_m * frame, kLux), 1, allowed(estimate) + 0.01)
          << static_cast<int>(estimate) << " at " << frame;
  }
}

/// The change per frame that records were born with, over the true one, on the mean.
template <class Truth>
double mean_change(const Film& film, const Truth& truth) {
  double found = 0, due = 0;
  for (const FilmRecord& r : film.records) {
    if (r.life.birth >= kLast) continue;  // nothing follows
    found += static_cast<double>(r.change.irradiance.y);
    due += truth(r.record.position, r.life.birth + 1) - truth(r.record.position, r.life.birth);
  }
  EXPECT_LT(due, 0);
  return found / due;
}

constexpr FilmOptions extrapolated(LookAhead look) {
  FilmOptions options;
  options.lives = Lives::rate, options.gradients = TemporalGradients::extrapolated, options.look_ahead = look;
  return options;
}

// dE/dt of a lamp that turns: the same rays, or pixels, at both times, so that nothing is left but the form
// factor's own error.
TEST(Film, ChangeByATurningLamp) {
  const std::string scene = with_turning_sun("film-sun-change");
  const auto truth = [](const Vec3& p, int frame) {
    return truth_lx(p, 0, kLux * std::cos(angle_at(frame)));
  };
  for (const Estimate estimate : {Estimate::gather, Estimate::raster}) {
    const Film film = film_of_floor(scene, estimate, extrapolated(LookAhead::trace));
    EXPECT_NEAR(mean_change(film, truth), 1, 0.03) << static_cast<int>(estimate);
    for (const FilmRecord& r : film.records) {
      if (r.life.birth >= kLast) continue;
      const double is = static_cast<double>(r.record.irradiance.y),
                   becomes = is + static_cast<double>(r.change.irradiance.y);
      EXPECT_NEAR(becomes / is, std::cos(angle_at(r.life.birth + 1)) / std::cos(angle_at(r.life.birth)), 1e-3)
          << static_cast<int>(estimate);
    }
  }
}

// dE/dt of a wall that moves. Its edges are seen by whole rays or pixels: right on the mean of many records.
TEST(Film, ChangeByAMovingWall) {
  const std::string scene = with_moving_wall("film-wall-change");
  const auto truth = [](const Vec3& p, int frame) { return truth_lx(p, kWallStep_m * frame, kLux); };
  EXPECT_NEAR(mean_change(film_of_floor(scene, Estimate::gather, extrapolated(LookAhead::trace)), truth), 1,
              0.15);
  EXPECT_NEAR(mean_change(film_of_floor(scene, Estimate::raster, extrapolated(LookAhead::trace)), truth), 1,
              0.15);
}

// dE/dx of raster records, at every frame of a film: F's own derivative by the distance of the wall.
TEST(Film, RasterRecordsKeepTheirGradients) {
  const std::string scene = with_moving_wall("film-wall-slope");
  const Film film = film_of_floor(scene, Estimate::raster, {.temporal_accuracy = 0.02});
  for (const int frame : {0, 7, kLast}) {
    double found = 0, due = 0;
    for (const IrradianceRecord& r : cache_at(film, frame, load_frame(scene, {}, frame)).records) {
      const double back_m = kWallStep_m * frame;
      const Vec3 step(0.01 * kOut);
      found += glm::dot(DVec3(r.translation_gradient[1]), kOut);
      due += (truth_lx(r.position + step, back_m, kLux) - truth_lx(r.position - step, back_m, kLux)) / 0.02;
      EXPECT_GT(glm::length(r.rotation_gradient[1]), 0.1f * r.irradiance.y) << frame;
    }
    EXPECT_LT(due, 0);
    EXPECT_NEAR(found / due, 1, 0.3) << frame;
  }
}

/// Relative errors of the light that the records of a film tell of at places of their zones, in eight
/// directions, at frames from first to last; the records alive, on the mean.
struct ToldLight {
  double rms = 0, records = 0;
};
ToldLight told_light(const Film& film, const std::string& scene) {
  ToldLight told;
  double places = 0, frames = 0;
  for (int frame = 0; frame <= kLast; frame += 3) {
    const IrradianceCache cache = cache_at(film, frame, load_frame(scene, {}, frame));
    told.records += static_cast<double>(cache.records.size()), ++frames;
    for (const IrradianceRecord& r : cache.records) {
      const Frame plane = make_frame(r.normal);
      const Vec3 x = r.footprint ? r.footprint->x() : plane.x, y = glm::cross(r.normal, x);
      for (int k = 0; k < AdaptiveFootprint::kAxes; ++k) {
        const Vec2 u = AdaptiveFootprint::direction(k);
        const Vec3 towards = u.x * x + u.y * y;
        // At three quarters of the zone.
        const float one_metre = record_error(r, r.position + towards, r.normal);
        const Vec3 p = r.position + 0.75f * static_cast<float>(film.info.accuracy) / one_metre * towards;
        const double due = truth_lx(p, kWallStep_m * frame, kLux);
        if (glm::dot(DVec3(p), kOut) + kWallStep_m * frame < 0.05)
          continue;  // behind the wall, or at its foot
        const double off = static_cast<double>(extrapolate(r, p, r.normal).y) / due - 1;
        told.rms += off * off, ++places;
      }
    }
  }
  told.rms = std::sqrt(told.rms / places), told.records /= frames;
  return told;
}

// Zones of eight axes follow a wall that moves: as many records as of discs tell of light twice as right
// (docs/methods.md#f8).
TEST(Film, AdaptiveZonesTellMoreThanDiscs) {
  const std::string scene = with_moving_wall("film-wall-zones");
  const auto told_by = [&](Footprint footprint, double accuracy) {
    const Film film =
        film_of_floor(scene, Estimate::gather, {.temporal_accuracy = 0.02}, [&](RecordOptions& records) {
          records.footprint = footprint, records.accuracy = accuracy;
          records.rays = 8192, records.max_radius_m = 3;
        });
    for (const FilmRecord& r : film.records)
      EXPECT_EQ(r.record.footprint != nullptr, footprint == Footprint::adaptive);
    return told_light(film, scene);
  };
  for (const double accuracy : {0.3, 0.5, 0.8}) {
    const ToldLight discs = told_by(Footprint::circle, accuracy),
                    axes = told_by(Footprint::adaptive, accuracy);
    std::printf("accuracy %g: %.1f discs off by %.2f %%, %.1f footprints off by %.2f %%\n", accuracy,
                discs.records, 100 * discs.rms, axes.records, 100 * axes.rms);
    EXPECT_LE(axes.records, 1.25 * discs.records + 1) << accuracy;
    EXPECT_LT(axes.rms, 0.6 * discs.rms) << accuracy;
  }
}

}  // namespace
}  // namespace phos::test
