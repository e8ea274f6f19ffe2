// Irradiance files of random records, with an index of the test's own.
#pragma once

#include <string>

#include "core/random.h"
#include "core/sampling.h"
#include "record/index.h"
#include "support/run.h"

namespace phos::test {

inline IrradianceCache random_cache(std::size_t n) {
  IrradianceCache cache;
  cache.accuracy = 0.5;
  cache.scene_hash = "none";
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(3, Stage::test, i);
    IrradianceRecord r;
    r.position = {random.uniform(), random.uniform(), random.uniform()};
    r.normal = sample_uniform_sphere(random.uniform2());
    r.irradiance = 100.f * Vec3(random.uniform(), random.uniform(), random.uniform());
    r.stderr_lx = 0.1f * r.irradiance;
    r.distance_m = r.radius_m = std::pow(10.f, -1.5f * random.uniform());
    for (Vec3& g : r.rotation_gradient) g = sample_uniform_sphere(random.uniform2());
    for (Vec3& g : r.translation_gradient) g = 10.f * sample_uniform_sphere(random.uniform2());
    cache.records.push_back(r);
  }
  return cache;
}

inline Provenance irradiance_provenance() {
  Provenance p;
  p.tool = "test", p.command = "test", p.parameters = Json::Object{}, p.extra = Json::Object{};
  p.key = "none";
  return p;
}

/// The records of `from` with this index, checksums and all, to another file.
inline void write_indexed(const std::string& to, const std::string& from, const RecordIndex& index) {
  const Container file = Container::open(from, FileKind::irradiance);
  TensorWriter writer(FileKind::irradiance);
  for (const auto& [name, tensor] : file.tensors())
    writer.add<float>(name, file.values<float>(name, tensor.shape));
  add_index(writer, index);
  Provenance provenance = file.provenance();
  provenance.extra[kIndexAccuracy] = reading_accuracy(provenance.extra["accuracy"].as_number());
  writer.write(to, provenance);
}

}  // namespace phos::test
