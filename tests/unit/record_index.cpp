// The index of a file of many records gives what RecordTree gives, and files of few records do without.
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "record/index.h"
#include "record/tree.h"
#include "support/indexed_file.h"

namespace phos::test {
namespace {

RecordTree tree_of(const IrradianceCache& cache, Bounds bounds) {
  for (const IrradianceRecord& r : cache.records) bounds.include(r.position);
  RecordTree tree(bounds, cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  return tree;
}

void expect_same(const RecordLookup& lookup, const RecordTree& tree, bool bitwise) {
  std::size_t found = 0;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    RandomStream random(9, Stage::test, i);
    // About a record, so that most are served; its neighbourhood, or far out.
    const IrradianceRecord near = lookup.records()[random.bits() % lookup.records().size()];
    const float stray = i % 8 == 0 ? 3 : 0.2f * near.radius_m;
    const Vec3 p = near.position + stray * sample_uniform_sphere(random.uniform2());
    const Vec3 n = glm::normalize(near.normal + 0.2f * sample_uniform_sphere(random.uniform2()));
    const Interpolated a = lookup.interpolate(p, n), b = tree.interpolate(p, n);
    EXPECT_EQ(lookup.covered(p, n), b.weight > 0);
    found += b.weight > 0;
    if (bitwise) {
      EXPECT_EQ(a.irradiance, b.irradiance);
      EXPECT_EQ(a.stderr_lx, b.stderr_lx);
      EXPECT_EQ(a.weight, b.weight);
    } else {
      EXPECT_NEAR(a.weight, b.weight, 1e-5f * b.weight);
      EXPECT_NEAR(a.irradiance.y, b.irradiance.y, 1e-4f * b.irradiance.y + 1e-6f);
    }
  }
  EXPECT_GT(found, 1500u);
}

TEST(RecordIndex, GivesTheTreesSumsBitForBit) {
  const std::string folder = scratch("index");
  for (const std::size_t n : {1u, 2u, 700u, 5000u}) {
    const IrradianceCache cache = random_cache(n);
    const std::string plain = text(folder, "/plain"), indexed = text(folder, "/indexed");
    write_irradiance(plain, cache, irradiance_provenance());
    EXPECT_FALSE(Container::open(plain).has("index_box"));
    write_indexed(indexed, plain, index_records(cache.records, cache.accuracy));
    const RecordLookup made(Container::open(plain)), stored(Container::open(indexed));
    EXPECT_FALSE(made.stored());
    EXPECT_TRUE(stored.stored());
    if (n < 700) continue;
    const RecordTree tree = tree_of(cache, {});
    expect_same(made, tree, true);
    expect_same(stored, tree, true);
    Bounds wide;
    wide.include(Vec3(-3)), wide.include(Vec3(7));
    expect_same(stored, tree_of(cache, wide), false);
  }
}

TEST(RecordIndex, OfAnotherAccuracyIsMadeAnew) {
  const std::string folder = scratch("index");
  IrradianceCache cache = random_cache(700);
  cache.accuracy = 0.2;
  const double read_at = reading_accuracy(cache.accuracy);
  EXPECT_DOUBLE_EQ(read_at, 0.5);
  const std::string plain = text(folder, "/narrow"), indexed = text(folder, "/narrow-indexed");
  write_irradiance(plain, cache, irradiance_provenance());
  // Whoever wrote this one knew nothing of the accuracy at which it is read.
  const Container file = Container::open(plain);
  TensorWriter writer(FileKind::irradiance);
  for (const auto& [name, tensor] : file.tensors())
    writer.add<float>(name, file.values<float>(name, tensor.shape));
  const RecordIndex index = index_records(cache.records, cache.accuracy);
  add_index(writer, index);
  writer.write(indexed, file.provenance());
  const RecordLookup lookup(Container::open(indexed));
  EXPECT_FALSE(lookup.stored());
  RecordTree tree({}, read_at);
  for (const IrradianceRecord& r : cache.records) tree.insert(r);
  for (const IrradianceRecord& r : cache.records) {
    const Vec3 p = r.position + 0.4f * r.radius_m * glm::normalize(Vec3(1, 2, 3));
    EXPECT_NEAR(lookup.interpolate(p, r.normal).weight, tree.interpolate(p, r.normal).weight, 1e-5f);
  }
}

TEST(RecordIndex, NoRecordsIsNothingAnywhere) {
  const std::string path = text(scratch("index"), "/none");
  IrradianceCache cache;
  write_irradiance(path, cache, irradiance_provenance());
  const RecordLookup lookup(Container::open(path));
  EXPECT_FALSE(lookup.covered(Vec3(0), Vec3(0, 0, 1)));
  EXPECT_EQ(lookup.interpolate(Vec3(0), Vec3(0, 0, 1)).weight, 0);
}

TEST(RecordIndex, IsStoredWithManyRecordsAndIsTheSameOnAnyThreads) {
  const std::string folder = scratch("index");
  IrradianceCache cache = random_cache(kIndexedRecords);
  for (IrradianceRecord& r : cache.records) r.radius_m *= 0.1f;
  for (const int threads : {1, 2}) {
    set_threads(threads);
    write_irradiance(text(folder, "/", threads), cache, irradiance_provenance());
  }
  set_threads(0);
  const std::string one = text(folder, "/1"), two = text(folder, "/2");
  EXPECT_TRUE(slurp(one) == slurp(two));
  const RecordLookup lookup(Container::open(one));
  EXPECT_TRUE(lookup.stored());
  expect_same(lookup, tree_of(cache, {}), true);
  // Records are read from the file as they were.
  const IrradianceRecord a = lookup.records()[777], &b = cache.records[777];
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.translation_gradient[2], b.translation_gradient[2]);
  EXPECT_EQ(a.rotation_gradient[1], b.rotation_gradient[1]);
  EXPECT_EQ(read_irradiance(Container::open(one)).records.size(), cache.records.size());
}

}  // namespace
}  // namespace phos::test
