// Damaged and hostile measured data: every one is an Error of one line that names the file.
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "core/error.h"
#include "core/random.h"
#include "scene/load.h"
#include "scene/material/bsdf.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/merl_bytes.h"
#include "support/one_material.h"
#include "support/run.h"

using namespace phos;
using namespace phos::test;

namespace {

const std::string& whole() {
  static const std::string bytes = merl_bytes(HalfLobe{Rgb(0.5f), Rgb(0.3f), 30});
  return bytes;
}

/// The message that refuses these bytes; empty if they were taken.
std::string refusal(std::string_view bytes) {
  try {
    MerlBrdf(bytes, "paint.binary");
  } catch (const Error& e) {
    const std::string message = e.what();
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_EQ(e.where(), "paint.binary");
    return message;
  }
  return "";
}

std::string with_sample(std::size_t index, double value) {
  std::string bytes = whole();
  std::memcpy(bytes.data() + 12 + index * sizeof value, &value, sizeof value);
  return bytes;
}

/// The message with which a scene of this extras.phos.file is refused.
std::string scene_refusal(const std::string& folder, const Json& file) {
  Gltf g;
  Json m;
  m["name"] = "sample";
  m["extras"]["phos"]["brdf"] = "merl";
  if (!file.is_null()) m["extras"]["phos"]["file"] = file;
  g.square_node(m);
  spill(folder + "/scene.glb", g.bytes());
  return complaint_of([&] { load_scene(folder + "/scene.glb"); });
}

}  // namespace

TEST(MerlFile, OfAnotherLengthIsRefused) {
  for (const std::size_t n : {std::size_t{0}, std::size_t{3}, std::size_t{11}, std::size_t{12},
                              std::size_t{100}, whole().size() / 2, whole().size() - 1}) {
    EXPECT_NE(refusal(std::string_view(whole()).substr(0, n)).find("truncated"), std::string::npos) << n;
  }
  EXPECT_NE(refusal(whole() + "x").find("too long"), std::string::npos);
  EXPECT_EQ(refusal(whole()), "");
}

TEST(MerlFile, OfOtherSizesIsRefused) {
  for (const std::int32_t n : {0, 1, -1, 89, 91, 360, std::numeric_limits<std::int32_t>::max(),
                               std::numeric_limits<std::int32_t>::min()}) {
    for (const std::size_t which : {0u, 1u, 2u}) {
      std::string bytes = whole();
      std::memcpy(bytes.data() + 4 * which, &n, sizeof n);
      EXPECT_NE(refusal(bytes).find("90 x 90 x 180"), std::string::npos) << n;
    }
  }
}

TEST(MerlFile, WithValuesThatAreNotFiniteIsRefused) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double v : {inf, -inf, nan, 1e300}) {
    EXPECT_NE(refusal(with_sample(1234567, v)).find("sample 1234567 of channel 0"), std::string::npos) << v;
  }
}

TEST(MerlFile, WithoutDataIsRefused) {
  EXPECT_NE(refusal(merl_bytes([](const Vec3&, const Vec3&) { return Rgb(-1); })).find("no data"),
            std::string::npos);
}

TEST(MerlFile, BlackFaintAndBrightStayFinite) {
  for (const float scale : {0.f, 1e-30f, 1e-6f, 1e6f, 1e30f}) {
    const MerlBrdf table(merl_bytes(HalfLobe{Rgb(0.5f * scale), Rgb(0.3f * scale), 30}), "scaled");
    Scene scene;
    scene.material = {make_material(Model::measured, Rgb(0), Rgb(0))};
    scene.material[0].measured = 0;
    scene.measured = {std::make_shared<const MerlBrdf>(table)};
    const Bsdf bsdf(scene, 0);
    EXPECT_EQ(table.glossy(), scale > 0) << scale;
    for (int k = 0; k < 500; ++k) {
      RandomStream random(1, Stage::test, static_cast<std::uint64_t>(k));
      const Vec3 wo = direction(std::pow(random.uniform(), 4.f), 1);
      BsdfSample s;
      const float u_lobe = random.uniform();
      if (bsdf.sample(wo, u_lobe, random.uniform2(), s)) {
        EXPECT_TRUE(is_finite(s.weight) && is_finite(s.direction) && s.density > 0) << scale;
        EXPECT_GE(std::min({s.weight.x, s.weight.y, s.weight.z}), 0) << scale;
      }
      if (bsdf.sample_gloss(wo, random.uniform2(), s)) {
        EXPECT_TRUE(is_finite(s.weight)) << scale;
      }
    }
  }
}

TEST(MerlFile, MustLieBesideTheSceneOrBelow) {
  const std::string folder = scratch("scene_merl_paths");
  std::filesystem::create_directories(folder + "/inner/deep");
  spill(folder + "/paint.binary", whole());
  spill(folder + "/inner/deep/paint.binary", whole());
  spill(folder + "/inner/short.binary", whole().substr(0, 1000));
  const std::string inner = folder + "/inner";
  for (const char* outside : {"../paint.binary", "deep/../../paint.binary", "%2e%2e/paint.binary",
                              "./../paint.binary", "", "..", "file:paint.binary", "C:/paint.binary"}) {
    EXPECT_NE(scene_refusal(inner, outside).find("relative path"), std::string::npos) << outside;
  }
  EXPECT_NE(scene_refusal(inner, folder + "/paint.binary").find("relative path"), std::string::npos);
  EXPECT_EQ(scene_refusal(inner, "deep/paint.binary"), "");
  EXPECT_NE(scene_refusal(inner, "not-there.binary").find("not-there.binary"), std::string::npos);
  EXPECT_NE(scene_refusal(inner, "deep").find("not a file"), std::string::npos);
  EXPECT_NE(scene_refusal(inner, "short.binary").find("truncated"), std::string::npos);
  EXPECT_NE(scene_refusal(inner, 7).find("file"), std::string::npos);
  EXPECT_NE(scene_refusal(inner, Json()).find("file"), std::string::npos);
}
