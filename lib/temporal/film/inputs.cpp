#include "temporal/film/inputs.h"

#include <cmath>

#include "core/error.h"
#include "temporal/film/file.h"

namespace phos::inline temporal {
namespace {

void require_frame(const Container& file, const FilmInfo& film, std::int64_t frame) {
  if (film.frames.contains(frame)) return;
  throw Error(ExitCode::mismatch, file.path(),
              text("is a film of frames ", film.frames.first, " to ", film.frames.last,
                   ", and the scene is at frame ", frame,
                   "; choose a frame of the film with --frame, or make more frames with phos-temporal"));
}

void require_same_frame(const Container& file, const FilmInfo& film, const Scene& scene) {
  const std::int64_t frame = frame_of(scene);
  require_frame(file, film, frame);
  if (film.scene_hash[static_cast<std::size_t>(frame - film.frames.first)] == scene.hash) return;
  const double exactly = scene.time_s * scene.frames_per_s;
  const bool between = std::fabs(exactly - static_cast<double>(frame)) > 1e-6;
  throw Error(ExitCode::mismatch, file.path(),
              between ? text("is a film of whole frames, and the scene is at ", exactly,
                             "; choose a whole frame with --frame, or pass --allow-mismatch")
                      : text("was made from another scene (", scene.path, " has changed at frame ", frame,
                             "); rerun phos-temporal, or pass --allow-mismatch"));
}

}  // namespace

std::int64_t frame_of(const Scene& scene) { return std::llround(scene.time_s * scene.frames_per_s); }

void require_same_scene(const Container& file, const std::string& scene_path, const Scene& scene) {
  if (is_film(file))
    require_same_frame(file, read_film_info(file), scene);
  else
    require_same_scene(file, scene_path, scene.hash, scene.parts);
}

void require_same_film(const Container& file, const FilmSurvey& survey) {
  const auto refuse = [&](const std::string& message) {
    throw Error(ExitCode::mismatch, file.path(), message + "; make it with phos-temporal --kind radiance");
  };
  if (!is_film(file)) {
    if (survey.light_changes) refuse("holds the light of one time, and light changes in these frames");
    if (file.provenance().scene_hash != survey.scene_hash.front()) refuse("was made from another scene");
    return;
  }
  const FilmInfo film = read_film_info(file);
  const FrameRange& frames = survey.frames;
  if (!film.frames.contains(frames.first) || !film.frames.contains(frames.last))
    refuse(text("is a film of frames ", film.frames.first, " to ", film.frames.last, ", and frames ",
                frames.first, " to ", frames.last, " are asked for"));
  for (std::int64_t f = frames.first; f <= frames.last; ++f)
    if (film.scene_hash[static_cast<std::size_t>(f - film.frames.first)] != survey.hash_of(f))
      refuse(text("was made from another scene, or the scene has changed at frame ", f));
}

IrradianceCache read_irradiance_at(const Container& file, const Scene& scene) {
  if (!is_film(file)) return read_irradiance(file);
  require_frame(file, read_film_info(file), frame_of(scene));
  return read_film_at(file, frame_of(scene), scene);
}

RadianceCache read_radiance_at(const Container& file, const Scene& scene) {
  if (!is_film(file)) return read_radiance(file);
  require_frame(file, read_film_info(file), frame_of(scene));
  return read_radiance_film_at(file, frame_of(scene), scene);
}

SensorCaches sensor_caches_at(std::span<const Container> files, const Scene& scene,
                              const RayScene* leak_test) {
  std::vector<Container> caches, films;
  for (const Container& file : files) (is_film(file) ? films : caches).push_back(file);
  SensorCaches all(caches, leak_test);
  for (const Container& film : films) {
    const bool radiance = film.kind() == FileKind::radiance;
    all.add(radiance ? irradiance_of(read_radiance_at(film, scene)) : read_irradiance_at(film, scene),
            film.path());
  }
  return all;
}

}  // namespace phos::inline temporal
