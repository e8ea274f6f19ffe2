#include "record/irradiance_cache.h"

#include <algorithm>

#include "core/error.h"
#include "core/float_traps.h"
#include "core/parallel.h"
#include "record/check.h"
#include "record/footprint_columns.h"
#include "record/index.h"
#include "scene/receiver.h"

namespace phos::inline record {
namespace {

std::span<const float> flat(const std::vector<Vec3>& v) {
  return {reinterpret_cast<const float*>(v.data()), 3 * v.size()};
}

bool row_is_finite(const IrradianceRecord& r) {
  bool finite = is_finite(r.position) && is_finite(r.normal) && is_finite(r.irradiance) &&
                is_finite(r.stderr_lx) && std::isfinite(r.shared);
  for (int c = 0; c < 3; ++c) {
    finite = finite && is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]);
  }
  return finite && std::isfinite(r.radius_m) && !std::isnan(r.distance_m);
}

}  // namespace

const char* what_is_wrong(const IrradianceRecord& r) {
  const NoFloatTraps traps;  // files may hold what is not a number
  if (!row_is_finite(r)) return "a value that is not finite";
  if (!(r.radius_m > 0) || !(r.distance_m >= 0)) return "a radius that is not positive";
  if (std::fabs(glm::length(r.normal) - 1) > 1e-3f) return "a normal that is not of unit length";
  if (glm::any(glm::lessThan(r.irradiance, Vec3(0)))) return "negative irradiance";
  if (!(r.shared >= 0 && r.shared <= 1)) return "a shared part of the variance outside of 0 .. 1";
  if (r.footprint) return what_is_wrong(*r.footprint, r.normal);
  return nullptr;
}

bool record_apart(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  return weight_if_lit(1, p - r.position, n, r.normal, -kFrontTolerance * r.radius_m,
                       over_limit_m(r.distance_m, r.radius_m)) == 0;
}

namespace {

bool clear_between(const RayScene& rays, const Vec3& from, const Vec3& to) {
  const Vec3 direction = normalized_or_zero(to - from);
  return direction == Vec3(0) || !rays.occluded({from, direction, 0, glm::dot(to - from, direction)});
}

/// p raised along n by `most_m`, but no more than halfway to what is above it.
Vec3 raised(const RayScene& rays, const Vec3& p, const Vec3& n, float most_m) {
  Hit hit;
  if (rays.intersect({p, n, 0, 2 * most_m}, hit)) most_m = 0.5f * hit.distance_m;
  return p + most_m * n;
}

}  // namespace

bool record_in_sight(const RayScene& rays, const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  const float apart_m = glm::length(p - r.position), turn = glm::length(n - r.normal);
  // Two pieces of length d/2 at an angle t: the ridge is d tan(t/2) / 2 above the chord, and a raised end
  // gains cos(t/2) of its lift.
  const float ridge_m = apart_m * turn / (2 * std::max(1 + glm::dot(n, r.normal), 1.f));
  const float lift_m = receiver(rays.scene(), p, n).error_m + ridge_m;
  const Vec3 from = p + lift_m * n, to = r.position + lift_m * r.normal;
  if (clear_between(rays, from, to)) return true;
  // Smooth normals hide how rough the facets are: a second look from higher up.
  const float more_m = kRoughness * apart_m;
  return clear_between(rays, raised(rays, from, n, more_m), raised(rays, to, r.normal, more_m));
}

bool any_footprint(std::span<const IrradianceRecord> records) {
  return std::any_of(records.begin(), records.end(),
                     [](const IrradianceRecord& r) { return r.footprint != nullptr; });
}

void append(IrradianceCache& all, const IrradianceCache& more) {
  PHOS_CHECK(all.quantity == more.quantity, all.quantity, " and ", more.quantity, " light");
  PHOS_CHECK(!all.caustics == !more.caustics || more.records.empty(), "caustic light apart and within");
  const auto reach = static_cast<float>(more.accuracy / all.accuracy);
  for (IrradianceRecord r : more.records) {
    r.radius_m *= reach;
    all.records.push_back(r);
  }
}

RecordsOf records_of(const Container& file) {
  const Json& header = file.provenance().extra;
  return header.find("part") ? RecordsOf::part : header.find("film") ? RecordsOf::film : RecordsOf::cache;
}

void require_records_of(RecordsOf of, const Container& file) {
  const RecordsOf found = records_of(file);
  if (found == of) return;
  if (found == RecordsOf::part) {
    const Json* name = file.provenance().extra.find("part");
    throw Error(ExitCode::bad_input, file.path(),
                text("is part ", name->is_string() ? name->as_string() : "?",
                     " of a run; join all its parts first: phos-merge PART... -o ALL.irradiance"));
  }
  if (found == RecordsOf::film)
    throw Error(ExitCode::bad_input, file.path(),
                "is of a film, with records for different frames; give a cache of one scene "
                "(phos-irradiance, phos-radiance), or use the film where it is read, as by phos-splat");
  throw Error(ExitCode::bad_input, file.path(),
              of == RecordsOf::part ? "is no part of a run; give files made with --part k/n"
                                    : "is of no film; give the output of phos-temporal");
}

namespace {

// Entries of a header.
constexpr const char *kCausticLight = "caustic_light", *kPhoton = "photon_lm";

}  // namespace

void require_same_caustics(bool apart, bool other_apart, const std::string& where) {
  if (apart == other_apart) return;
  throw Error(ExitCode::mismatch, where,
              text("holds light of mirrors and glass ", apart ? "as photons" : "in its records",
                   ", and another cache ", other_apart ? "as photons" : "in its records",
                   "; make all of them anew with this version, all from photons"));
}

void add_caustics(const std::shared_ptr<const CausticPhotons>& caustics, ContainerWriter& file,
                  Provenance& provenance) {
  if (!caustics) return;
  add_columns(file, *caustics);
  const Rgb& one = caustics->photon_lm;
  provenance.extra[kCausticLight][kPhoton] = Json::Array{one.x, one.y, one.z};
}

std::shared_ptr<const CausticPhotons> caustics_of(const Container& file) {
  const Json* said = file.provenance().extra.find(kCausticLight);
  if (!said) return nullptr;
  auto photons = std::make_shared<CausticPhotons>(read_caustics(file));
  const Json* one = said->is_object() ? said->find(kPhoton) : nullptr;
  for (std::size_t c = 0; c < 3; ++c) {
    const bool sound =
        one && one->is_array() && one->as_array().size() == 3 && one->as_array()[c].is_number();
    if (!sound)
      throw Error(
          ExitCode::bad_input, file.path(),
          text("its header does not rightly say \"", kPhoton, "\" of \"", kCausticLight, "\"; make it anew"));
    photons->photon_lm[static_cast<int>(c)] = static_cast<float>(one->as_array()[c].as_number());
  }
  return photons;
}

void write_irradiance(const std::string& path, const IrradianceCache& cache, Provenance provenance,
                      std::span<const float> least_radius_m, ContainerWriter file) {
  const std::size_t n = cache.records.size();
  std::vector<Vec3> position(n), normal(n), irradiance(n), error(n), rotation(3 * n), translation(3 * n);
  std::vector<float> distance(n), radius(n), shared(n);
  for (std::size_t i = 0; i < n; ++i) {
    const IrradianceRecord& r = cache.records[i];
    PHOS_CHECK(row_is_finite(r) && r.radius_m > 0, "record ", i, " radius ", r.radius_m);
    position[i] = r.position, normal[i] = r.normal, irradiance[i] = r.irradiance, error[i] = r.stderr_lx;
    distance[i] = r.distance_m, radius[i] = r.radius_m, shared[i] = r.shared;
    for (std::size_t c = 0; c < 3; ++c) {
      rotation[3 * i + c] = r.rotation_gradient[c], translation[3 * i + c] = r.translation_gradient[c];
    }
  }
  file.add_vectors("position", position, "m");
  file.add_vectors("normal", normal, "1");
  file.add_vectors("irradiance", irradiance, "lx");
  file.add_vectors("stderr", error, "lx");
  file.add<float>("distance", distance, {n}, "m");
  file.add<float>("radius", radius, {n}, "m");
  file.add<float>("rotation_gradient", flat(rotation), {n, 3, 3}, "lx/rad");
  file.add<float>("translation_gradient", flat(translation), {n, 3, 3}, "lx/m");
  if (std::any_of(shared.begin(), shared.end(), [](float s) { return s != kSharedByZones; }))
    file.add<float>("shared", shared, {n}, "1");
  const FootprintColumns footprints(cache.records);
  footprints.add_to(file);
  RecordIndex index;
  if (provenance.extra.find("part")) {
    file.add<float>("least_radius", least_radius_m, {n}, "m");
  } else if (n >= kIndexedRecords && !provenance.extra.find("film")) {
    index = index_records(cache.records, reading_accuracy(cache.accuracy));
    add_index(file, index);
    provenance.extra[kIndexAccuracy] = reading_accuracy(cache.accuracy);
  }
  add_caustics(cache.caustics, file, provenance);
  provenance.kind = "irradiance";
  provenance.scene_hash = cache.scene_hash;
  provenance.extra["accuracy"] = cache.accuracy;
  provenance.extra["quantity"] = cache.quantity;
  provenance.extra["records"] = n;
  file.write(path, provenance);
}

RecordColumns::RecordColumns(const Container& file, RecordsOf of) : file_(file) {
  if (file.provenance().kind != "irradiance") {
    throw Error(
        ExitCode::bad_input, file.path(),
        text("holds ", file.provenance().kind, ", not irradiance; give the output of phos-irradiance"));
  }
  require_records_of(of, file);
  file.verify();
  const std::uint64_t n = file.vectors("position").size();
  const auto column = [&](const char* name, const Shape& shape) {
    return file.values<float>(name, shape).data();
  };
  size_ = n;
  position_ = column("position", {n, 3});
  normal_ = column("normal", {n, 3});
  irradiance_ = column("irradiance", {n, 3});
  stderr_ = column("stderr", {n, 3});
  distance_ = column("distance", {n});
  radius_ = column("radius", {n});
  rotation_ = column("rotation_gradient", {n, 3, 3});
  translation_ = column("translation_gradient", {n, 3, 3});
  if (file.has("shared")) shared_ = column("shared", {n});
  footprints_ = read_footprints(file, file.vectors("normal"));
  const Json *accuracy = file.provenance().extra.find("accuracy"),
             *quantity = file.provenance().extra.find("quantity");
  if (!accuracy || !accuracy->is_number() || !(accuracy->as_number() > 0) || !quantity ||
      !quantity->is_string()) {
    throw Error(ExitCode::bad_input, file.path(),
                "its header does not say accuracy and quantity; make the file again");
  }
  accuracy_ = accuracy->as_number();
  quantity_ = quantity->as_string();
  // In chunks, the first bad row wins: the same message for any number of threads.
  const auto first_bad = parallel_reduce<std::size_t>(
      n, 1 << 14, n,
      [&](std::size_t begin, std::size_t end) {
        while (begin < end && what_is_wrong((*this)[begin]) == nullptr) ++begin;
        return begin < end ? begin : n;
      },
      [](std::size_t& least, std::size_t part) { least = std::min(least, part); });
  if (first_bad < n) {
    throw Error(ExitCode::bad_input, file.path(),
                text("record ", first_bad, " has ", what_is_wrong((*this)[first_bad]),
                     "; the file is damaged or was made by a faulty program: make it again"));
  }
}

IrradianceRecord RecordColumns::operator[](std::size_t i) const {
  IrradianceRecord r;
  r.position = position(i), r.normal = normal(i);
  r.irradiance = vector(irradiance_, i), r.stderr_lx = vector(stderr_, i);
  r.distance_m = distance_[i], r.radius_m = radius_[i];
  if (shared_) r.shared = shared_[i];
  if (!footprints_.empty()) r.footprint = footprints_[i];
  for (std::size_t c = 0; c < 3; ++c) {
    r.rotation_gradient[c] = vector(rotation_, 3 * i + c);
    r.translation_gradient[c] = vector(translation_, 3 * i + c);
  }
  return r;
}

IrradianceCache RecordColumns::cache() const {
  IrradianceCache cache;
  cache.scene_hash = file_.provenance().scene_hash;
  cache.accuracy = accuracy_;
  cache.quantity = quantity_;
  cache.caustics = caustics_of(file_);
  cache.records.reserve(size_);
  for (std::size_t i = 0; i < size_; ++i) cache.records.push_back((*this)[i]);
  return cache;
}

IrradianceCache read_irradiance(const Container& file) { return RecordColumns(file).cache(); }

}  // namespace phos::inline record
