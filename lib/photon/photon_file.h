// How photons lie in files: columns, totals, shards and their union.
#pragma once

#include <string>
#include <vector>

#include "file/kinds/tensor_io.h"
#include "photon/photon_map.h"

namespace phos::inline photon {

/// Read-only columns, wherever they lie.
struct PhotonColumns {
  std::span<const Vec3> position;
  std::span<const Rgb> flux;
  std::span<const std::uint32_t> direction, normal, source_normal;
  std::span<const float> distance;
  std::span<const std::uint8_t> path, bounce;
  std::span<const std::uint32_t> family;  // empty where paths do not part
  FlightColumns flights;
};
FlightColumns columns_of(const Flights& flights);
PhotonColumns columns_of(const Photons& photons);
/// Columns of an open file, in place. Throws Error(bad_input) for a column that is absent or of another
/// length. Container::require_sound() looks at the photons.
PhotonColumns columns_of(const Container& file);
void add_columns(TensorWriter& writer, const PhotonColumns& columns);

/// The same of flights, whose tensors are named `prefix`from, `prefix`flux and so on, and are absent where
/// there are none.
FlightColumns flights_of(const TensorReader& file, const std::string& prefix);
void add_columns(TensorWriter& writer, const FlightColumns& columns, const std::string& prefix);
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
Json bounds_to_json(const Bounds& bounds);
/// What a header says of a map or shard.
void describe_map(Provenance& provenance, const PhotonTotals& totals, Json bounds_m);

/// Adds the rows of `from` behind the rows of `to`.
void append(Photons& to, const Photons& from);
void append(Flights& to, const FlightColumns& from);

}  // namespace phos::inline photon
