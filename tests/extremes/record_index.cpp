// A damaged index, checksums mended, is refused in one line or harms nobody.
#include <gtest/gtest.h>

#include "core/error.h"
#include "record/index.h"
#include "support/complaint.h"
#include "support/indexed_file.h"

namespace phos::test {
namespace {

class DamagedIndex : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_);
    const IrradianceCache cache = random_cache(60);
    plain_ = folder_ + "/plain.irradiance";
    write_irradiance(plain_, cache, irradiance_provenance());
    good_ = index_records(cache.records, cache.accuracy);
  }

  /// Opens and looks up everywhere; returns the complaint, or "" if the file was taken.
  std::string use(const RecordIndex& index) const {
    const std::string path = folder_ + "/bad.irradiance";
    write_indexed(path, plain_, index);
    const std::string complaint = complaint_of([&] {
      const RecordLookup lookup(Container::open(path));
      for (std::uint64_t i = 0; i < 50; ++i) {
        RandomStream random(1, Stage::test, i);
        const Vec3 p = 2.f * Vec3(random.uniform(), random.uniform(), random.uniform()) - 0.5f;
        const Interpolated e = lookup.interpolate(p, sample_uniform_sphere(random.uniform2()));
        EXPECT_TRUE(is_finite(e.irradiance) && std::isfinite(e.weight));
      }
    });
    EXPECT_TRUE(complaint.empty() || complaint.starts_with(path + ": ")) << complaint;
    return complaint;
  }

  void TearDown() override { std::filesystem::remove_all(folder_); }

  // In memory where that can be: each of the many files is flushed to the disk otherwise.
  std::string folder_ =
      std::filesystem::exists("/dev/shm") ? text("/dev/shm/phos-index-", getpid()) : scratch("damaged-index");
  std::string plain_;
  RecordIndex good_;
};

TEST_F(DamagedIndex, TheGoodOneIsTaken) { EXPECT_EQ(use(good_), ""); }

TEST_F(DamagedIndex, EveryNumberOfEveryCellMatters) {
  std::size_t refused = 0, tried = 0;
  for (std::size_t i = 0; i < good_.cell.size(); i += 1 + good_.cell.size() / 150) {
    for (const std::uint32_t value : {0u, 1u, good_.cell[i] + 1, good_.cell[i] - 1, ~0u}) {
      RecordIndex bad = good_;
      if (value == bad.cell[i]) continue;
      bad.cell[i] = value;
      refused += !use(bad).empty();
      ++tried;
    }
  }
  // First children are fixed by the masks; a moved first entry may still be a proper index, though a wrong
  // one.
  EXPECT_GT(refused, tried * 8 / 10);
}

TEST_F(DamagedIndex, EveryMaskMatters) {
  for (std::size_t i = 0; i < good_.children.size(); i += 1 + good_.children.size() / 150) {
    for (const unsigned bit : {1u, 2u, 128u}) {
      RecordIndex bad = good_;
      bad.children[i] = static_cast<std::uint8_t>(bad.children[i] ^ bit);
      EXPECT_NE(use(bad), "");
    }
  }
}

TEST_F(DamagedIndex, EntriesThatAreNotThereOrMissing) {
  for (std::size_t i = 0; i < good_.entry.size(); i += 1 + good_.entry.size() / 100) {
    RecordIndex bad = good_;
    bad.entry[i] = 60;
    EXPECT_NE(use(bad).find("record that is not there"), std::string::npos);
    bad.entry[i] = ~0u;
    EXPECT_NE(use(bad).find("record that is not there"), std::string::npos);
  }
  RecordIndex bad = good_;
  std::fill(bad.entry.begin(), bad.entry.end(), 7u);
  EXPECT_NE(use(bad).find("lacks a record"), std::string::npos);
  bad = good_;
  bad.entry.pop_back();
  EXPECT_NE(use(bad), "");
  bad = good_;
  bad.entry.push_back(0);
  EXPECT_NE(use(bad), "");
}

TEST_F(DamagedIndex, RootsWithoutSize) {
  for (const double value : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    RecordIndex bad = good_;
    bad.box[3] = value;
    const std::string said = use(bad);
    EXPECT_NE(said.find(std::isfinite(value) ? "the root has no size" : "\"index_box\" is not finite"),
              std::string::npos)
        << said;
    bad = good_;
    bad.box[1] = value;
    EXPECT_EQ(use(bad).find("\"index_box\" is not finite") == std::string::npos, std::isfinite(value));
  }
}

TEST_F(DamagedIndex, ChainsTooDeepAndTreesWithoutCells) {
  RecordIndex chain;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    chain.children.push_back(i + 1 < 5000 ? 1 : 0);
    chain.cell.insert(chain.cell.end(), {i + 1, 0});
  }
  for (std::uint32_t i = 0; i < 60; ++i) chain.entry.push_back(i);
  chain.cell.insert(chain.cell.end(), {5000, 60});
  EXPECT_NE(use(chain).find("too deep"), std::string::npos);
  RecordIndex none;
  none.cell = {0, 0};
  EXPECT_NE(use(none).find("no cells"), std::string::npos);
}

TEST_F(DamagedIndex, NoiseIsRefusedOrHarmless) {
  for (std::uint64_t k = 0; k < 300; ++k) {
    RandomStream random(2, Stage::test, k);
    RecordIndex bad = good_;
    for (int times = 0; times < 3; ++times) {
      const std::uint32_t bits = random.bits();
      switch (random.bits() % 3) {
        case 0:
          bad.children[bits % bad.children.size()] = static_cast<std::uint8_t>(random.bits());
          break;
        case 1:
          bad.cell[bits % bad.cell.size()] = random.bits() >> (random.bits() % 32);
          break;
        default:
          bad.entry[bits % bad.entry.size()] = random.bits() >> (random.bits() % 32);
      }
    }
    use(bad);
  }
}

}  // namespace
}  // namespace phos::test
