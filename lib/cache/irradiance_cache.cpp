#include "cache/irradiance_cache.h"

#include <algorithm>

#include "core/error.h"

namespace phos {
namespace {

std::span<const float> flat(const std::vector<Vec3>& v) {
  return {reinterpret_cast<const float*>(v.data()), 3 * v.size()};
}

[[noreturn]] void reject(const Container& file, std::size_t row, const std::string& what) {
  throw Error(ExitCode::bad_input, file.path(),
              text("record ", row, " has ", what,
                   "; the file is damaged or was made by a faulty program: make it again"));
}

bool row_is_finite(const IrradianceRecord& r) {
  bool finite =
      is_finite(r.position) && is_finite(r.normal) && is_finite(r.irradiance) && is_finite(r.stderr_lx);
  for (int c = 0; c < 3; ++c) {
    finite = finite && is_finite(r.rotation_gradient[c]) && is_finite(r.translation_gradient[c]);
  }
  return finite && std::isfinite(r.radius_m) && !std::isnan(r.distance_m);
}

void check_row(const Container& file, std::size_t row, const IrradianceRecord& r) {
  if (!row_is_finite(r)) reject(file, row, "a value that is not finite");
  if (!(r.radius_m > 0) || !(r.distance_m >= 0)) reject(file, row, "a radius that is not positive");
  if (std::fabs(glm::length(r.normal) - 1) > 1e-3f) reject(file, row, "a normal that is not of unit length");
  if (glm::any(glm::lessThan(r.irradiance, Vec3(0)))) reject(file, row, "negative irradiance");
}

}  // namespace

bool record_in_front(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  if (!(glm::dot(n, r.normal) > 0)) return true;
  return glm::dot(p - r.position, n + r.normal) * 0.5f < -kFrontTolerance * r.radius_m;
}

Rgb extrapolate(const IrradianceRecord& r, const Vec3& p, const Vec3& n) {
  const Vec3 turn = glm::cross(r.normal, n), step = p - r.position;
  Rgb e;
  for (int c = 0; c < 3; ++c) {
    const float value =
        r.irradiance[c] + glm::dot(turn, r.rotation_gradient[c]) + glm::dot(step, r.translation_gradient[c]);
    e[c] = std::min(std::max(value, 0.f), kGrowthLimit * r.irradiance[c]);
  }
  return e;
}

void write_irradiance(const std::string& path, const IrradianceCache& cache, Provenance provenance) {
  const std::size_t n = cache.records.size();
  std::vector<Vec3> position(n), normal(n), irradiance(n), error(n), rotation(3 * n), translation(3 * n);
  std::vector<float> distance(n), radius(n);
  for (std::size_t i = 0; i < n; ++i) {
    const IrradianceRecord& r = cache.records[i];
    PHOS_CHECK(row_is_finite(r) && r.radius_m > 0, "record ", i, " radius ", r.radius_m);
    position[i] = r.position, normal[i] = r.normal, irradiance[i] = r.irradiance, error[i] = r.stderr_lx;
    distance[i] = r.distance_m, radius[i] = r.radius_m;
    for (std::size_t c = 0; c < 3; ++c) {
      rotation[3 * i + c] = r.rotation_gradient[c], translation[3 * i + c] = r.translation_gradient[c];
    }
  }
  ContainerWriter file;
  file.add_vectors("position", position, "m");
  file.add_vectors("normal", normal, "1");
  file.add_vectors("irradiance", irradiance, "lx");
  file.add_vectors("stderr", error, "lx");
  file.add<float>("distance", distance, {n}, "m");
  file.add<float>("radius", radius, {n}, "m");
  file.add<float>("rotation_gradient", flat(rotation), {n, 3, 3}, "lx/rad");
  file.add<float>("translation_gradient", flat(translation), {n, 3, 3}, "lx/m");
  provenance.kind = "irradiance";
  provenance.scene_hash = cache.scene_hash;
  provenance.extra["accuracy"] = cache.accuracy;
  provenance.extra["quantity"] = cache.quantity;
  provenance.extra["records"] = n;
  file.write(path, provenance);
}

IrradianceCache read_irradiance(const Container& file) {
  if (file.provenance().kind != "irradiance") {
    throw Error(
        ExitCode::bad_input, file.path(),
        text("holds ", file.provenance().kind, ", not irradiance; give the output of phos-irradiance"));
  }
  file.verify();
  const auto position = file.vectors("position");
  const std::uint64_t n = position.size();
  const auto column = [&](const char* name, const Shape& shape) {
    return file.values<float>(name, shape).data();
  };
  const float* normal = column("normal", {n, 3});
  const float* irradiance = column("irradiance", {n, 3});
  const float* error = column("stderr", {n, 3});
  const float* distance = column("distance", {n});
  const float* radius = column("radius", {n});
  const float* rotation = column("rotation_gradient", {n, 3, 3});
  const float* translation = column("translation_gradient", {n, 3, 3});

  IrradianceCache cache;
  cache.scene_hash = file.provenance().scene_hash;
  const Json *accuracy = file.provenance().extra.find("accuracy"),
             *quantity = file.provenance().extra.find("quantity");
  if (!accuracy || !accuracy->is_number() || !(accuracy->as_number() > 0) || !quantity ||
      !quantity->is_string()) {
    throw Error(ExitCode::bad_input, file.path(),
                "its header does not say accuracy and quantity; make the file again");
  }
  cache.accuracy = accuracy->as_number();
  cache.quantity = quantity->as_string();
  cache.records.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const auto vector = [i](const float* v, std::size_t rows = 1, std::size_t row = 0) {
      const float* x = v + 3 * (rows * i + row);
      return Vec3(x[0], x[1], x[2]);
    };
    IrradianceRecord& r = cache.records[i];
    r.position = position[i], r.normal = vector(normal);
    r.irradiance = vector(irradiance), r.stderr_lx = vector(error);
    r.distance_m = distance[i], r.radius_m = radius[i];
    for (std::size_t c = 0; c < 3; ++c) {
      r.rotation_gradient[c] = vector(rotation, 3, c), r.translation_gradient[c] = vector(translation, 3, c);
    }
    check_row(file, i, r);
  }
  return cache;
}

}  // namespace phos
