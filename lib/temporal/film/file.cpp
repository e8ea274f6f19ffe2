#include "temporal/film/file.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/error.h"
#include "core/float_traps.h"
#include "radiance/columns.h"
#include "radiance/compact_columns.h"
#include "record/footprint_columns.h"
#include "temporal/film/cache.h"
#include "temporal/film/lives.h"

namespace phos::inline temporal {
namespace {

// --- changes ---

constexpr const char* kChangeEnding = "_change";  // of a column of changes per frame

struct IrradianceChanges {
  std::vector<Vec3> irradiance, rotation, translation;
  std::vector<float> radius_m;
  std::optional<AxisColumns> axes;  // where records have footprints

  explicit IrradianceChanges(const Film& film) {
    if (!film.records.empty() && film.records.front().record.footprint) axes.emplace();
    for (const FilmRecord& r : film.records) {
      if (axes) axes->append(r.change.footprint ? *r.change.footprint : AdaptiveFootprint::Axes());
      irradiance.push_back(r.change.irradiance), radius_m.push_back(r.change.radius_m);
      rotation.insert(rotation.end(), std::begin(r.change.rotation), std::end(r.change.rotation));
      translation.insert(translation.end(), std::begin(r.change.translation), std::end(r.change.translation));
    }
  }
  void add_to(TensorWriter& file) const {
    file.add_vectors("irradiance_change", irradiance);
    file.add_vectors("rotation_gradient_change", rotation);
    file.add_vectors("translation_gradient_change", translation);
    file.add<float>("radius_change", radius_m);
    if (axes) axes->add_to(file, kChangeEnding);
  }
};

/// film.records[k] is row rows[k] of the file.
void read_changes(const TensorReader& file, const std::vector<std::size_t>& rows, Film& film) {
  const auto irradiance = file.vectors("irradiance_change"),
             rotation = file.vectors("rotation_gradient_change"),
             translation = file.vectors("translation_gradient_change");
  const auto radius_m = file.values<float>("radius_change");
  const std::vector<AdaptiveFootprint::Axes> axes = read_axes(file, kChangeEnding);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (!axes.empty() && film.records[k].record.footprint)
      film.records[k].change.footprint = std::make_shared<const AdaptiveFootprint::Axes>(axes[rows[k]]);
    IrradianceChange& change = film.records[k].change;
    const std::size_t i = rows[k];
    change.irradiance = irradiance[i], change.radius_m = radius_m[i];
    for (std::size_t c = 0; c < 3; ++c) {
      change.rotation[c] = rotation[3 * i + c];
      change.translation[c] = translation[3 * i + c];
    }
  }
}

struct RadianceChanges {
  std::size_t n, bands, count;  ///< records, bands, coefficients of a colour
  bool gradients;
  std::vector<float> light, gradient_x, gradient_y, radius_m;
  std::vector<float> length_m;        ///< of the axes of footprints, where records have them
  std::optional<HalfColumns> halves;  ///< of light, in compact files
  std::optional<ByteColumns> bytes;   ///< of gradients, in compact files

  RadianceChanges(const RadianceFilm& film, int order, Store store)
      : n(film.records.size()),
        bands(static_cast<std::size_t>(order)),
        count(bands * bands),
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
      if (!record.footprint_m) continue;
      const auto lengths_m = change.footprint_m.value_or(AdaptiveFootprint::Lengths{});
      length_m.insert(length_m.end(), lengths_m.begin(), lengths_m.end());
    }
    if (store == Store::floats) return;
    halves.emplace(n, FloatColumns{light});
    if (gradients) bytes.emplace(n, bands, FloatColumns{gradient_x, gradient_y});
  }
  void add_to(TensorWriter& file) const {
    file.extent("n", n), file.extent("N", bands);
    if (halves) {
      file.add<float>("change_scale", halves->unit);
      file.add<Half>("coefficients_change", halves->columns[0]);
    } else {
      file.add<float>("coefficients_change", light);
    }
    if (bytes) {
      file.add<std::int8_t>("gradient_change_exponent", bytes->exponent);
      file.add<std::int8_t>("gradient_x_change", bytes->columns[0]);
      file.add<std::int8_t>("gradient_y_change", bytes->columns[1]);
    } else if (gradients) {
      file.add<float>("gradient_x_change", gradient_x);
      file.add<float>("gradient_y_change", gradient_y);
    }
    file.add<float>("radius_change", radius_m);
    if (!length_m.empty()) file.add<float>(text("footprint_length", kChangeEnding), length_m);
  }
};

[[noreturn]] void refuse_record(const Container& file, std::size_t i, const char* wrong) {
  throw Error(ExitCode::bad_input, file.path(),
              text("record ", i, " has ", wrong,
                   "; the file is damaged or was made by a faulty program: make it again"));
}

void read_changes(const TensorReader& file, const std::vector<std::size_t>& rows, RadianceFilm& film) {
  const auto bands = static_cast<std::size_t>(file.extent("N")), count = bands * bands;
  const auto radius_m = file.values<float>("radius_change");
  for (std::size_t k = 0; k < rows.size(); ++k) film.records[k].change.radius_m = radius_m[rows[k]];
  const std::string length = "footprint_length", length_change = length + kChangeEnding;
  if (file.has(length) || file.has(length_change)) {  // both or none
    file.values<float>(length);
    const float* of_all = file.values<float>(length_change).data();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      AdaptiveFootprint::Lengths& change = film.records[k].change.footprint_m.emplace();
      std::copy_n(of_all + change.size() * rows[k], change.size(), change.begin());
    }
  }
  std::vector<float> space;
  const auto take = [&](const char* name, const char* unit, std::vector<float> RadianceRecord::*of,
                        std::vector<float> RadianceChange::*to) {
    const StoredColumn all(file, name, unit);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const float* row = all.row(rows[k], space);
      const std::size_t used = (film.records[k].record.*of).size() / 3;
      if (!rest_is_zero(row, count, used))
        refuse_record(file.file(), rows[k], "changes beyond its own order");
      if (!rest_is_zero(row, count, 0)) film.records[k].change.*to = from_column(row, count, used);
    }
  };
  take("coefficients_change", "change_scale", &RadianceRecord::light, &RadianceChange::light);
  if (!file.has("gradient_x")) return;
  take("gradient_x_change", "gradient_change_exponent", &RadianceRecord::gradient_x,
       &RadianceChange::gradient_x);
  take("gradient_y_change", "gradient_change_exponent", &RadianceRecord::gradient_y,
       &RadianceChange::gradient_y);
}

bool all_finite(const IrradianceRecord& r) {
  bool finite = is_finite(r.irradiance) && std::isfinite(r.radius_m);
  for (int c = 0; c < 3; ++c)
    finite = finite && is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]);
  return finite && !(r.footprint && what_is_wrong(*r.footprint, r.normal));
}
bool all_finite(const RadianceRecord& r) {
  return is_finite(r) && !(r.footprint_m && !are_lengths(*r.footprint_m));
}

/// nullptr: nothing. What changes is largest or least at the end of a life.
template <class Record>
const char* what_is_wrong_with_change(const Record& r) {
  const NoFloatTraps traps;  // sums of numbers in files may overflow
  return all_finite(changed(r, r.life.end - 1)) ? nullptr : "a change that is not finite";
}

// --- both kinds ---

/// The part of a file that is to be read: all records, or the records alive at a frame.
struct Wanted {
  FilmInfo info;
  std::vector<Life> lives;  ///< all
  std::vector<Alive> alive;
  std::vector<std::size_t> rows;

  explicit Wanted(const Container& file, std::optional<std::int64_t> frame = {})
      : info(read_film_info(file)) {
    file.require_sound();
    lives = read_lives(TensorReader(file));
    const std::size_t n = lives.size();
    for (std::size_t i = 0; i < n; ++i)
      if (const char* wrong = what_is_wrong(lives[i], i > 0 ? &lives[i - 1] : nullptr, info))
        refuse_record(file, i, wrong);
    if (frame) {
      alive = alive_at(
          n, [&](std::size_t i) -> const Life& { return lives[i]; }, info, *frame);
      for (const Alive& a : alive) rows.push_back(a.record);
    } else {
      rows.resize(n);
      std::iota(rows.begin(), rows.end(), std::size_t{0});
    }
  }
};

/// Fills all but the records themselves.
template <class AnyFilm>
void complete(const Container& file, const Wanted& wanted, AnyFilm& film) {
  film.info = wanted.info;
  for (std::size_t k = 0; k < wanted.rows.size(); ++k) film.records[k].life = wanted.lives[wanted.rows[k]];
  if (film.info.gradients != TemporalGradients::none) read_changes(TensorReader(file), wanted.rows, film);
  for (std::size_t k = 0; k < wanted.rows.size(); ++k)
    if (const char* wrong = what_is_wrong_with_change(film.records[k]))
      refuse_record(file, wanted.rows[k], wrong);
}

Film read(const Container& file, const Wanted& wanted) {
  const RecordColumns columns(file, FileForm::film);
  Film film;
  film.quantity = columns.quantity();
  film.records.resize(wanted.rows.size());
  for (std::size_t k = 0; k < wanted.rows.size(); ++k) film.records[k].record = columns[wanted.rows[k]];
  complete(file, wanted, film);
  return film;
}

RadianceFilm read_radiance(const Container& file, const Wanted& wanted) {
  RadianceCache cache = read_radiance_rows(file, FileForm::film, &wanted.rows);
  RadianceFilm film;
  film.records.resize(cache.records.size());
  for (std::size_t k = 0; k < film.records.size(); ++k) film.records[k].record = std::move(cache.records[k]);
  complete(file, wanted, film);
  return film;
}

/// `film` holds the records that are alive.
template <class Cache, class AnyFilm>
Cache shown(const AnyFilm& film, const Wanted& wanted, std::int64_t frame, const Scene& scene) {
  Cache cache;
  cache.accuracy = film.info.accuracy, cache.scene_hash = scene.hash;
  for (std::size_t k = 0; k < film.records.size(); ++k)
    if (auto record = at_frame(film.records[k], wanted.alive[k].share, film.info, frame, scene))
      cache.records.push_back(std::move(*record));
  return cache;
}

/// The frames that each record of shown() lives.
template <class AnyFilm>
std::vector<std::int32_t> lives_shown(const AnyFilm& film, const Wanted& wanted, std::int64_t frame,
                                      const Scene& scene) {
  std::vector<std::int32_t> lives;
  for (std::size_t k = 0; k < film.records.size(); ++k)
    if (at_frame(film.records[k], wanted.alive[k].share, film.info, frame, scene))
      lives.push_back(film.records[k].life.end - film.records[k].life.birth);
  return lives;
}

/// The columns that a film has more than a cache.
template <class AnyFilm>
LifeColumns lives_of(const AnyFilm& film) {
  LifeColumns lives;
  for (std::size_t i = 0; i < film.records.size(); ++i) {
    const auto& r = film.records[i];
    const char* wrong = what_is_wrong(r.life, i > 0 ? &film.records[i - 1].life : nullptr, film.info);
    if (!wrong) wrong = what_is_wrong_with_change(r);
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
  const LifeColumns lives = lives_of(film);
  provenance.extra[name_of(FileForm::film)] = film_header(film.info, lives);
  const IrradianceChanges changes(film);
  TensorWriter more(FileKind::irradiance);
  lives.add_to(more);
  if (film.info.gradients != TemporalGradients::none) changes.add_to(more);
  auto cache = born<IrradianceCache>(film);
  cache.quantity = film.quantity;
  write_irradiance(path, cache, std::move(provenance), {}, std::move(more));
}

void write_film(const std::string& path, const RadianceFilm& film, Provenance provenance, Store store) {
  const LifeColumns lives = lives_of(film);
  provenance.extra[name_of(FileForm::film)] = film_header(film.info, lives);
  const auto cache = born<RadianceCache>(film);
  const RadianceChanges changes(film, cache.order(), store);
  TensorWriter more(FileKind::radiance);
  lives.add_to(more);
  if (film.info.gradients != TemporalGradients::none) changes.add_to(more);
  write_radiance(path, cache, std::move(provenance), store, std::move(more));
}

bool is_film(const Container& file) {
  const FileKind kind = file.kind();
  return (kind == FileKind::irradiance || kind == FileKind::radiance) && file.form() == FileForm::film;
}

Film read_film(const Container& file) { return read(file, Wanted(file)); }
RadianceFilm read_radiance_film(const Container& file) { return read_radiance(file, Wanted(file)); }

IrradianceCache read_film_at(const Container& file, std::int64_t frame, const Scene& scene) {
  const Wanted wanted(file, frame);
  const Film film = read(file, wanted);
  auto cache = shown<IrradianceCache>(film, wanted, frame, scene);
  cache.quantity = film.quantity;
  return cache;
}

RadianceCache read_radiance_film_at(const Container& file, std::int64_t frame, const Scene& scene) {
  const Wanted wanted(file, frame);
  return shown<RadianceCache>(read_radiance(file, wanted), wanted, frame, scene);
}

std::vector<std::int32_t> lives_at(const Container& file, std::int64_t frame, const Scene& scene) {
  const Wanted wanted(file, frame);
  return file.kind() == FileKind::radiance ? lives_shown(read_radiance(file, wanted), wanted, frame, scene)
                                           : lives_shown(read(file, wanted), wanted, frame, scene);
}

}  // namespace phos::inline temporal
