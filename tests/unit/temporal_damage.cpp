// Every tensor of every kind of file, damaged in each way that the table of its kind excludes, is refused by
// the reader with the tensor's name.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

#include "file/kinds/tables.h"
#include "file/kinds/tensor_io.h"
#include "photon/caustic_map.h"
#include "photon/photon_map.h"
#include "radiance/brdf/file.h"
#include "radiance/brdf/table.h"
#include "record/footprint.h"
#include "support/complaint.h"
#include "support/films.h"
#include "temporal/film/file.h"

namespace phos {
namespace {

std::shared_ptr<const CausticPhotons> some_caustics() {
  auto c = std::make_shared<CausticPhotons>();
  c->position = {{1, 2, 3}, {4, 5, 6}}, c->flux = {Rgb(1), Rgb(2)};
  c->direction = c->normal = {encode_octahedral({0, 1, 0}), encode_octahedral({1, 0, 0})};
  c->distance = {1, kInfinity};
  c->flights = {{Vec3(1)}, {Rgb(4)}, {encode_octahedral({0, 0, 1})}, {kInfinity}};
  return c;
}

void write_photons(const std::string& path, Provenance provenance) {
  Photons p;
  for (int i = 0; i < 5; ++i) {
    p.position.push_back(Vec3(static_cast<float>(i), 1, 2)), p.flux.push_back(Rgb(1));
    p.direction.push_back(encode_octahedral({0, 1, 0})), p.normal.push_back(encode_octahedral({0, 1, 0}));
    p.source_normal.push_back(encode_octahedral({0, -1, 0})), p.distance.push_back(2);
    p.path.push_back(static_cast<std::uint8_t>(PhotonPath::indirect)), p.bounce.push_back(1);
    p.family.push_back(static_cast<std::uint32_t>(i));
  }
  const CausticPhotons caustics = *some_caustics();
  p.flights = caustics.flights;
  PhotonTotals totals;
  totals.emitted = totals.stored = 5;
  PhotonMap::build(std::move(p), totals).write(path, std::move(provenance));
}

IrradianceCache some_records() {
  IrradianceCache cache = test::random_cache(7);
  for (IrradianceRecord& r : cache.records) {
    AdaptiveFootprint::Axes axes;
    for (AdaptiveFootprint::Axis& axis : axes) axis.length_m = r.radius_m;
    r.footprint = std::make_shared<AdaptiveFootprint>(make_frame(r.normal).x, r.normal, axes);
    r.shared = 0.5f;
  }
  cache.caustics = some_caustics();
  return cache;
}

void write_records(const std::string& path, Provenance provenance) {
  const IrradianceCache cache = some_records();
  write_irradiance(path + ".plain", cache, std::move(provenance));
  const Container plain = Container::open(path + ".plain");
  TensorWriter writer(FileKind::irradiance);
  for (const auto& named : plain.tensors())
    with_type_of(named.second.dtype, [&]<class T>(T) {
      writer.add<T>(named.first, plain.values<T>(named.first, named.second.shape));
    });
  const RecordIndex index = index_records(cache.records, reading_accuracy(cache.accuracy));
  add_index(writer, index);
  Provenance indexed = plain.provenance();
  indexed.extra[kIndexAccuracy] = reading_accuracy(cache.accuracy);
  writer.write(path, indexed);
}

void write_part_of_records(const std::string& path, Provenance provenance) {
  provenance.extra[name_of(FileForm::part)] = "1/1";
  const IrradianceCache cache = test::random_cache(3);
  const std::vector<float> least(3, 1e-6f);
  write_irradiance(path, cache, std::move(provenance), least);
}

void write_radiance_records(const std::string& path, Provenance provenance, Store store) {
  RadianceCache cache = test::random_radiance({3, 2, 3});
  cache.caustics = some_caustics();
  for (RadianceRecord& r : cache.records) r.shared = 0.5f, r.footprint_m.emplace().fill(0.5f);
  write_radiance(path, cache, std::move(provenance), store);
}

void write_lobes(const std::string& path, Provenance provenance) {
  BrdfTable table;
  table.material = "floor";
  table.resolution = 2, table.order = 2;
  table.orders.assign(2, 2), table.error.assign(2, 0.1f), table.coefficients.assign(2 * 4 * 3, 0.f);
  write_brdf(path, std::vector<BrdfTable>{table}, std::move(provenance));
}

/// A sound file, and what reads all of it.
struct SoundFile {
  std::function<void(const std::string&, Provenance)> write;
  std::function<void(const Container&)> read;
};

SoundFile radiance_file(Store store) {
  return {
      [store](const std::string& path, Provenance p) { write_radiance_records(path, std::move(p), store); },
      [](const Container& f) { read_radiance(f); }};
}

SoundFile radiance_film_file(Store store) {
  return {[store](const std::string& path, Provenance p) {
            RadianceFilm film =
                test::random_radiance_film({3, 2, 3, 3, 1, 3}, true, TemporalGradients::interpolated);
            test::add_footprints(film);
            write_film(path, film, std::move(p), store);
          },
          [](const Container& f) { read_radiance_film(f); }};
}

const std::map<std::string, SoundFile>& sound_files() {
  static const std::map<std::string, SoundFile> all{
      {"photons", {write_photons, [](const Container& f) { PhotonMap::open(f.path()); }}},
      {"records", {write_records, [](const Container& f) { RecordLookup{f}, caustics_of(f); }}},
      {"part", {write_part_of_records, [](const Container& f) { RecordColumns(f, FileForm::part); }}},
      {"film",
       {[](const std::string& path, Provenance p) {
          Film film = test::random_film(6, true, TemporalGradients::interpolated);
          test::add_footprints(film);
          write_film(path, film, std::move(p));
        },
        [](const Container& f) { read_film(f); }}},
      {"radiance", radiance_file(Store::floats)},
      {"radiance_compact", radiance_file(Store::compact)},
      {"radiance_film", radiance_film_file(Store::floats)},
      {"radiance_film_compact", radiance_film_file(Store::compact)},
      {"lobes", {write_lobes, [](const Container& f) { read_brdf(f); }}}};
  return all;
}

std::string path_of(const std::string& name) {
  static const std::string folder = test::scratch("damage");
  return folder + "/" + name;
}

Container written(const std::string& name) {
  sound_files().at(name).write(path_of(name), test::irradiance_provenance());
  return Container::open(path_of(name));
}

class DamagedTensorOf : public testing::TestWithParam<std::string> {
 protected:
  /// What the reader says of a copy, with right checksums, in which `damage` has changed one tensor; nothing
  /// as tensor: it is left out.
  std::string complaint(const std::string& tensor,
                        const std::function<bool(Tensor&, std::vector<std::byte>&)>& damage) {
    ContainerWriter writer;
    std::vector<std::byte> bytes;
    for (const auto& [name, sound] : file_.tensors()) {
      Tensor copy = sound;
      if (name == tensor) {
        bytes.assign(sound.bytes.begin(), sound.bytes.end());
        if (!damage(copy, bytes)) continue;
        copy.bytes = bytes;
      }
      writer.add(name, copy);
    }
    const std::string path = path_of(GetParam() + ".damaged");
    writer.write(path, file_.provenance());
    return test::complaint_of([&] { sound_files().at(GetParam()).read(Container::open(path)); });
  }
  const Container file_ = written(GetParam());
};

/// A number that its row excludes; nothing where every number of its type will do.
std::optional<double> excluded(const TensorRow& row, Dtype dtype) {
  if (dtype == Dtype::i8) return std::nullopt;
  switch (row.check.rule) {
    case NumberCheck::Rule::any:
      return std::nullopt;
    case NumberCheck::Rule::within:
      return row.dtype == Dtype::u8 ? row.check.most + 1 : row.check.least * 2 - 1;
    case NumberCheck::Rule::positive:
      return 0;
    case NumberCheck::Rule::finite:
      return -std::numeric_limits<double>::infinity();
    default:
      return 5;  // a vector that is longer than 1
  }
}

TEST_P(DamagedTensorOf, AreRefusedByName) {
  const SoundFile& sound = sound_files().at(GetParam());
  EXPECT_EQ(test::complaint_of([&] { sound.read(file_); }), "") << "nothing is damaged yet";
  for (const auto& [name, tensor] : file_.tensors()) {
    const TensorRow* row = find_row(file_.kind(), name);
    ASSERT_NE(row, nullptr) << name;
    EXPECT_EQ(complaint(name, [](Tensor&, std::vector<std::byte>&) { return true; }), "") << name;
    const auto expect_named = [&, &name = name](const std::string& said, const char* damage) {
      EXPECT_NE(said.find(text('"', name, '"')), std::string::npos) << name << ", " << damage << ": " << said;
      EXPECT_EQ(said.find(path_of(GetParam() + ".damaged") + ": "), 0u) << said;
    };
    expect_named(complaint(name,
                           [](Tensor& t, std::vector<std::byte>& bytes) {
                             t.dtype = t.dtype == Dtype::u16 ? Dtype::i64 : Dtype::u16;
                             bytes.assign(t.elements() * dtype_size(t.dtype), std::byte{});
                             return true;
                           }),
                 "another type");
    expect_named(complaint(name,
                           [](Tensor& t, std::vector<std::byte>&) {
                             t.shape.push_back(1);
                             return true;
                           }),
                 "another shape");
    // A tensor that may be absent alone is no damage.
    const bool alone =
        name == "shared" || name == "order" || name == "family" ||
        (name == "footprint_length" && GetParam().starts_with("radiance") && !file_.has("birth"));
    const std::string without = complaint(name, [](Tensor&, std::vector<std::byte>&) { return false; });
    if (alone)
      EXPECT_EQ(without, "") << name;
    else
      expect_named(without, "missing");
    const auto put = [&](double value) {
      return complaint(name, [&](Tensor& t, std::vector<std::byte>& bytes) {
        with_type_of(t.dtype,
                     [&]<class T>(T) { reinterpret_cast<T*>(bytes.data())[0] = static_cast<T>(value); });
        return true;
      });
    };
    if (const std::optional<double> wrong = excluded(*row, tensor.dtype))
      expect_named(put(*wrong), "an excluded number");
    if (is_float(tensor.dtype)) expect_named(put(std::numeric_limits<double>::quiet_NaN()), "no number");
  }
}

INSTANTIATE_TEST_SUITE_P(Files, DamagedTensorOf,
                         testing::Values("photons", "records", "part", "film", "radiance", "radiance_compact",
                                         "radiance_film", "radiance_film_compact", "lobes"));

TEST(DamagedTensors, AreOfEveryRow) {
  std::set<const TensorRow*> met;
  for (const auto& [name, sound] : sound_files()) {
    const Container file = written(name);
    for (const auto& [tensor, t] : file.tensors()) met.insert(find_row(file.kind(), tensor));
  }
  for (const KindRow& kind : all_kinds())
    for (const TensorGroup& group : kind.groups)
      for (const TensorRow& row : group.rows)
        EXPECT_TRUE(met.contains(&row)) << name_of(kind.kind) << ' ' << row.name;
}

}  // namespace
}  // namespace phos
