// XXH3-128: known values, composition, and what identifies a file.
#include "file/hash.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "file/container.h"
#include "support/run.h"

namespace phos {
namespace {

std::string hash_of_values(float a, float b) {
  Hasher hasher;
  hasher.add(a), hasher.add(b);
  return hasher.finish().hex();
}

// Values of the reference implementation for seed 0 (xxhsum -H2).
TEST(Hash, KnownValues) {
  EXPECT_EQ(hash_text("").hex(), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(hash_text("abc").hex(), "06b05ab6733a618578af5f94892f3950");
}

TEST(Hash, HexKeepsLeadingZeros) { EXPECT_EQ((Hash128{1, 0xab}.hex()), "000000000000000100000000000000ab"); }

TEST(Hasher, LengthsSeparateStrings) {
  Hasher a, b;
  a.add("ab"), a.add("c");
  b.add("a"), b.add("bc");
  EXPECT_NE(a.finish(), b.finish());
}

TEST(Hasher, MinusZeroIsZeroAndLastBitsCount) {
  EXPECT_EQ(hash_of_values(0.f, 1.f), hash_of_values(-0.f, 1.f));
  EXPECT_NE(hash_of_values(0.f, 1.f), hash_of_values(0.f, std::nextafter(1.f, 2.f)));
  EXPECT_NE(hash_of_values(0.f, 1.f), hash_of_values(1.f, 0.f));
}

TEST(Hasher, FinishLeavesTheStateUsable) {
  Hasher a;
  a.add(1);
  const Hash128 first = a.finish();
  EXPECT_EQ(a.finish(), first);
  a.add(2);
  EXPECT_NE(a.finish(), first);
}

TEST(HashFile, IsTheContentOfAnOrdinaryFile) {
  const std::string folder = test::scratch("hash");
  test::spill(folder + "/a", "abc");
  EXPECT_EQ(hash_file(folder + "/a"), hash_text("abc"));
  test::spill(folder + "/empty", "");
  EXPECT_EQ(hash_file(folder + "/empty"), hash_text(""));
}

// The data of a container are represented by the checksums in its header.
TEST(HashFile, OfAContainerDependsOnItsDataThroughTheHeader) {
  const std::string folder = test::scratch("hash-container");
  Provenance p;
  p.kind = FileKind::photons;
  std::vector<float> values(100000, 1.f);
  const auto write = [&](const std::string& name) {
    ContainerWriter writer;
    writer.add<float>("v", values, {values.size()}, "m");
    writer.write(folder + '/' + name, p);
    return hash_file(folder + '/' + name);
  };
  const Hash128 a = write("a");
  EXPECT_EQ(write("b"), a);
  values[77777] = 2.f;
  EXPECT_NE(write("c"), a);
  const std::string bytes = test::slurp(folder + "/a");
  const std::size_t header = bytes.size() - 400000;
  EXPECT_EQ(a, hash_text(bytes.substr(0, header)));
}

TEST(HashFile, MissingFolderAndPipeAreErrors) {
  const std::string folder = test::scratch("hash-errors");
  for (const std::string& path : {folder + "/none", folder, std::string("/dev/null")}) {
    try {
      hash_file(path);
      ADD_FAILURE() << path;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::bad_input);
      EXPECT_EQ(e.where(), path);
    }
  }
}

}  // namespace
}  // namespace phos
