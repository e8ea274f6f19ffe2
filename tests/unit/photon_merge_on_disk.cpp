// Shards joined on disk in a few kilobytes give the bytes of shards joined in memory; so does a tree over
// points in a file.
#include "photon/disk/merge_on_disk.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "file/scratch/scratch_file.h"
#include "photon/tree/kd_tree.h"
#include "photon/tree/split.h"
#include "support/run.h"

namespace phos {
namespace {

using Place = std::function<Vec3(const Vec3& u)>;

const std::vector<std::pair<const char*, Place>>& places() {
  static const std::vector<std::pair<const char*, Place>> all{
      {"in a cube", [](const Vec3& u) { return u; }},
      {"on a plane", [](const Vec3& u) { return Vec3(u.x, 0.5f, u.z); }},
      {"at one place", [](const Vec3&) { return Vec3(3, -4, 5); }},
      {"on a lattice", [](const Vec3& u) { return glm::floor(9.f * u); }},
      {"beside -0 and 0", [](const Vec3& u) { return u.x < 0.5f ? Vec3(-0.f, u.y, 0) : Vec3(0, u.y, -0.f); }},
      {"crowded towards an edge",
       [](const Vec3& u) { return Vec3(std::exp2(-90 * u.x), u.y, std::exp2(50 * u.z)); }},
      {"wide apart", [](const Vec3& u) { return 1e17f * (u - 0.5f); }},
  };
  return all;
}

Vec3 random_place(RandomStream& random, const Place& place) {
  const Vec2 xy = random.uniform2();
  return place(Vec3(xy.x, xy.y, random.uniform()));
}

TEST(TreeOnDisk, SavesTheBytesOfTheTreeInMemory) {
  const std::string output = test::scratch("tree_on_disk") + "/none";
  for (const auto& [name, place] : places())
    for (const std::size_t n : {1u, 16u, 17u, 1000u, 40001u, 70003u})
      for (const std::uint64_t memory : {1u, 5'000u, 600'000u}) {
        if (n > 1000 && memory == 1) continue;  // sixteen points at a time
        RandomStream random(3, Stage::test, n);
        std::vector<Vec3> points(n);
        ScratchFile file(output), saved(output);
        for (std::size_t i = 0; i < n; ++i) {
          points[i] = random_place(random, place);
          const TreePoint point{points[i], static_cast<std::int32_t>(i)};
          file.write_values(std::span<const TreePoint>(&point, 1));
        }
        KdTree::save_on_disk(file, n, memory, output, saved);
        const std::span<const std::byte> bytes = saved.map();
        EXPECT_TRUE(std::vector<std::byte>(bytes.begin(), bytes.end()) == KdTree::build(points).save())
            << n << " points " << name << " in " << memory << " bytes";
      }
}

class MergesOnDisk : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::scratch("merge_on_disk"); }

  /// Shards of as many rows as `rows` says, written to files.
  std::vector<std::string> shards(const std::vector<std::size_t>& rows, const Place& place, bool families,
                                  bool flights) {
    std::vector<std::string> paths;
    for (std::size_t s = 0; s < rows.size(); ++s) {
      RandomStream random(5, Stage::test, s);
      Photons p;
      for (std::size_t i = 0; i < rows[s]; ++i) {
        p.position.push_back(random_place(random, place));
        p.flux.emplace_back(random.uniform(), 2, 1);
        p.direction.push_back(random.bits()), p.normal.push_back(random.bits());
        p.source_normal.push_back(random.bits());
        p.distance.push_back(i % 7 == 0 ? kInfinity : random.uniform());
        p.path.push_back(static_cast<std::uint8_t>(i % 4)), p.bounce.push_back(static_cast<std::uint8_t>(i));
        if (families) p.family.push_back(random.bits());
        if (!flights || i % 3 != 0) continue;
        p.flights.from.push_back(p.position.back()), p.flights.flux.push_back(p.flux.back());
        p.flights.direction.push_back(random.bits()), p.flights.length.push_back(kInfinity);
      }
      PhotonTotals t;
      t.emitted = 10 * rows.size(), t.first_path = 10 * s, t.paths = 10, t.stored = rows[s];
      t.flux_exponent = -30;
      t.stored_sum.units = {static_cast<std::int64_t>(s), 1, 2};
      t.settle();
      Provenance provenance;
      provenance.tool = "phos-photons test", provenance.command = "phos-photons",
      provenance.scene_hash = "0123";
      const std::string name = text(s + 1, "/", rows.size());
      provenance.key = text("key:shard ", name);
      provenance.counters.add("photon left the scene", s);
      paths.push_back(text(folder_, "/", s, ".photons"));
      write_shard(paths.back(), p, t, name, provenance);
    }
    return paths;
  }

  std::string in_memory(const std::vector<std::string>& paths) const {
    MergedShards merged = read_shards(paths);
    const std::string path = folder_ + "/in-memory.photons";
    PhotonMap::build(std::move(merged.photons), merged.totals).write(path, merged.provenance);
    return test::slurp(path);
  }

  std::string output() const { return folder_ + "/on-disk.photons"; }
  std::string on_disk(const std::vector<std::string>& paths, std::uint64_t memory) const {
    MergeOnDisk merge(paths, output(), memory);
    merge.sort(), merge.build_tree(), merge.write();
    return test::slurp(output());
  }

  void expect_refused(const std::vector<std::string>& paths, ExitCode code, const std::string& says) const {
    std::filesystem::remove(output());
    try {
      on_disk(paths, 20'000);
      ADD_FAILURE() << "joined, though " << says;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code) << e.what();
      EXPECT_NE(std::string(e.what()).find(says), std::string::npos) << e.what();
    }
    EXPECT_FALSE(std::filesystem::exists(output()));
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      EXPECT_EQ(entry.path().extension(), ".photons") << "left: " << entry.path();
  }

  std::string folder_;
};

TEST_F(MergesOnDisk, ToTheBytesOfAMergeInMemory) {
  for (const auto& [name, place] : places()) {
    const bool more = name == places().front().first;
    const std::vector<std::string> paths = shards({3000, 0, 1, 5200}, place, more, more);
    const std::string expected = in_memory(paths);
    for (const int threads : {1, 3}) {
      set_threads(threads);
      for (const std::uint64_t memory : {10'000u, 100'000u, 100'000'000u})
        EXPECT_TRUE(on_disk({paths[2], paths[0], paths[3], paths[1]}, memory) == expected)
            << name << " in " << memory << " bytes, " << threads << " threads";
    }
    set_threads(0);
  }
}

TEST_F(MergesOnDisk, NoPhotonsAndOne) {
  for (const std::size_t n : {0u, 1u}) {
    const std::vector<std::string> paths = shards({0, n}, places().front().second, false, false);
    EXPECT_TRUE(on_disk(paths, 10'000) == in_memory(paths)) << n;
  }
}

TEST_F(MergesOnDisk, DamageAndWhatIsNowhereAreRefused) {
  const std::vector<std::string> paths = shards({3000, 2000}, places().front().second, false, false);
  std::string damaged = test::slurp(paths[1]);
  damaged[damaged.size() / 2] ^= 4;
  test::spill(folder_ + "/damaged.photons", damaged);
  expect_refused({paths[0], folder_ + "/damaged.photons"}, ExitCode::bad_input,
                 "has changed since it was written");
  expect_refused({paths[0]}, ExitCode::mismatch, "missing shard 2/2");
  const Place far = [](const Vec3& u) { return u.x < 0.1f ? Vec3(2e18f) : u; };
  expect_refused(shards({500, 500}, far, false, false), ExitCode::bad_input, "less than 1e18 m away");
}

TEST_F(MergesOnDisk, AFullDiskLeavesNothing) {
  const std::vector<std::string> paths = shards({3000, 2000}, places().front().second, false, false);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{100'000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  expect_refused(paths, ExitCode::bad_input, "cannot write");
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  try {
    MergeOnDisk merge(paths, folder_ + "/none/a.photons", 20'000);
    ADD_FAILURE() << "there is no such folder";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("temporary file"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace phos
