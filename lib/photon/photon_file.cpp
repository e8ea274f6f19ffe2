#include "photon/photon_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/parallel.h"

namespace phos::inline photon {
namespace {

Json rgb(const Rgb& v) { return Json::Array{v.x, v.y, v.z}; }

Json sum(const FluxSum& s) { return Json::Array{s.units[0], s.units[1], s.units[2]}; }

// A header is text from outside: every look-up may fail, and then says where.
struct Reader {
  const Json& object;
  const std::string& path;

  const Json& member(const char* name) const {
    const Json* v = object.find(name);
    if (!v) fail(name);
    return *v;
  }
  std::int64_t integer(const char* name) const {
    const Json& v = member(name);
    if (!v.is_integer()) fail(name);
    return v.as_integer();
  }
  std::uint64_t natural(const char* name) const {
    const std::int64_t v = integer(name);
    if (v < 0) fail(name);
    return static_cast<std::uint64_t>(v);
  }
  FluxSum sum(const char* name) const {
    const Json& v = member(name);
    FluxSum result;
    if (!v.is_array() || v.as_array().size() != 3) fail(name);
    for (std::size_t c = 0; c < 3; ++c) {
      if (!v.as_array()[c].is_integer()) fail(name);
      result.units[c] = v.as_array()[c].as_integer();
    }
    return result;
  }
  [[noreturn]] void fail(const std::string& name) const {
    throw Error(ExitCode::bad_input, path,
                text("the header's totals lack a valid \"", name, "\"; make the file again"));
  }
};

}  // namespace

Rgb FluxSum::lm(int exponent) const {
  Rgb result;
  for (int c = 0; c < 3; ++c)
    result[c] =
        static_cast<float>(std::ldexp(static_cast<double>(units[static_cast<std::size_t>(c)]), exponent));
  return result;
}

void PhotonTotals::settle() {
  emitted_flux_lm = emitted_sum.lm(flux_exponent);
  stored_flux_lm = stored_sum.lm(flux_exponent);
  escaped_flux_lm = escaped_sum.lm(flux_exponent);
  absorbed_flux_lm = absorbed_sum.lm(flux_exponent);
}

PhotonColumns columns_of(const Photons& p) {
  return {p.position, p.flux, p.direction, p.normal, p.source_normal,
          p.distance, p.path, p.bounce,    p.family, columns_of(p.flights)};
}

FlightColumns columns_of(const Flights& f) { return {f.from, f.flux, f.direction, f.length}; }

FlightColumns flights_of(const TensorReader& file, const std::string& prefix) {
  if (!file.has(prefix + "from")) return {};
  return {file.vectors(prefix + "from"), file.vectors(prefix + "flux"),
          file.values<std::uint32_t>(prefix + "direction"), file.values<float>(prefix + "length")};
}

PhotonColumns columns_of(const Container& container) {
  const TensorReader file(container);
  return {file.vectors("position"),
          file.vectors("flux"),
          file.values<std::uint32_t>("direction"),
          file.values<std::uint32_t>("normal"),
          file.values<std::uint32_t>("source_normal"),
          file.values<float>("distance"),
          file.values<std::uint8_t>("path"),
          file.values<std::uint8_t>("bounce"),
          file.has("family") ? file.values<std::uint32_t>("family") : std::span<const std::uint32_t>(),
          flights_of(file, kFlightPrefix)};
}

void add_columns(TensorWriter& writer, const PhotonColumns& c) {
  writer.add_vectors("position", c.position);
  writer.add_vectors("flux", c.flux);
  writer.add<std::uint32_t>("direction", c.direction);
  writer.add<std::uint32_t>("normal", c.normal);
  writer.add<std::uint32_t>("source_normal", c.source_normal);
  writer.add<float>("distance", c.distance);
  writer.add<std::uint8_t>("path", c.path);
  writer.add<std::uint8_t>("bounce", c.bounce);
  if (!c.family.empty()) writer.add<std::uint32_t>("family", c.family);
  add_columns(writer, c.flights, kFlightPrefix);
}

void add_columns(TensorWriter& writer, const FlightColumns& c, const std::string& prefix) {
  if (c.size() == 0) return;
  writer.add_vectors(prefix + "from", c.from);
  writer.add_vectors(prefix + "flux", c.flux);
  writer.add<std::uint32_t>(prefix + "direction", c.direction);
  writer.add<float>(prefix + "length", c.length);
}

Json totals_to_json(const PhotonTotals& t) {
  Json j = Json::Object{};
  j["emitted"] = t.emitted;
  j["stored"] = t.stored;
  j["first_path"] = t.first_path;
  j["paths"] = t.paths;
  j["emitted_flux_lm"] = rgb(t.emitted_flux_lm);
  j["stored_flux_lm"] = rgb(t.stored_flux_lm);
  j["escaped_flux_lm"] = rgb(t.escaped_flux_lm);
  j["absorbed_flux_lm"] = rgb(t.absorbed_flux_lm);
  j["flux_exponent"] = t.flux_exponent;
  j["emitted_units"] = sum(t.emitted_sum);
  j["stored_units"] = sum(t.stored_sum);
  j["escaped_units"] = sum(t.escaped_sum);
  j["absorbed_units"] = sum(t.absorbed_sum);
  return j;
}

PhotonTotals totals_of(const Container& file, std::size_t rows) {
  const std::string& path = file.path();
  const Json* json = file.provenance().extra.find("totals");
  if (!json)
    throw Error(ExitCode::bad_input, path, "the header has no totals; make the file again with phos-photons");
  const Reader r{*json, path};
  PhotonTotals t;
  t.emitted = r.natural("emitted"), t.stored = r.natural("stored");
  t.first_path = r.natural("first_path"), t.paths = r.natural("paths");
  const std::int64_t exponent = r.integer("flux_exponent");
  if (exponent < -2000 || exponent > 2000) r.fail("flux_exponent");
  t.flux_exponent = static_cast<int>(exponent);
  t.emitted_sum = r.sum("emitted_units"), t.stored_sum = r.sum("stored_units");
  t.escaped_sum = r.sum("escaped_units"), t.absorbed_sum = r.sum("absorbed_units");
  if (t.stored != rows) r.fail("stored");
  if (t.first_path > t.emitted || t.paths > t.emitted - t.first_path) r.fail("paths");
  t.settle();
  return t;
}

namespace {

void add(FluxSum& sum, const FluxSum& more) {
  for (std::size_t c = 0; c < 3; ++c)
    if (__builtin_add_overflow(sum.units[c], more.units[c], &sum.units[c]))
      throw Error(ExitCode::bad_input, "",
                  "the shards' totals of flux are greater than any run's; make the shards again");
}

}  // namespace

void add_totals(PhotonTotals& totals, const PhotonTotals& other) {
  PHOS_CHECK(totals.flux_exponent == other.flux_exponent, totals.flux_exponent, " and ", other.flux_exponent);
  totals.stored += other.stored;
  totals.paths += other.paths;
  add(totals.emitted_sum, other.emitted_sum), add(totals.stored_sum, other.stored_sum);
  add(totals.escaped_sum, other.escaped_sum), add(totals.absorbed_sum, other.absorbed_sum);
  totals.settle();
}

Json bounds_to_json(std::span<const Vec3> position) {
  return bounds_to_json(parallel_reduce<Bounds>(
      position.size(), 1 << 16, {},
      [&](std::size_t begin, std::size_t end) {
        Bounds part;
        for (std::size_t i = begin; i < end; ++i) part.include(position[i]);
        return part;
      },
      [](Bounds& all, const Bounds& part) { all.include(part.lo), all.include(part.hi); }));
}

Json bounds_to_json(const Bounds& bounds) {
  if (bounds.empty()) return {};
  Json j = Json::Object{};
  j["lo"] = rgb(bounds.lo);
  j["hi"] = rgb(bounds.hi);
  return j;
}

void describe_map(Provenance& provenance, const PhotonTotals& totals, Json bounds_m) {
  provenance.extra["totals"] = totals_to_json(totals);
  provenance.extra["bounds_m"] = std::move(bounds_m);
}

void append(Photons& to, const Photons& from) {
  for_columns([](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); }, to, from);
  to.family.insert(to.family.end(), from.family.begin(), from.family.end());
  append(to.flights, columns_of(from.flights));
}

void append(Flights& to, const FlightColumns& from) {
  const auto join = [](auto& a, const auto& b) { a.insert(a.end(), b.begin(), b.end()); };
  join(to.from, from.from), join(to.flux, from.flux);
  join(to.direction, from.direction), join(to.length, from.length);
}

}  // namespace phos::inline photon
