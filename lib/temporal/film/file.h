// The files of films.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "file/container.h"
#include "temporal/film/cache.h"

namespace phos::inline temporal {

/// The files hold the tensors of irradiance and radiance caches (records as they were born, no index), with
/// birth i32[n], end i32[n] (frames), chain u32[n], rate f32[n]; the change of every column that changes, its
/// name with _change and its unit per frame, unless gradients are none; and, where surfaces move, anchor
/// u32[n] (triangle, 2^32 - 1: none), anchor_uv f32[n,2], anchor_turn f32[n,4] (x, y, z, w). The header has a
/// `film` object: frames, temporal_accuracy, max_life, gradients, fade, the scene's hash at each frame, and
/// for people the number of chains and the mean life.
void write_film(const std::string& path, const Film& film, Provenance provenance);
void write_film(const std::string& path, const RadianceFilm& film, Provenance provenance,
                Store store = Store::floats);
/// Is this irradiance or radiance file one of a film?
bool is_film(const Container& file);
/// What its header says. Throws Error(bad_input) for one of no film, or a damaged one.
FilmInfo read_film_info(const Container& file);
/// Throw Error(bad_input) for a damaged file (the first bad record named), or one of no film.
Film read_film(const Container& file);
RadianceFilm read_radiance_film(const Container& file);
/// cache_at() of a film's file: its radiance records are read, and looked at, only where they are alive.
IrradianceCache read_film_at(const Container& file, std::int64_t frame, const Scene& scene);
RadianceCache read_radiance_film_at(const Container& file, std::int64_t frame, const Scene& scene);
/// The frames that each record of these caches lives, in their order: at least 1. Throws as they do.
std::vector<std::int32_t> lives_at(const Container& file, std::int64_t frame, const Scene& scene);

}  // namespace phos::inline temporal
