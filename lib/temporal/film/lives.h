// When records live and where, in irradiance and radiance films.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/json.h"
#include "file/kinds/tensor_io.h"
#include "temporal/film/cache.h"

namespace phos::inline temporal {

/// What is wrong with a life, nullptr: nothing. `before`: the life of the record before it, if there is one.
const char* what_is_wrong(const Life& life, const Life* before, const FilmInfo& film);

/// Lives as columns; must outlive the writer that they are added to.
struct LifeColumns {
  std::vector<std::int32_t> birth, end;
  std::vector<std::uint32_t> chain, anchor;
  std::vector<float> rate, uv, turn;
  bool moving = false;  ///< is any anchored?

  void append(const Life& life);
  void add_to(TensorWriter& file) const;
};
std::vector<Life> read_lives(const TensorReader& file);

/// A record that is alive at some frame, and the share of its place then.
struct Alive {
  std::size_t record;
  float share;
};
/// Those of n lives (in order, `life(i)`) that are at `frame`. Where a place has no records before or after,
/// its share grows or falls over film.fade frames, except where the film itself begins or ends.
std::vector<Alive> alive_at(std::size_t n, const std::function<const Life&(std::size_t)>& life,
                            const FilmInfo& film, std::int64_t frame);

/// A record at a frame of its life, with its weight: changed, moved with its surface, of this share. Nothing
/// where its surface has no area.
std::optional<IrradianceRecord> at_frame(const FilmRecord& record, float share, const FilmInfo& film,
                                         std::int64_t frame, const Scene& scene);
std::optional<RadianceRecord> at_frame(const FilmRadianceRecord& record, float share, const FilmInfo& film,
                                       std::int64_t frame, const Scene& scene);

/// The `film` object of a file's header, which read_film_info() reads.
Json film_header(const FilmInfo& film, const LifeColumns& lives);

}  // namespace phos::inline temporal
