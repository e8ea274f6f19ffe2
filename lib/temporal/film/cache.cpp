#include "temporal/film/cache.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "hsh/rotation.h"
#include "temporal/change.h"
#include "temporal/film/footprint_change.h"
#include "temporal/film/lives.h"

namespace phos::inline temporal {
namespace {

float frames_between(std::int64_t from, std::int64_t to) {
  PHOS_CHECK(from < to, "frames ", from, " and ", to);
  return static_cast<float>(to - from);
}

/// The radius at a frame: a radius that shrinks keeps the least that interpolation to any other leaves.
template <class Record>
float radius_at(const Record& r, std::int64_t frame) {
  const Life& life = r.life;
  const float least_m = r.record.radius_m / static_cast<float>(std::int64_t{life.end} - life.birth);
  return std::max(r.record.radius_m + static_cast<float>(frame - life.birth) * r.change.radius_m, least_m);
}

/// numbers += share * more, where there is more.
void add(std::vector<float>& numbers, float share, const std::vector<float>& more) {
  const std::size_t n = std::min(numbers.size(), more.size());
  for (std::size_t i = 0; i < n; ++i) numbers[i] += share * more[i];
}

/// (b - a) / frames; numbers that b lacks are 0.
std::vector<float> change_of(const std::vector<float>& a, const std::vector<float>& b, float frames) {
  std::vector<float> change(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) change[i] = ((i < b.size() ? b[i] : 0.f) - a[i]) / frames;
  return change;
}

void turn(IrradianceRecord& r, const Pose& from, const Pose& to) {
  r.normal = glm::normalize(turned(from, to, r.normal));
  for (int c = 0; c < 3; ++c) {
    r.rotation_gradient[c] = turned(from, to, r.rotation_gradient[c]);
    r.translation_gradient[c] = turned(from, to, r.translation_gradient[c]);
  }
  if (r.footprint)
    r.footprint = std::make_shared<AdaptiveFootprint>(
        r.footprint->moved_to(turned(from, to, r.footprint->x()), r.normal));
}

void turn(RadianceRecord& r, const Pose& from, const Pose& to) {
  Frame& f = r.frame;
  f.z = glm::normalize(turned(from, to, f.z));
  f.x = turned(from, to, f.x);
  f.x = glm::normalize(f.x - glm::dot(f.x, f.z) * f.z);
  f.y = glm::cross(f.z, f.x);
}

/// The same zone and light by a footprint whose axes start at x. The radius belongs to its longest axis.
void turn_about_normal(IrradianceRecord& r, const Vec3& x) {
  const float longest_m = r.footprint->longest_m();
  r.footprint = std::make_shared<AdaptiveFootprint>(r.footprint->with_axes_from(x, r.normal));
  r.radius_m *= r.footprint->longest_m() / longest_m;
}

/// The same light with the axes of `frame`, whose normal is its own.
void turn_about_normal(RadianceRecord& r, const Frame& frame) {
  const float angle = std::atan2(glm::dot(frame.y, r.frame.x), glm::dot(frame.x, r.frame.x));
  const float c = std::cos(angle), s = std::sin(angle);
  for (std::size_t i = 0; i < r.gradient_x.size(); ++i) {
    const float x = r.gradient_x[i], y = r.gradient_y[i];
    r.gradient_x[i] = c * x - s * y, r.gradient_y[i] = s * x + c * y;
  }
  for (std::vector<float>* numbers : {&r.light, &r.gradient_x, &r.gradient_y})
    if (!numbers->empty()) rotate_about_z(*numbers, angle, 3);
  if (r.footprint_m) {
    const AdaptiveFootprint own(r.frame.x, r.frame.z, *r.footprint_m),
        other = own.with_axes_from(frame.x, frame.z);
    r.footprint_m = other.lengths_m();
    r.radius_m *= other.longest_m() / own.longest_m();
  }
  r.frame = frame;
}

/// What a record counts for at a frame of its life (docs/methods.md#f1). Between a record and the next one it
/// is as good at the end of its life as at birth.
float weight_at(std::int64_t frame, const Life& life, const FilmInfo& film) {
  constexpr double kLeast = 0.01;
  if (film.gradients == TemporalGradients::interpolated) return 1;
  const double w = time_weight(static_cast<double>(life.rate), static_cast<double>(frame - life.birth),
                               film.temporal_accuracy, film.max_life);
  return static_cast<float>(std::max(kLeast, w));
}

/// Moves a record with its surface; false where that has no area.
template <class Record>
bool move(Record& r, const Life& life, const Scene& scene) {
  if (life.anchor.triangle == kNoTriangle) return true;
  const std::optional<Pose> now = pose_of(scene, life.anchor);
  if (!now) return false;
  r.position = now->position;
  if (now->turn != life.turn) turn(r, Pose{.turn = life.turn}, *now);
  return true;
}

template <class Record>
auto shown(const Record& film_record, float share, const FilmInfo& film, std::int64_t frame,
           const Scene& scene) {
  auto record = std::optional(changed(film_record, frame));
  if (!move(*record, film_record.life, scene)) return decltype(record)();
  record->weight = weight_at(frame, film_record.life, film) * share;
  return record;
}

template <class AnyFilm, class Records>
void take_alive(const AnyFilm& film, std::int64_t frame, const Scene& scene, Records& records) {
  const auto life = [&](std::size_t i) -> const Life& { return film.records[i].life; };
  for (const Alive& alive : alive_at(film.records.size(), life, film.info, frame))
    if (auto record = at_frame(film.records[alive.record], alive.share, film.info, frame, scene))
      records.push_back(std::move(*record));
}

}  // namespace

const char* name_of(TemporalGradients gradients) {
  switch (gradients) {
    case TemporalGradients::none:
      return "none";
    case TemporalGradients::extrapolated:
      return "extrapolated";
    case TemporalGradients::interpolated:
      return "interpolated";
  }
  return "";
}

IrradianceChange change_between(const FilmRecord& from, const FilmRecord& to, Reach reach) {
  const float frames = frames_between(from.life.birth, to.life.birth);
  const IrradianceRecord& a = from.record;
  IrradianceRecord b = to.record;
  turn(b, Pose{.turn = to.life.turn}, Pose{.turn = from.life.turn});
  PHOS_CHECK(!a.footprint == !b.footprint, "records of one place, with and without a footprint");
  if (a.footprint) turn_about_normal(b, a.footprint->x());
  IrradianceChange change;
  change.irradiance = (b.irradiance - a.irradiance) / frames;
  for (int c = 0; c < 3; ++c) {
    change.rotation[c] = (b.rotation_gradient[c] - a.rotation_gradient[c]) / frames;
    change.translation[c] = (b.translation_gradient[c] - a.translation_gradient[c]) / frames;
  }
  if (reach == Reach::changes) change.radius_m = (b.radius_m - a.radius_m) / frames;
  if (a.footprint)
    change.footprint = footprint_change(a.footprint->axes(), b.footprint->axes(), frames, reach);
  return change;
}

RadianceChange change_between(const FilmRadianceRecord& from, const FilmRadianceRecord& to, Reach reach) {
  const float frames = frames_between(from.life.birth, to.life.birth);
  const RadianceRecord& a = from.record;
  RadianceRecord b = to.record;
  turn(b, Pose{.turn = to.life.turn}, Pose{.turn = from.life.turn});
  PHOS_CHECK(a.footprint_m.has_value() == b.footprint_m.has_value(),
             "records of one place, with and without a footprint");
  turn_about_normal(b, a.frame);
  RadianceChange change{change_of(a.light, b.light, frames), change_of(a.gradient_x, b.gradient_x, frames),
                        change_of(a.gradient_y, b.gradient_y, frames)};
  if (reach == Reach::stays) return change;
  change.radius_m = (b.radius_m - a.radius_m) / frames;
  if (a.footprint_m) change.footprint_m = footprint_change(*a.footprint_m, *b.footprint_m, frames);
  return change;
}

IrradianceRecord changed(const FilmRecord& film, std::int64_t frame) {
  IrradianceRecord r = film.record;
  const auto age = static_cast<float>(frame - film.life.birth);
  r.irradiance = glm::max(r.irradiance + age * film.change.irradiance, Rgb(0));
  for (int c = 0; c < 3; ++c) {
    r.rotation_gradient[c] += age * film.change.rotation[c];
    r.translation_gradient[c] += age * film.change.translation[c];
  }
  r.radius_m = radius_at(film, frame);
  if (film.change.footprint) change_footprint(film, age, r);
  return r;
}

RadianceRecord changed(const FilmRadianceRecord& film, std::int64_t frame) {
  RadianceRecord r = film.record;
  const auto age = static_cast<float>(frame - film.life.birth);
  add(r.light, age, film.change.light);
  add(r.gradient_x, age, film.change.gradient_x);
  add(r.gradient_y, age, film.change.gradient_y);
  r.radius_m = radius_at(film, frame);
  if (film.change.footprint_m) change_footprint(film, age, r);
  return r;
}

std::optional<IrradianceRecord> at_frame(const FilmRecord& record, float share, const FilmInfo& film,
                                         std::int64_t frame, const Scene& scene) {
  return shown(record, share, film, frame, scene);
}
std::optional<RadianceRecord> at_frame(const FilmRadianceRecord& record, float share, const FilmInfo& film,
                                       std::int64_t frame, const Scene& scene) {
  return shown(record, share, film, frame, scene);
}

IrradianceCache cache_at(const Film& film, std::int64_t frame, const Scene& scene) {
  IrradianceCache cache;
  cache.accuracy = film.info.accuracy, cache.scene_hash = scene.hash, cache.quantity = film.quantity;
  take_alive(film, frame, scene, cache.records);
  return cache;
}

RadianceCache cache_at(const RadianceFilm& film, std::int64_t frame, const Scene& scene) {
  RadianceCache cache;
  cache.accuracy = film.info.accuracy, cache.scene_hash = scene.hash;
  take_alive(film, frame, scene, cache.records);
  return cache;
}

}  // namespace phos::inline temporal
