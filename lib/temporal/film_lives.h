// When records live and where: what the files of irradiance and radiance films have in common.
#pragma once

#include <vector>

#include "core/json.h"
#include "file/container.h"
#include "temporal/film_cache.h"

namespace phos {

/// What is wrong with a life, nullptr: nothing. `before`: the life of the record before it, if there is one.
const char* what_is_wrong(const Life& life, const Life* before, const FilmInfo& film);

/// Lives as columns; must outlive the writer that they are added to.
struct LifeColumns {
  std::vector<std::int32_t> birth, end;
  std::vector<std::uint32_t> chain, anchor;
  std::vector<float> rate, uv, turn;
  bool moving = false;  ///< is any anchored?

  void append(const Life& life);
  void add_to(ContainerWriter& file) const;
};
/// Of n records. Throws Error(bad_input) for columns that lack.
std::vector<Life> read_lives(const Container& file, std::size_t n);

/// The `film` object of a file's header, which read_film_info() reads.
Json film_header(const FilmInfo& film, const LifeColumns& lives);

}  // namespace phos
