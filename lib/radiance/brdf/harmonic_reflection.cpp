#include "radiance/brdf/harmonic_reflection.h"

#include <cmath>
#include <vector>

namespace phos::inline radiance {

namespace {

BrdfTable table_of(const Scene& scene, std::uint32_t material, const ReflectionHarmonics& through,
                   Counters& counters) {
  const BrdfTableOptions options{
      .error = 0, .max_order = through.order, .resolution = through.resolution, .too_sharp = TooSharp::cut};
  return project_brdf(scene, material, options, counters,
                      {.basis = through.basis, .whole = true, .cosine = through.cosine});
}

}  // namespace

HarmonicReflection::HarmonicReflection(const Scene& scene, std::uint32_t material,
                                       const ReflectionHarmonics& through, Counters& counters)
    : through_(through), table_(table_of(scene, material, through, counters)), basis_(through.order) {
  if (through.rotation && through.basis == BasisKind::hsh)
    rotator_.emplace(through.order, *through.rotation, kPi / 2);
}

std::vector<float> HarmonicReflection::harmonics_of_light(const Vec3& wi) const {
  const auto count = static_cast<std::size_t>(basis_.count());
  std::vector<float> light(count);
  if (!rotator_) {
    basis_.evaluate(through_.basis, wi.x, wi.y, wi.z, light.data());
    return light;
  }
  std::vector<float> pole(count);
  basis_.evaluate(BasisKind::hsh, 0, 0, 1, pole.data());
  rotator_->rotate(rotation_angles(make_frame(wi), Frame()), pole, light);
  return light;
}

std::optional<Rgb> HarmonicReflection::operator()(const Vec3& wo, const Vec3& wi) const {
  const BrdfLookup lookup(table_);
  if (lookup.order(wo) == 0) return {};
  const std::vector<float> light = harmonics_of_light(wi);
  std::vector<float> incident;
  incident.reserve(3 * light.size());
  for (const float v : light) incident.insert(incident.end(), 3, v);
  return lookup.outgoing(wo, incident) * (through_.cosine ? 1.f : wi.z);
}

}  // namespace phos::inline radiance
