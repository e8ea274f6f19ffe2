// Broken scene files: every one loads or is an Error of one line; none crashes or hangs.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "core/random.h"
#include "scene/load.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

enum class Outcome { loads, refused };

Outcome try_load(const std::string& path, std::string* message = nullptr) {
  try {
    const Scene s = load_scene(path);
    for (const Vec3& p : s.position) EXPECT_TRUE(is_finite(p)) << path;
    for (const Vec3& n : s.normal) EXPECT_TRUE(is_finite(n)) << path;
    scene_files(path);
    return Outcome::loads;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input) << path;
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    if (message) *message = e.what();
    return Outcome::refused;
  }
}

std::string damaged(const std::string& bytes) {
  const static std::string path = test::scratch("scene_damage") + "/scene.glb";
  test::spill(path, bytes);
  return path;
}

TEST(Truncation, EveryLengthIsAnError) {
  const std::string whole = test::slurp(test::data("cornell-empty.glb"));
  for (std::size_t n = 0; n < whole.size(); n += n < 64 ? 1 : 97) {
    std::string message;
    EXPECT_EQ(try_load(damaged(whole.substr(0, n)), &message), Outcome::refused) << n;
    EXPECT_FALSE(message.empty());
  }
}

/// Flips bytes: in the header and JSON most of all, where the structure is.
void flip_bytes(const std::string& whole, std::uint32_t rounds) {
  int loaded = 0;
  for (std::uint32_t i = 0; i < rounds; ++i) {
    RandomStream random(7, Stage::test, i);
    std::string bytes = whole;
    const std::size_t reach = i % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 3000);
    for (int k = 0; k < 1 + static_cast<int>(i % 3); ++k) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<float>(reach));
      bytes[std::min(at, reach - 1)] = static_cast<char>(random.bits() & 0xff);
    }
    loaded += try_load(damaged(bytes)) == Outcome::loads;
  }
  EXPECT_GT(loaded, 0);
  EXPECT_LT(loaded, static_cast<int>(rounds));
}

TEST(Fuzz, FlippedBytesOfAnAnimatedScene) { flip_bytes(test::slurp(test::data("cube-in-a-box.glb")), 600); }
TEST(Fuzz, FlippedBytesOfATexturedScene) { flip_bytes(test::slurp(test::data("moving-light.glb")), 300); }

TEST(Fuzz, FlippedBytesOfAnObj) {
  std::string obj = "mtllib x.mtl\no a\nusemtl m\n";
  for (int i = 0; i < 20; ++i)
    obj += "v " + std::to_string(i % 3) + " " + std::to_string(i % 5) + " " + std::to_string(i) + "\n";
  for (int i = 1; i < 16; ++i)
    obj += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " -3\n";
  flip_bytes(obj, 600);
}

/// Digits to other digits and numbers to extremes, which keeps the JSON valid and makes the indices wrong.
TEST(Fuzz, WrongNumbersInTheJson) {
  const std::string whole = test::slurp(test::data("cube-in-a-box.glb"));
  std::uint32_t size;
  std::memcpy(&size, whole.data() + 12, 4);
  const std::string json = whole.substr(20, size), bin = whole.substr(28 + size);
  const char* wrong[] = {"-1",   "99999", "4294967296", "1e300", "2147483647",
                         "null", "\"x\"", "0.5",        "[]",    "{}"};
  for (std::uint32_t i = 0; i < 600; ++i) {
    RandomStream random(11, Stage::test, i);
    std::size_t at = static_cast<std::size_t>(random.uniform() * static_cast<float>(json.size()));
    while (at < json.size() && !std::isdigit(static_cast<unsigned char>(json[at]))) ++at;
    std::size_t end = at;
    while (end < json.size() && std::strchr("0123456789.eE+-", json[end])) ++end;
    if (at == end) continue;
    try_load(damaged(test::glb(json.substr(0, at) + wrong[i % 10] + json.substr(end), bin)));
  }
}

TEST(Input, TheUsualMistakesAreNamed) {
  const auto message_of = [](const std::string& bytes) {
    std::string message;
    EXPECT_EQ(try_load(damaged(bytes), &message), Outcome::refused);
    return message;
  };
  EXPECT_NE(message_of("This is a text, not a scene.\n").find("neither glTF nor OBJ"), std::string::npos);
  EXPECT_NE(message_of("").find("empty"), std::string::npos);
  EXPECT_NE(message_of("{}").find("not a glTF"), std::string::npos);
  EXPECT_NE(message_of("{\"asset\": {\"version\": \"1.0\"}}").find("convert it to 2.0"), std::string::npos);
  std::string old = test::glb("{}", "");
  old[4] = 1;
  EXPECT_NE(message_of(old).find("convert it to 2.0"), std::string::npos);
  EXPECT_NE(message_of(std::string(300, '{')).find("malformed"), std::string::npos);
  const std::string whole = test::slurp(test::data("cornell-empty.glb"));
  EXPECT_NE(message_of(whole.substr(0, whole.size() - 10)).find("truncated"), std::string::npos);
  std::string message;
  EXPECT_EQ(try_load("/nowhere/scene.glb", &message), Outcome::refused);
  EXPECT_EQ(try_load("/tmp", &message), Outcome::refused);
}

TEST(Input, VertexThatIsNotFiniteIsNamed) {
  test::Gltf g;
  Json p = g.square();
  p["attributes"]["POSITION"] = g.vec3({0, 0, 0, 1, 0, 0, 1, NAN, 0, 0, 1, 0});
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  std::string message;
  EXPECT_EQ(try_load(damaged(g.bytes()), &message), Outcome::refused);
  EXPECT_NE(message.find("mesh \"mesh\": vertex 2"), std::string::npos) << message;
}

TEST(Scale, TinyAndHugeScenesKeepTheirTriangles) {
  for (const double scale : {1e-6, 1e6}) {
    test::Gltf g;
    g.square_node();
    Json n = g.json.find("nodes")->as_array()[0];
    n["scale"] = Json::Array{scale, scale, scale};
    g.json["nodes"] = Json::Array{n};
    const Scene s = load_scene(damaged(g.bytes()));
    EXPECT_EQ(s.triangle.size(), 2u);
    EXPECT_EQ(s.normal[0], Vec3(0, 0, 1));
    EXPECT_NEAR(s.bounds.diagonal_m() / scale, std::sqrt(2), 1e-6);
  }
}

TEST(Conformance, OtherReadersTestModelsLoadOrAreRefused) {
  const std::string root = test::shared("scenes/conformance");
  if (root.empty()) GTEST_SKIP() << "the conformance models are not beside the project";
  int loaded = 0, refused = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string path = entry.path().string(), extension = entry.path().extension().string();
    if (extension != ".glb" && extension != ".gltf" && extension != ".obj") continue;
    const Outcome outcome = try_load(path);
    ++(outcome == Outcome::loads ? loaded : refused);
    const bool good = path.find("/khronos/") != std::string::npos ||
                      path.find("/external-uri/") != std::string::npos ||
                      path.find("/bevy/") != std::string::npos;
    if (good) {
      EXPECT_EQ(outcome, Outcome::loads) << path;
    }
    if (path.find("must-reject") != std::string::npos) {
      EXPECT_EQ(outcome, Outcome::refused) << path;
    }
  }
  EXPECT_GT(loaded, 90);
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace phos
