#include "record/irradiance_cache.h"

#include <algorithm>

#include "core/error.h"
#include "core/float_traps.h"
#include "file/shards.h"
#include "photon/caustic_map.h"
#include "record/check.h"
#include "record/footprint_columns.h"
#include "record/index.h"
#include "scene/rays.h"
#include "scene/receiver.h"

namespace phos::inline record {
namespace {

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
  const NoFloatTraps traps;  // files may hold numbers that are not finite
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

/// p raised along n by `most_m`, but no more than halfway to the surface above.
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
  PHOS_CHECK(all.quantity == more.quantity, name_of(all.quantity), " and ", name_of(more.quantity), " light");
  PHOS_CHECK(!all.caustics == !more.caustics || more.records.empty(), "caustic light apart and within");
  const auto reach = static_cast<float>(more.accuracy / all.accuracy);
  for (IrradianceRecord r : more.records) {
    r.radius_m *= reach;
    all.records.push_back(r);
  }
}

void require_form(FileForm form, const Container& file) {
  const FileForm found = file.form();
  if (found == form) return;
  if (found == FileForm::part)
    throw Error(ExitCode::bad_input, file.path(),
                text("is part ", share_of(file),
                     " of a run; join all its parts first: phos-merge PART... -o ALL.irradiance"));
  if (found == FileForm::film)
    throw Error(ExitCode::bad_input, file.path(),
                "is a film, with records for different frames; give a cache of one frame (phos-irradiance, "
                "phos-radiance), or give the film to a program that reads films, such as phos-splat");
  throw Error(ExitCode::bad_input, file.path(),
              form == FileForm::part ? "is not a part of a run; give files made with --part k/n"
                                     : "is not a film; give the output of phos-temporal");
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
                   "; make all caches anew with this version of phos, all from photons"));
}

void add_caustics(const std::shared_ptr<const CausticPhotons>& caustics, TensorWriter& file,
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
      throw Error(ExitCode::bad_input, file.path(),
                  text("its header has no valid \"", kPhoton, "\" of \"", kCausticLight, "\"; make it anew"));
    photons->photon_lm[static_cast<int>(c)] = static_cast<float>(one->as_array()[c].as_number());
  }
  return photons;
}

void write_irradiance(const std::string& path, const IrradianceCache& cache, Provenance provenance,
                      std::span<const float> least_radius_m, TensorWriter file) {
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
  file.add_vectors("position", position);
  file.add_vectors("normal", normal);
  file.add_vectors("irradiance", irradiance);
  file.add_vectors("stderr", error);
  file.add<float>("distance", distance);
  file.add<float>("radius", radius);
  file.add_vectors("rotation_gradient", rotation);
  file.add_vectors("translation_gradient", translation);
  if (std::any_of(shared.begin(), shared.end(), [](float s) { return s != kSharedByZones; }))
    file.add<float>("shared", shared);
  const FootprintColumns footprints(cache.records);
  footprints.add_to(file);
  RecordIndex index;
  const FileForm form = form_of(provenance.extra);
  if (form == FileForm::part) {
    file.add<float>("least_radius", least_radius_m);
  } else if (n >= kIndexedRecords && form != FileForm::film) {
    index = index_records(cache.records, reading_accuracy(cache.accuracy));
    add_index(file, index);
    provenance.extra[kIndexAccuracy] = reading_accuracy(cache.accuracy);
  }
  add_caustics(cache.caustics, file, provenance);
  provenance.scene_hash = cache.scene_hash;
  provenance.extra[kAccuracyEntry] = cache.accuracy;
  provenance.extra[kQuantityEntry] = name_of(cache.quantity);
  provenance.extra["records"] = n;
  file.write(path, provenance);
}

RecordColumns::RecordColumns(const Container& file, FileForm form) : file_(file) {
  if (file.kind() != FileKind::irradiance)
    throw Error(ExitCode::bad_input, file.path(),
                text("holds ", name_of(file.kind()), ", not irradiance; give the output of phos-irradiance"));
  require_form(form, file);
  file.require_sound();
  const TensorReader tensors(file);
  const auto column = [&](const char* name) { return tensors.values<float>(name).data(); };
  size_ = static_cast<std::size_t>(tensors.extent("n"));
  position_ = column("position"), normal_ = column("normal");
  irradiance_ = column("irradiance"), stderr_ = column("stderr");
  distance_ = column("distance"), radius_ = column("radius");
  rotation_ = column("rotation_gradient"), translation_ = column("translation_gradient");
  if (tensors.has("shared")) shared_ = column("shared");
  footprints_ = read_footprints(tensors, tensors.vectors("normal"));
  const std::optional<double> accuracy = accuracy_of(file);
  const std::optional<Quantity> quantity = quantity_of(file);
  if (!accuracy || !quantity)
    throw Error(ExitCode::bad_input, file.path(),
                "its header does not say accuracy and quantity; make the file again");
  accuracy_ = *accuracy, quantity_ = *quantity;
  for (std::size_t i = 0; i < footprints_.size(); ++i)
    if (const char* wrong = what_is_wrong(*footprints_[i], normal(i)))
      throw Error(ExitCode::bad_input, file.path(),
                  text("record ", i, " has ", wrong,
                       "; the file is damaged or was made by a faulty program: make it again"));
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
