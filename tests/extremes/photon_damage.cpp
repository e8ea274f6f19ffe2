// A kd-tree that someone made with care is still one over these photons, or an Error of one line: FLANN,
// which believes what it loads, never sees another.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "core/error.h"
#include "core/parallel.h"
#include "core/random.h"
#include "photon/photon_shards.h"
#include "photon/tree/kd_tree.h"
#include "support/complaint.h"
#include "support/hand_photons.h"
#include "support/little_memory.h"
#include "support/run.h"
#include "support/tree_stream.h"

namespace phos {
namespace {

using Bytes = std::vector<std::byte>;

std::vector<Vec3> some_points(std::size_t n) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i) {
    RandomStream random(2, Stage::test, i);
    points.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  return points;
}

/// What refuses the tree; empty if it is loaded, and then it finds the neighbours that there are.
std::string refusal(const std::vector<Vec3>& points, const Bytes& tree) {
  try {
    const KdTree loaded = KdTree::load(points, tree, "a.photons");
    std::vector<std::uint32_t> rows;
    for (const Vec3& p : {points.front(), points.back(), Vec3(0.5f), Vec3(2)})
      for (const float radius_m : {0.f, 0.3f, 10.f}) {
        loaded.in_sphere(p, radius_m, rows);
        const auto near = [&](const Vec3& q) { return glm::dot(q - p, q - p) <= radius_m * radius_m; };
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(std::count_if(points.begin(), points.end(), near)));
      }
    return "";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(e.where(), "a.photons");
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
}

// Where things stand in the contents of a tree over n points: the index's own members, the box, the numbers
// of points, the nodes.
constexpr std::size_t kSize = 0, kOwnPoints = 24, kNames = 33, kRemoved = 41, kReorder = 50, kBox = 63,
                      kOrderSize = 87, kOrder = 95, kNode = 21;
constexpr std::size_t kLeft = 0, kRight = 4, kAxis = 8, kLow = 12, kIsLeaf = 20;

template <class T>
void put(Bytes& bytes, std::size_t at, const T& value) {
  ASSERT_LE(at + sizeof value, bytes.size());
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

struct Fixture {
  std::vector<Vec3> points = some_points(40);
  Bytes tree = KdTree::build(points).save(), contents = test::tree_contents(tree).value();
  std::size_t root = kOrder + 4 * points.size();

  std::string refusal_of(const std::function<void(Bytes&)>& change) const {
    Bytes changed = contents;
    change(changed);
    return refusal(points, test::with_contents(tree, changed));
  }
};

TEST(Tree, EveryByteChangedIsRefusedOrHarmless) {
  const Fixture f;
  int refused = 0, harmless = 0;
  for (std::size_t i = 0; i < f.contents.size(); ++i)
    for (const int change : {0x01, 0x80, 0x10, 0xff}) {
      const std::string why = f.refusal_of([&](Bytes& b) { b[i] ^= static_cast<std::byte>(change); });
      ++(why.empty() ? harmless : refused);
    }
  EXPECT_GT(refused, harmless);
  EXPECT_GT(harmless, 0);  // the lowest bits of a plane that is not tight, members that mean nothing
}

TEST(Tree, EveryByteOfTheStreamIsRefusedOrHarmless) {
  const Fixture f;
  for (std::size_t i = 0; i < f.tree.size(); ++i)
    for (const int change : {0x01, 0x80, 0xff}) {
      Bytes tree = f.tree;
      tree[i] ^= static_cast<std::byte>(change);
      refusal(f.points, tree);
    }
  for (std::size_t n = 0; n < f.tree.size(); ++n)
    EXPECT_NE(refusal(f.points, {f.tree.begin(), f.tree.begin() + static_cast<std::ptrdiff_t>(n)}), "") << n;
  Bytes longer = f.tree;
  longer.resize(longer.size() + 8);
  EXPECT_NE(refusal(f.points, longer).find("goes on after its end"), std::string::npos);
}

TEST(Tree, UntouchedIsTaken) {
  const Fixture f;
  EXPECT_EQ(f.refusal_of([](Bytes&) {}), "");
}

// Each lie is refused for its own reason, so that the positions above are what they are said to be.
TEST(Tree, LiesAreNamed) {
  const Fixture f;
  const auto expect = [&](const char* reason, const std::function<void(Bytes&)>& change) {
    const std::string why = f.refusal_of(change);
    EXPECT_NE(why.find(reason), std::string::npos) << reason << " / " << why;
  };
  const auto with = [](std::size_t at, auto value) { return [=](Bytes& b) { put(b, at, value); }; };
  const std::size_t n = f.points.size(), root = f.root;
  std::size_t leaf = root;
  while (f.contents[leaf + kIsLeaf] == std::byte{0}) leaf += kNode;
  expect("another number of points", with(kSize, std::uint64_t{1} << 40));
  expect("points of its own", with(kOwnPoints, std::uint8_t{1}));
  expect("neither on nor off", with(kOwnPoints, std::uint8_t{7}));
  expect("names for its points", with(kNames, std::uint64_t{1} << 40));
  expect("lacks points", with(kRemoved, std::uint8_t{1}));
  expect("order of its own", with(kReorder, std::uint8_t{1}));
  expect("does not hold the photons", with(kBox, 0.5f));
  expect("does not hold the photons", with(kBox, std::nanf("")));
  expect("another number of points", with(kOrderSize, std::uint64_t{1} << 60));
  expect("is not there", with(kOrder, static_cast<std::int32_t>(n)));
  expect("is not there", with(kOrder, std::int32_t{-1}));
  expect("lists a photon twice", [&](Bytes& b) { std::memcpy(b.data() + kOrder, b.data() + kOrder + 4, 4); });
  expect("along no axis", with(root + kAxis, std::int32_t{3}));
  expect("along no axis", with(root + kAxis, std::int32_t{-1}));
  expect("plane", with(root + kLow, std::nanf("")));
  expect("plane", with(root + kLow, -1.f));
  expect("do not follow each other", with(leaf + kRight, static_cast<std::int32_t>(n + 1)));
  expect("do not follow each other", with(leaf + kRight, std::int32_t{0}));
  expect("do not follow each other", with(leaf + kLeft, std::int32_t{-5}));
  expect("do not follow each other", with(root + kIsLeaf, std::uint8_t{1}));
  expect("truncated", [&](Bytes& b) { b.erase(b.end() - kNode, b.end()); });
}

TEST(Tree, OfTwoPointsSwappedIsRefused) {
  const Fixture f;
  // The first and the last leaf hold points from both sides of a plane.
  const std::string why = f.refusal_of([&](Bytes& b) {
    std::swap_ranges(b.begin() + kOrder, b.begin() + kOrder + 4,
                     b.begin() + static_cast<std::ptrdiff_t>(kOrder + 4 * (f.points.size() - 1)));
  });
  EXPECT_NE(why.find("a plane"), std::string::npos) << why;
}

// Whoever walks such a tree, and FLANN does so by recursion, runs out of stack.
TEST(Tree, ThatIsTooDeepIsRefused) {
  const Fixture f;
  for (const std::size_t depth : {2000u, 3000u}) {
    const std::string why = f.refusal_of([&](Bytes& b) {
      const Bytes node(b.begin() + static_cast<std::ptrdiff_t>(f.root),
                       b.begin() + static_cast<std::ptrdiff_t>(f.root + kNode));
      for (std::size_t i = 0; i < depth; ++i)
        b.insert(b.begin() + static_cast<std::ptrdiff_t>(f.root), node.begin(), node.end());
    });
    EXPECT_NE(why.find("too deep"), std::string::npos) << why;
  }
}

TEST(Tree, OfAnotherKindIsRefused) {
  const Fixture f;
  for (const std::size_t at : {std::size_t{40}, std::size_t{44}, std::size_t{64}}) {
    Bytes tree = f.tree;
    tree[at] ^= std::byte{1};
    EXPECT_NE(refusal(f.points, tree).find("of another kind"), std::string::npos) << at;
  }
  Bytes tree = f.tree;
  put(tree, test::kTreeLength, std::uint64_t{1} << 40);
  EXPECT_NE(refusal(f.points, tree).find("truncated"), std::string::npos);
}

/// Points at all powers of two along each axis: as deep as FLANN gets.
TEST(Tree, AsDeepAsFlannBuildsIsTaken) {
  std::vector<Vec3> points;
  for (int axis = 0; axis < 3; ++axis)
    for (int e = -148; e < 59; ++e) {
      Vec3 p(0);
      p[axis] = std::ldexp(1.f, e);
      for (int k = 0; k < 9; ++k) points.push_back(p * (1 + 0.01f * static_cast<float>(k)));
    }
  EXPECT_NO_THROW(KdTree::load(points, KdTree::build(points).save(), "a.photons"));
}

TEST(Tree, OfManyBlocksIsTaken) {
  for (const std::size_t n : {3000u, 20000u, 200000u}) {
    const std::vector<Vec3> points = some_points(n);
    const Bytes tree = KdTree::build(points).save();
    EXPECT_EQ(refusal(points, tree), "");
    for (std::uint64_t trial = 0; trial < 60; ++trial) {
      RandomStream random(4, Stage::test, trial);
      Bytes damaged = tree;
      damaged[random.bits() % damaged.size()] ^= static_cast<std::byte>(1 << random.bits() % 8);
      refusal(points, damaged);
    }
  }
}

// A stream in memory may forget what it had no room for; a map so written lacked most of its tree.
TEST(Tree, IsSavedWholeOrThereIsNoMemory) {
  set_threads(1);  // others bring memory of their own
  const std::vector<Vec3> points = some_points(100000);
  const KdTree tree = KdTree::build(points);
  test::expect_whole_or_no_memory<Bytes>(tree.save(), [&] { return tree.save(); }, 16);
}

/// The map of a file in which one number of a column is another, checksums and all.
std::string refusal_of_map(const char* column, float value) {
  const std::string folder = test::scratch("photon_damage"), path = folder + "/a.photons";
  std::vector<Vec3> places = some_points(30);
  test::photons_on_floor(places).write(path, Provenance());
  const Container file = Container::open(path);
  ContainerWriter writer;
  std::vector<std::vector<std::byte>> kept;
  for (const auto& entry : file.tensors()) {
    const std::string& name = entry.first;
    const Tensor& t = entry.second;
    kept.emplace_back(t.bytes.begin(), t.bytes.end());
    if (name == column && t.dtype == Dtype::u8) kept.back()[7] = static_cast<std::byte>(value);
    if (name == column && t.dtype == Dtype::f32) put(kept.back(), 7 * sizeof value, value);
    const auto add = [&]<class T>(T) {
      writer.add<T>(name, {reinterpret_cast<const T*>(kept.back().data()), kept.back().size() / sizeof(T)},
                    t.shape, t.unit);
    };
    t.dtype == Dtype::f32 ? add(0.f) : t.dtype == Dtype::u32 ? add(0u) : add(std::uint8_t{0});
  }
  writer.write(folder + "/b.photons", file.provenance());
  try {
    PhotonMap::open(folder + "/b.photons");
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    return e.what();
  }
  return "";
}

TEST(Map, PhotonsThatCannotBeAreRefused) {
  EXPECT_NE(refusal_of_map("flux", std::nanf("")).find("row 2 of tensor \"flux\""), std::string::npos);
  EXPECT_NE(refusal_of_map("flux", kInfinity).find("row 2 of tensor \"flux\""), std::string::npos);
  EXPECT_NE(refusal_of_map("position", std::nanf("")).find("row 2 of tensor \"position\""),
            std::string::npos);
  EXPECT_NE(refusal_of_map("position", 2 * KdTree::kLargestCoordinate_m).find("row 2 of tensor \"position\""),
            std::string::npos);
  EXPECT_NE(refusal_of_map("distance", -1).find("row 7 of tensor \"distance\""), std::string::npos);
  EXPECT_NE(refusal_of_map("distance", std::nanf("")).find("row 7 of tensor \"distance\""),
            std::string::npos);
  EXPECT_NE(refusal_of_map("path", 4).find("row 7 of tensor \"path\""), std::string::npos);
  EXPECT_EQ(refusal_of_map("distance", kInfinity), "");
  EXPECT_NE(refusal_of_map("position", 5).find("the kd-tree"), std::string::npos);
}

TEST(Shard, PhotonsThatNoTreeCanHoldAreRefused) {
  const std::string path = test::data("damaged/photons-shard-of-one-too-far-away.photons");
  EXPECT_NE(test::complaint_of([&] { read_shards({path}); }).find("less than 1e18 m away"),
            std::string::npos);
}

}  // namespace
}  // namespace phos
