#include "splat/caches.h"

#include <algorithm>

#include "core/error.h"
#include "radiance/brdf/file.h"
#include "temporal/film/file.h"
#include "temporal/film/inputs.h"

namespace phos::inline splat {

namespace {

bool is_brdf(const Container& file) { return file.kind() == FileKind::brdf; }

/// The records of several files as one cache.
class Joined {
 public:
  explicit Joined(IrradianceCache& all) : all_(all) {}

  void add(const Container& file, const IrradianceCache& more) {
    if (first_ && more.quantity != all_.quantity)
      throw Error(
          ExitCode::mismatch, file.path(),
          text("holds ", name_of(more.quantity), " light, ", first_->path(), " holds ",
               name_of(all_.quantity),
               "; make both with the same --paths of phos-irradiance (radiance records are indirect)"));
    if (first_) require_same_caustics(more.caustics != nullptr, all_.caustics != nullptr, file.path());
    if (!first_) all_.accuracy = more.accuracy, all_.quantity = more.quantity, all_.caustics = more.caustics;
    append(all_, more);
    if (!first_) first_ = &file;
  }

 private:
  IrradianceCache& all_;
  const Container* first_ = nullptr;
};

void add(RadianceCache& all, RadianceCache more) {
  if (all.records.empty()) all.accuracy = more.accuracy, all.scene_hash = more.scene_hash;
  const auto reach = static_cast<float>(more.accuracy / all.accuracy);
  for (RadianceRecord& r : more.records) {
    r.radius_m *= reach;
    all.records.push_back(std::move(r));
  }
}

/// The lives of `n` records more, which a file gave.
void add(RecordLives& all, const Container& file, const Scene& scene, std::size_t n) {
  if (!is_film(file)) {
    all.frames.insert(all.frames.end(), n, 0);
    return;
  }
  const FilmInfo film = read_film_info(file);
  const std::vector<std::int32_t> lives = lives_at(file, frame_of(scene), scene);
  PHOS_CHECK(lives.size() == n, lives.size(), " lives of ", n, " records");
  all.frames.insert(all.frames.end(), lives.begin(), lives.end());
  all.most = std::max(all.most, std::min(film.max_life, film.frames.count()));
}

}  // namespace

bool is_radiance(const Container& file) { return file.kind() == FileKind::radiance; }

SplatCaches read_caches(const std::vector<Container>& files, const Scene& scene, bool glossy, bool lives) {
  SplatCaches caches;
  Joined all(caches.irradiance);
  for (const Container& file : files) {
    const std::size_t before = caches.irradiance.records.size();
    if (is_brdf(file)) {
      for (BrdfTable& table : read_brdf(file)) caches.brdf.push_back(std::move(table));
    } else if (!is_radiance(file)) {
      all.add(file, read_irradiance_at(file, scene));
    } else if (RadianceCache more = read_radiance_at(file, scene); glossy && !more.records.empty()) {
      all.add(file, irradiance_of(more));
      add(caches.radiance, std::move(more));
    }
    if (const std::size_t n = caches.irradiance.records.size() - before; lives && n > 0)
      add(caches.lives, file, scene, n);
  }
  return caches;
}

}  // namespace phos::inline splat
