#include "photon/caustic_map.h"

#include <algorithm>

#include "core/error.h"
#include "core/octahedral.h"
#include "photon/photon_file.h"

namespace phos::inline photon {
namespace {

constexpr const char* kFlights = "caustic_flight_";
/// A photon that came from above has at least this: directions are rounded (encode_octahedral).
constexpr float kLeastRise = -1e-4f;

template <class T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

}  // namespace

CausticPhotons caustics_of(const PhotonMap& photons) {
  CausticPhotons c;
  for (std::size_t i = 0; i < photons.size(); ++i) {
    if (!is_caustic(static_cast<PhotonPath>(photons.path[i]))) continue;
    c.position.push_back(photons.position[i]), c.flux.push_back(photons.flux[i]);
    c.direction.push_back(photons.direction[i]), c.normal.push_back(photons.normal[i]);
    c.distance.push_back(photons.distance[i]);
  }
  append(c.flights, photons.flights);
  if (photons.totals.emitted > 0)
    c.photon_lm = photons.totals.emitted_flux_lm / static_cast<float>(photons.totals.emitted);
  return c;
}

void add_columns(ContainerWriter& writer, const CausticPhotons& c) {
  if (c.size() > 0) {
    const Shape rows{c.size()};
    writer.add_vectors("caustic_position", c.position, "m");
    writer.add_vectors("caustic_flux", c.flux, "lm");
    writer.add<std::uint32_t>("caustic_direction", c.direction, rows, "octahedral");
    writer.add<std::uint32_t>("caustic_normal", c.normal, rows, "octahedral");
    writer.add<float>("caustic_distance", c.distance, rows, "m");
  }
  add_columns(writer, columns_of(c.flights), kFlights);
}

CausticPhotons read_caustics(const Container& file) {
  CausticPhotons c;
  if (file.has("caustic_position")) {
    const std::span<const Vec3> position = file.vectors("caustic_position"),
                                flux = file.vectors("caustic_flux");
    const std::uint64_t n = position.size();
    if (flux.size() != n)
      throw Error(ExitCode::bad_input, file.path(),
                  text("tensor \"caustic_flux\" has ", flux.size(), " rows, \"caustic_position\" has ", n,
                       "; make the file again"));
    c.position = copy(position), c.flux = copy(flux);
    c.direction = copy(file.values<std::uint32_t>("caustic_direction", {n}));
    c.normal = copy(file.values<std::uint32_t>("caustic_normal", {n}));
    c.distance = copy(file.values<float>("caustic_distance", {n}));
    const std::vector<std::uint8_t> path(n, static_cast<std::uint8_t>(PhotonPath::caustic));
    require_sound(
        PhotonColumns{c.position, c.flux, c.direction, c.normal, c.normal, c.distance, path, path, {}},
        file.path());
  }
  const FlightColumns flights = flights_of(file, kFlights);
  require_sound(flights, file.path());
  append(c.flights, flights);
  return c;
}

CausticMap::CausticMap(CausticPhotons photons) : photons_(std::move(photons)) {
  way_.resize(photons_.size());
  decode_octahedral(photons_.direction, way_);
  std::vector<Vec3> flown(photons_.flights.size());
  decode_octahedral(photons_.flights.direction, flown);
  way_.insert(way_.end(), flown.begin(), flown.end());
  tree_ = KdTree::build(photons_.position);
  DVec3 sum(0);
  for (const Rgb& f : photons_.flux) sum += DVec3(f);
  for (const Rgb& f : photons_.flights.flux) sum += DVec3(f);
  one_photon_lm_ = way_.empty() ? photons_.photon_lm : Rgb(sum / static_cast<double>(way_.size()));
}

namespace {

bool nearer(const CausticHit& a, const CausticHit& b) { return a.distance2_m2 < b.distance2_m2; }

}  // namespace

void CausticMap::crossing(const Vec3& p, const Vec3& n, std::size_t most, float& radius_m,
                          std::vector<CausticHit>& hits) const {
  hits.clear();
  const float radius2 = radius_m * radius_m;
  const std::size_t landed = photons_.size();
  for (std::size_t i = 0; i < way_.size(); ++i) {
    const bool ends = i < landed;
    const std::size_t flight = i - landed;
    const Vec3& from = ends ? photons_.position[i] : photons_.flights.from[flight];
    const Vec3& way = way_[i];
    // Light travels against `way` where it ends at a photon.
    const float facing = ends ? glm::dot(way, n) : -glm::dot(way, n);
    if (!(facing > 0)) continue;
    const float to_plane = glm::dot(p - from, n) * (ends ? 1.f : -1.f);
    const float length = ends ? photons_.distance[i] : photons_.flights.length[flight];
    if (!(to_plane >= 0) || !(to_plane <= length * facing)) continue;
    const Vec3 at = from + (to_plane / facing) * way;
    const Vec3 apart = at - p;
    const float distance2 = glm::dot(apart, apart);
    if (!(distance2 < radius2)) continue;
    CausticHit hit{distance2, ends ? photons_.flux[i] : photons_.flights.flux[flight], at, ends ? way : -way};
    if (ends) hit.photon = static_cast<std::uint32_t>(i);
    hits.push_back(hit);
  }
  if (hits.size() > most) {
    const auto next = hits.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(hits.begin(), next, hits.end(), nearer);
    radius_m = std::sqrt(next->distance2_m2);
    hits.erase(next, hits.end());
  }
  std::stable_sort(hits.begin(), hits.end(), nearer);
}

void CausticMap::landed(const Vec3& p, const Vec3& n, std::size_t k, float above_m, float below_m,
                        float& radius_m, Worker& worker, std::vector<CausticHit>& hits) const {
  hits.clear();
  tree_.nearest(p, k, worker.rows, worker.distance2_m2);
  if (worker.rows.size() == k) radius_m = std::min(radius_m, std::sqrt(worker.distance2_m2.back()));
  for (const std::uint32_t row : worker.rows) {
    const Vec3 apart = photons_.position[row] - p;
    const float height = glm::dot(apart, n);
    if (height > above_m || height < -below_m) continue;
    const Vec3 along = apart - height * n;
    const float distance2 = glm::dot(along, along);
    if (!(distance2 < radius_m * radius_m)) continue;
    const float facing = glm::dot(decode_octahedral(photons_.normal[row]), n);
    if (facing < kFacing || !(glm::dot(way_[row], n) > kLeastRise)) continue;
    hits.push_back({distance2, photons_.flux[row] * facing, photons_.position[row], way_[row]});
  }
  std::stable_sort(hits.begin(), hits.end(), nearer);
}

}  // namespace phos::inline photon
