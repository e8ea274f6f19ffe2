// How photons lie in files: columns, totals, shards and their union.
#pragma once

#include <string>
#include <vector>

#include "file/container.h"
#include "photon/photon_map.h"

namespace phos::inline photon {

/// Read-only columns, wherever they lie.
struct PhotonColumns {
  std::span<const Vec3> position;
  std::span<const Rgb> flux;
  std::span<const std::uint32_t> direction, normal, source_normal;
  std::span<const float> distance;
  std::span<const std::uint8_t> path, bounce;
  FlightColumns flights;
};
FlightColumns columns_of(const Flights& flights);
PhotonColumns columns_of(const Photons& photons);
/// Columns of an open file, in place. Throws Error(bad_input) for a column that is absent or of another
/// length.
PhotonColumns columns_of(const Container& file);
/// Throws Error(bad_input) for the first photon that cannot be: nowhere in space, of no finite flux, from a
/// negative distance, or of an unknown path.
void require_sound(const PhotonColumns& columns, const std::string& path);
void add_columns(ContainerWriter& writer, const PhotonColumns& columns);

/// The same of flights, whose tensors are named `prefix`from, `prefix`flux and so on, and are absent where
/// there are none.
FlightColumns flights_of(const Container& file, const std::string& prefix);
void require_sound(const FlightColumns& columns, const std::string& path);
void add_columns(ContainerWriter& writer, const FlightColumns& columns, const std::string& prefix);
/// The prefix in a file of photons.
inline constexpr const char* kFlightPrefix = "flight_";

Json totals_to_json(const PhotonTotals& totals);
/// Throws Error(bad_input) if the header has no totals, or they contradict the number of rows.
PhotonTotals totals_of(const Container& file, std::size_t rows);
/// Joins the sums and counts of two disjoint sets of paths of the same run. Throws Error(bad_input) if they
/// are greater than 64 bits hold.
void add_totals(PhotonTotals& totals, const PhotonTotals& other);
/// {"lo":[x,y,z],"hi":[x,y,z]} in m; null without photons.
Json bounds_to_json(std::span<const Vec3> position);

/// Adds the rows of `from` behind those of `to`.
void append(Photons& to, const Photons& from);
void append(Flights& to, const FlightColumns& from);

/// Every shard of one run, each once, in any order.
struct MergedShards {
  Photons photons;  ///< in path order
  PhotonTotals totals;
  Provenance provenance;  ///< of the whole run
};
/// Throws Error(mismatch) for shards of different runs, a shard given twice, or one that is missing (naming
/// it); Error(bad_input) for damaged files and for files that are no shards.
MergedShards read_shards(const std::vector<std::string>& paths);
/// The key of the whole run's file, by the headers alone; makes the same checks of what belongs together.
std::string key_of_merged(const std::vector<std::string>& paths);

}  // namespace phos::inline photon
