// Photon maps in files: what is written comes back, shards join to the whole, and damage is refused.
#include "photon/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "core/random.h"
#include "photon/photon_file.h"
#include "photon/photon_shards.h"
#include "photon/trace.h"
#include "support/run.h"
#include "support/scenes.h"

namespace phos {
namespace {

Photons some_photons(std::size_t n, bool families = false) {
  RandomStream random(1, Stage::test, n);
  random.start_bounce(0);
  Photons p;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 u = random.uniform2();
    p.position.emplace_back(u.x, u.y, random.uniform());
    p.flux.emplace_back(random.uniform(), u.y, 1);
    p.direction.push_back(random.bits());
    p.normal.push_back(random.bits());
    p.source_normal.push_back(random.bits());
    p.distance.push_back(random.uniform());
    p.path.push_back(static_cast<std::uint8_t>(i % 3));
    p.bounce.push_back(static_cast<std::uint8_t>(i));
    if (families) p.family.push_back(random.bits());
  }
  return p;
}

PhotonTotals totals_for(std::size_t n) {
  PhotonTotals t;
  t.emitted = t.paths = 10, t.stored = n;
  t.flux_exponent = -40;
  t.stored_sum.units = {1, std::int64_t{1} << 50, 3};
  t.settle();
  return t;
}

Provenance provenance() {
  Provenance p;
  p.tool = "phos-photons test";
  p.command = "phos-photons";
  p.scene_hash = "0123";
  p.key = "key";
  return p;
}

template <class T>
void expect_equal(std::span<const T> a, std::span<const T> b, const char* what) {
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << what;
}

void expect_equal(const PhotonMap& a, const PhotonMap& b) {
  expect_equal(a.position, b.position, "position"), expect_equal(a.flux, b.flux, "flux");
  expect_equal(a.direction, b.direction, "direction"), expect_equal(a.normal, b.normal, "normal");
  expect_equal(a.source_normal, b.source_normal, "source_normal"),
      expect_equal(a.distance, b.distance, "distance");
  expect_equal(a.path, b.path, "path"), expect_equal(a.bounce, b.bounce, "bounce");
  EXPECT_EQ(a.family.size(), b.family.size());
  expect_equal(a.family, b.family, "family");
  EXPECT_EQ(totals_to_json(a.totals), totals_to_json(b.totals));
  std::vector<std::uint32_t> rows, more;
  std::vector<float> d2, more_d2;
  for (const Vec3& p : {Vec3(0.5f), Vec3(0), Vec3(0.9f, 0.1f, 0.4f)}) {
    a.in_sphere(p, 0.3f, rows), b.in_sphere(p, 0.3f, more);
    EXPECT_EQ(rows, more);
    a.nearest(p, 9, rows, d2), b.nearest(p, 9, more, more_d2);
    EXPECT_EQ(rows, more);
    EXPECT_EQ(d2, more_d2);
  }
}

TEST(PhotonMap, WrittenAndOpenedIsTheSame) {
  const std::string folder = test::scratch("photon_map_same");
  for (const std::size_t n : {0u, 1u, 2u, 17u, 5000u, 5001u}) {
    const bool families = n % 2 == 1;
    const PhotonMap map = PhotonMap::build(some_photons(n, families), totals_for(n));
    ASSERT_EQ(map.size(), n);
    ASSERT_EQ(map.family.size(), families ? n : 0);
    EXPECT_EQ(map.container(), nullptr);
    const std::string path = folder + "/a.photons", again = folder + "/b.photons";
    map.write(path, provenance());
    const PhotonMap opened = PhotonMap::open(path);
    expect_equal(map, opened);
    ASSERT_NE(opened.container(), nullptr);
    EXPECT_EQ(opened.container()->provenance().scene_hash, "0123");
    opened.write(again, provenance());
    EXPECT_EQ(test::slurp(path), test::slurp(again)) << n << " photons";
  }
}

TEST(PhotonMap, BuildKeepsTheRowsTogether) {
  const Photons source = some_photons(3000, true);
  const PhotonMap map = PhotonMap::build(source, totals_for(3000));
  std::vector<std::size_t> order(source.size());
  for (std::size_t i = 0; i < source.size(); ++i) {
    const auto same = std::find(source.position.begin(), source.position.end(), map.position[i]);
    ASSERT_NE(same, source.position.end());
    const auto j = static_cast<std::size_t>(same - source.position.begin());
    EXPECT_EQ(map.flux[i], source.flux[j]);
    EXPECT_EQ(map.direction[i], source.direction[j]);
    EXPECT_EQ(map.normal[i], source.normal[j]);
    EXPECT_EQ(map.source_normal[i], source.source_normal[j]);
    EXPECT_EQ(map.distance[i], source.distance[j]);
    EXPECT_EQ(map.path[i], source.path[j]);
    EXPECT_EQ(map.family[i], source.family[j]);
    EXPECT_EQ(map.bounce[i], source.bounce[j]);
  }
}

TEST(PhotonMap, MovedMapsStayUsable) {
  PhotonMap a = PhotonMap::build(some_photons(100), totals_for(100));
  const PhotonMap b = std::move(a);
  std::vector<std::uint32_t> rows;
  b.in_sphere(b.position[7], 0, rows);
  EXPECT_EQ(rows, std::vector<std::uint32_t>{7});
}

/// Offset of a tensor's bytes in the file.
std::size_t offset_of(const std::string& path, const std::string& tensor) {
  const Container file = Container::open(path);
  const auto* first = file.tensors().begin()->second.bytes.data();
  for (const auto& [name, t] : file.tensors()) first = std::min(first, t.bytes.data());
  std::uint64_t header = 0;
  const std::string bytes = test::slurp(path);
  std::memcpy(&header, bytes.data(), 8);
  return 8 + header + static_cast<std::size_t>(file.tensors().at(tensor).bytes.data() - first);
}

void expect_refused(const std::string& path, const std::string& bytes, const std::string& what) {
  test::spill(path, bytes);
  try {
    PhotonMap::open(path);
    ADD_FAILURE() << what << " was opened";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input) << what;
  }
}

TEST(PhotonMap, DamageIsRefusedBeforeFlannSeesIt) {
  const std::string folder = test::scratch("photon_map_damage"), path = folder + "/a.photons";
  PhotonMap::build(some_photons(4000), totals_for(4000)).write(path, provenance());
  const std::string whole = test::slurp(path);
  for (const char* tensor : {"kdtree", "position", "flux", "normal", "path"}) {
    const std::size_t begin = offset_of(path, tensor), size = std::string(tensor) == "path" ? 4000 : 16000;
    for (std::size_t i = 0; i < 40; ++i) {
      std::string damaged = whole;
      damaged[begin + i * (size / 40)] ^= 0x10;
      expect_refused(folder + "/b.photons", damaged, text(tensor, " byte ", i * (size / 40)));
    }
  }
  for (const double part : {0.0, 0.01, 0.3, 0.7, 0.9, 0.999, 0.99999})
    expect_refused(folder + "/b.photons",
                   whole.substr(0, static_cast<std::size_t>(part * static_cast<double>(whole.size()))),
                   text("cut at ", part));
}

TEST(PhotonMap, TreeOfOtherPhotonsIsRefused) {
  const std::string folder = test::scratch("photon_map_tree"), a = folder + "/a.photons",
                    b = folder + "/b.photons";
  PhotonMap::build(some_photons(400), totals_for(400)).write(a, provenance());
  PhotonMap::build(some_photons(401), totals_for(401)).write(b, provenance());
  const Container file = Container::open(a), other = Container::open(b);
  TensorWriter writer(FileKind::photons);
  add_columns(writer, columns_of(file));
  const auto tree = other.values<std::uint8_t>("kdtree", {0});
  writer.add<std::uint8_t>("kdtree", tree);
  Provenance p = provenance();
  p.extra["totals"] = totals_to_json(totals_for(400));
  writer.write(folder + "/c.photons", p);
  EXPECT_THROW(PhotonMap::open(folder + "/c.photons"), Error);
}

TEST(PhotonMap, NonFinitePositionsAreRefused) {
  Photons photons = some_photons(100);
  photons.position[3].z = std::nanf("");
  try {
    PhotonMap::build(photons, totals_for(100));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::numerical);
  }
}

/// Writes the shards of a small run, and the whole of it.
class Shards : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("photon_shards"); }

  std::string shard(int i, int n, std::uint64_t seed = 3) {
    const std::string path = text(folder_, "/", seed, "-", i, "-", n, ".photons");
    Provenance p = provenance();
    p.command = text("phos-photons --seed ", seed);
    p.key = text("key", seed, n > 0 ? text(":shard ", i, "/", n) : "");
    PhotonOptions options;
    options.paths = 1'000;
    options.shard = n > 0 ? text(i, "/", n) : "";
    PhotonTotals totals;
    Photons photons = trace_photons(rays_, options, seed, totals, p.counters);
    if (n > 0)
      write_shard(path, photons, totals, options.shard, p);
    else
      PhotonMap::build(std::move(photons), totals).write(path, p);
    return path;
  }

  void expect_mismatch(const std::vector<std::string>& paths, const std::string& says) {
    try {
      read_shards(paths);
      ADD_FAILURE() << "merged, though " << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::mismatch);
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
  }

  std::string folder_;
  Scene scene_ = test::two_sided_sheet().scene;
  RayScene rays_{scene_};
};

TEST_F(Shards, MergedAreTheBytesOfTheWhole) {
  const std::string whole = test::slurp(shard(0, 0));
  for (const int n : {1, 2, 3, 7}) {
    std::vector<std::string> paths;
    for (int i = n; i >= 1; --i) paths.push_back(shard(i, n));
    std::swap(paths.front(), paths[paths.size() / 2]);
    MergedShards merged = read_shards(paths);
    const std::string path = folder_ + "/merged.photons";
    PhotonMap::build(std::move(merged.photons), merged.totals).write(path, merged.provenance);
    EXPECT_EQ(test::slurp(path), whole) << n << " shards";
    EXPECT_EQ(key_of_merged(paths), "key3");
  }
}

TEST_F(Shards, WhatDoesNotBelongTogetherIsRefused) {
  const std::string a = shard(1, 3), b = shard(2, 3), c = shard(3, 3);
  expect_mismatch({a, c}, "missing shard 2/3");
  expect_mismatch({b}, "missing shards 1/3, 3/3");
  expect_mismatch({a, b, b, c}, "and so is");
  expect_mismatch({a, b, shard(3, 3, 4)}, "--seed 4");
  expect_mismatch({a, b, shard(2, 2)}, "not one of 3");
  EXPECT_THROW(read_shards({shard(0, 0)}), Error) << "a whole map";
  EXPECT_THROW(PhotonMap::open(a), Error) << "a shard";
  std::string damaged = test::slurp(b);
  damaged.back() ^= 1;
  test::spill(folder_ + "/damaged.photons", damaged);
  EXPECT_THROW(read_shards({a, folder_ + "/damaged.photons", c}), Error);
}

}  // namespace
}  // namespace phos
