// The files of films.
#include <algorithm>
#include <cmath>
#include <limits>

#include "cache/radiance_columns.h"
#include "core/error.h"
#include "temporal/film_cache.h"

namespace phos {
namespace {

// --- lives ---

/// nullptr: nothing. `before`: the life of the record before it, if there is one.
const char* what_is_wrong(const Life& life, const Life* before, const FilmInfo& film) {
  if (!(life.birth < life.end)) return "an end that is not after its birth";
  if (life.birth < film.frames.first || life.end > film.frames.last + 1) return "a life outside of the film";
  if (before && life.chain < before->chain) return "a chain before that of the record before it";
  if (before && life.chain == before->chain && life.birth < before->end)
    return "a life that begins before that of its chain's record before it ends";
  if (!std::isfinite(life.rate) || life.rate < 0) return "a rate that is not finite or negative";
  const Anchor& a = life.anchor;
  if (a.triangle == kNoTriangle) return nullptr;
  constexpr float kSlack = 1e-4f;
  if (!(a.u >= -kSlack && a.v >= -kSlack && a.u + a.v <= 1 + kSlack)) return "an anchor outside its triangle";
  if (!(std::fabs(glm::length(life.turn) - 1) <= kSlack)) return "a turn that is not of unit length";
  return nullptr;
}

struct LifeColumns {
  std::vector<std::int32_t> birth, end;
  std::vector<std::uint32_t> chain, anchor;
  std::vector<float> rate, uv, turn;
  bool moving = false;

  void append(const Life& life) {
    birth.push_back(life.birth), end.push_back(life.end);
    chain.push_back(life.chain), rate.push_back(life.rate);
    anchor.push_back(life.anchor.triangle);
    for (const float x : {life.anchor.u, life.anchor.v}) uv.push_back(x);
    for (const float x : {life.turn.x, life.turn.y, life.turn.z, life.turn.w}) turn.push_back(x);
    moving = moving || life.anchor.triangle != kNoTriangle;
  }
  void add_to(ContainerWriter& file) const {
    const std::size_t n = birth.size();
    file.add<std::int32_t>("birth", birth, {n}, "frame");
    file.add<std::int32_t>("end", end, {n}, "frame");
    file.add<std::uint32_t>("chain", chain, {n}, "1");
    file.add<float>("rate", rate, {n}, "1/frame");
    if (!moving) return;
    file.add<std::uint32_t>("anchor", anchor, {n}, "1");
    file.add<float>("anchor_uv", uv, {n, 2}, "1");
    file.add<float>("anchor_turn", turn, {n, 4}, "1");
  }
};

template <class Record>
void read_lives(const Container& file, std::vector<Record>& records) {
  const std::size_t n = records.size();
  const auto birth = file.values<std::int32_t>("birth", {n}), end = file.values<std::int32_t>("end", {n});
  const auto chain = file.values<std::uint32_t>("chain", {n});
  const auto rate = file.values<float>("rate", {n});
  for (std::size_t i = 0; i < n; ++i)
    records[i].life.birth = birth[i], records[i].life.end = end[i], records[i].life.chain = chain[i],
    records[i].life.rate = rate[i];
  if (!file.has("anchor") && !file.has("anchor_uv") && !file.has("anchor_turn")) return;
  const auto anchor = file.values<std::uint32_t>("anchor", {n});
  const auto uv = file.values<float>("anchor_uv", {n, 2}), turn = file.values<float>("anchor_turn", {n, 4});
  for (std::size_t i = 0; i < n; ++i) {
    Life& life = records[i].life;
    life.anchor = {anchor[i], uv[2 * i], uv[2 * i + 1]};
    life.turn = {turn[4 * i + 3], turn[4 * i], turn[4 * i + 1], turn[4 * i + 2]};
  }
}

// --- changes ---

struct IrradianceChanges {
  std::vector<Vec3> irradiance, rotation, translation;
  std::vector<float> radius_m;

  explicit IrradianceChanges(const Film& film) {
    for (const FilmRecord& r : film.records) {
      irradiance.push_back(r.change.irradiance), radius_m.push_back(r.change.radius_m);
      rotation.insert(rotation.end(), std::begin(r.change.rotation), std::end(r.change.rotation));
      translation.insert(translation.end(), std::begin(r.change.translation), std::end(r.change.translation));
    }
  }
  void add_to(ContainerWriter& file) const {
    const std::size_t n = irradiance.size();
    const auto gradient = [&](const char* name, const std::vector<Vec3>& v, const char* unit) {
      file.add<float>(name, {reinterpret_cast<const float*>(v.data()), 9 * n}, {n, 3, 3}, unit);
    };
    file.add_vectors("irradiance_change", irradiance, "lx/frame");
    gradient("rotation_gradient_change", rotation, "lx/rad/frame");
    gradient("translation_gradient_change", translation, "lx/m/frame");
    file.add<float>("radius_change", radius_m, {n}, "m/frame");
  }
};

void read_changes(const Container& file, Film& film) {
  const std::size_t n = film.records.size();
  const auto irradiance = file.values<float>("irradiance_change", {n, 3}),
             rotation = file.values<float>("rotation_gradient_change", {n, 3, 3}),
             translation = file.values<float>("translation_gradient_change", {n, 3, 3}),
             radius_m = file.values<float>("radius_change", {n});
  const auto vector = [](std::span<const float> v, std::size_t i) {
    return Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    IrradianceChange& change = film.records[i].change;
    change.irradiance = vector(irradiance, i), change.radius_m = radius_m[i];
    for (std::size_t c = 0; c < 3; ++c)
      change.rotation[c] = vector(rotation, 3 * i + c),
      change.translation[c] = vector(translation, 3 * i + c);
  }
}

struct RadianceChanges {
  std::size_t n, count;  ///< coefficients of a colour
  bool gradients;
  std::vector<float> light, gradient_x, gradient_y, radius_m;

  explicit RadianceChanges(const RadianceFilm& film, int order)
      : n(film.records.size()),
        count(static_cast<std::size_t>(order) * static_cast<std::size_t>(order)),
        gradients(n > 0 && !film.records.front().record.gradient_x.empty()),
        light(3 * n * count),
        gradient_x(gradients ? light.size() : 0),
        gradient_y(gradient_x.size()) {
    for (std::size_t i = 0; i < n; ++i) {
      const RadianceRecord& record = film.records[i].record;
      const RadianceChange& change = film.records[i].change;
      const auto put = [&](const std::vector<float>& from, const std::vector<float>& of,
                           std::vector<float>& to) {
        PHOS_CHECK(from.empty() || from.size() == of.size(), "record ", i, " changes in ", from.size(),
                   " of ", of.size(), " numbers");
        if (!from.empty()) to_column(from, &to[3 * i * count], count);
      };
      put(change.light, record.light, light);
      put(change.gradient_x, record.gradient_x, gradient_x);
      put(change.gradient_y, record.gradient_y, gradient_y);
      radius_m.push_back(change.radius_m);
    }
  }
  void add_to(ContainerWriter& file) const {
    file.add<float>("coefficients_change", light, {n, 3, count}, "cd/m2 sqrt(sr)/frame");
    if (gradients) {
      file.add<float>("gradient_x_change", gradient_x, {n, 3, count}, "cd/m2 sqrt(sr)/m/frame");
      file.add<float>("gradient_y_change", gradient_y, {n, 3, count}, "cd/m2 sqrt(sr)/m/frame");
    }
    file.add<float>("radius_change", radius_m, {n}, "m/frame");
  }
};

[[noreturn]] void refuse_record(const Container& file, std::size_t i, const char* wrong) {
  throw Error(ExitCode::bad_input, file.path(),
              text("record ", i, " has ", wrong,
                   "; the file is damaged or was made by a faulty program: make it again"));
}

void read_changes(const Container& file, RadianceFilm& film) {
  const std::size_t n = film.records.size();
  const Tensor& tensor = file.tensors().at("coefficients");  // read_radiance has found it
  const std::size_t count = n > 0 ? static_cast<std::size_t>(tensor.shape[2]) : 0;
  const auto radius_m = file.values<float>("radius_change", {n});
  for (std::size_t i = 0; i < n; ++i) film.records[i].change.radius_m = radius_m[i];
  const auto take = [&](const char* name, std::vector<float> RadianceRecord::*of,
                        std::vector<float> RadianceChange::*to) {
    const auto all = file.values<float>(name, {n, 3, count});
    for (std::size_t i = 0; i < n; ++i) {
      const float* row = all.data() + 3 * i * count;
      const std::size_t used = (film.records[i].record.*of).size() / 3;
      if (!rest_is_zero(row, count, used)) refuse_record(file, i, "changes beyond its own order");
      if (!rest_is_zero(row, count, 0)) film.records[i].change.*to = from_column(row, count, used);
    }
  };
  take("coefficients_change", &RadianceRecord::light, &RadianceChange::light);
  if (n == 0 || film.records.front().record.gradient_x.empty()) return;
  take("gradient_x_change", &RadianceRecord::gradient_x, &RadianceChange::gradient_x);
  take("gradient_y_change", &RadianceRecord::gradient_y, &RadianceChange::gradient_y);
}

bool all_finite(const IrradianceRecord& r) {
  bool finite = is_finite(r.irradiance) && std::isfinite(r.radius_m);
  for (int c = 0; c < 3; ++c)
    finite = finite && is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]);
  return finite;
}
bool all_finite(const RadianceRecord& r) { return is_finite(r); }

/// nullptr: nothing.
template <class Record>
const char* what_is_wrong(const Record& r, const Record* before, const FilmInfo& film) {
  if (const char* wrong = what_is_wrong(r.life, before ? &before->life : nullptr, film)) return wrong;
  // All that changes is largest or least at the end.
  return all_finite(changed(r, r.life.end - 1)) ? nullptr : "a change that is not finite";
}

// --- header ---

template <class Record>
Json header_of(const FilmInfo& film, const std::vector<Record>& records) {
  const auto frames = static_cast<std::size_t>(film.frames.count());
  PHOS_CHECK(film.scene_hash.size() == frames, film.scene_hash.size(), " hashes of ", frames, " frames");
  Json j;
  j["frames"] = Json::Array{film.frames.first, film.frames.last};
  j["temporal_accuracy"] = film.temporal_accuracy;
  j["max_life"] = film.max_life;
  j["gradients"] = name_of(film.gradients);
  j["fade"] = film.fade;
  Json::Array hashes;
  for (const std::string& hash : film.scene_hash) hashes.emplace_back(hash);
  j["scene_hash"] = std::move(hashes);
  std::int64_t chains = 0, lived = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    chains += i == 0 || records[i].life.chain != records[i - 1].life.chain;
    lived += std::int64_t{records[i].life.end} - records[i].life.birth;
  }
  j["chains"] = chains;
  if (!records.empty()) j["mean_life"] = static_cast<double>(lived) / static_cast<double>(records.size());
  return j;
}

}  // namespace

FilmInfo read_film_info(const Container& file) {
  require_records_of(RecordsOf::film, file);
  const Json& film = *file.provenance().extra.find("film");
  const auto refuse = [&](const std::string& name) {
    throw Error(ExitCode::bad_input, file.path(),
                text("its header does not say the film's ", name, "; make the file again"));
  };
  const auto integer = [&](const char* name, const Json* value) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max() - 1;
    if (!value || !value->is_integer() || value->as_integer() < 0 || value->as_integer() > kMost)
      refuse(name);
    return value->as_integer();
  };
  FilmInfo info;
  const Json* accuracy = file.provenance().extra.find("accuracy");
  if (!accuracy || !accuracy->is_number() || !(accuracy->as_number() > 0)) refuse("accuracy");
  info.accuracy = accuracy->as_number();
  const Json* frames = film.find("frames");
  if (!frames || !frames->is_array() || frames->as_array().size() != 2) refuse("frames");
  info.frames = {integer("frames", &frames->as_array()[0]), integer("frames", &frames->as_array()[1])};
  if (info.frames.count() < 1) refuse("frames");
  const Json* temporal = film.find("temporal_accuracy");
  if (!temporal || !temporal->is_number() || !(temporal->as_number() > 0)) refuse("temporal_accuracy");
  info.temporal_accuracy = temporal->as_number();
  info.max_life = integer("max_life", film.find("max_life"));
  if (info.max_life < 1) refuse("max_life");
  info.fade = integer("fade", film.find("fade"));
  const Json* gradients = film.find("gradients");
  constexpr TemporalGradients kAll[] = {TemporalGradients::none, TemporalGradients::extrapolated,
                                        TemporalGradients::interpolated};
  const auto found = std::find_if(std::begin(kAll), std::end(kAll), [&](TemporalGradients g) {
    return gradients && *gradients == Json(name_of(g));
  });
  if (found == std::end(kAll)) refuse("gradients");
  info.gradients = *found;
  const Json* hashes = film.find("scene_hash");
  if (!hashes || !hashes->is_array() ||
      hashes->as_array().size() != static_cast<std::size_t>(info.frames.count()))
    refuse("scene_hash of each frame");
  for (const Json& hash : hashes->as_array()) {
    if (!hash.is_string()) refuse("scene_hash of each frame");
    info.scene_hash.push_back(hash.as_string());
  }
  return info;
}

// --- both kinds ---

namespace {

/// Fills all but the records themselves.
template <class AnyFilm>
void complete(const Container& file, AnyFilm& film) {
  film.info = read_film_info(file);
  read_lives(file, film.records);
  if (film.info.gradients != TemporalGradients::none) read_changes(file, film);
  for (std::size_t i = 0; i < film.records.size(); ++i)
    if (const char* wrong = what_is_wrong(film.records[i], i > 0 ? &film.records[i - 1] : nullptr, film.info))
      refuse_record(file, i, wrong);
}

/// The columns that a film has more than a cache.
template <class AnyFilm>
LifeColumns lives_of(const AnyFilm& film) {
  LifeColumns lives;
  for (std::size_t i = 0; i < film.records.size(); ++i) {
    const char* wrong = what_is_wrong(film.records[i], i > 0 ? &film.records[i - 1] : nullptr, film.info);
    PHOS_CHECK(wrong == nullptr, "record ", i, " has ", wrong);
    lives.append(film.records[i].life);
  }
  return lives;
}

/// The records as they were born.
template <class Cache, class AnyFilm>
Cache born(const AnyFilm& film) {
  Cache cache;
  cache.accuracy = film.info.accuracy, cache.scene_hash = film.info.scene_hash.front();
  for (const auto& r : film.records) cache.records.push_back(r.record);
  return cache;
}

}  // namespace

void write_film(const std::string& path, const Film& film, Provenance provenance) {
  provenance.extra["film"] = header_of(film.info, film.records);
  const LifeColumns lives = lives_of(film);
  const IrradianceChanges changes(film);
  ContainerWriter more;
  lives.add_to(more);
  if (film.info.gradients != TemporalGradients::none) changes.add_to(more);
  auto cache = born<IrradianceCache>(film);
  cache.quantity = film.quantity;
  write_irradiance(path, cache, std::move(provenance), {}, std::move(more));
}

void write_film(const std::string& path, const RadianceFilm& film, Provenance provenance) {
  provenance.extra["film"] = header_of(film.info, film.records);
  const auto cache = born<RadianceCache>(film);
  const LifeColumns lives = lives_of(film);
  const RadianceChanges changes(film, cache.order());
  ContainerWriter more;
  lives.add_to(more);
  if (film.info.gradients != TemporalGradients::none) changes.add_to(more);
  write_radiance(path, cache, std::move(provenance), std::move(more));
}

bool is_film(const Container& file) {
  const std::string& kind = file.provenance().kind;
  return (kind == "irradiance" || kind == "radiance") && records_of(file) == RecordsOf::film;
}

Film read_film(const Container& file) {
  const RecordColumns columns(file, RecordsOf::film);
  Film film;
  film.quantity = columns.quantity();
  film.records.resize(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) film.records[i].record = columns[i];
  complete(file, film);
  return film;
}

RadianceFilm read_radiance_film(const Container& file) {
  RadianceCache cache = read_radiance(file, RecordsOf::film);
  RadianceFilm film;
  film.records.resize(cache.records.size());
  for (std::size_t i = 0; i < film.records.size(); ++i) film.records[i].record = std::move(cache.records[i]);
  complete(file, film);
  return film;
}

}  // namespace phos
