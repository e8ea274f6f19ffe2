// Clear coats and sheen are right in the mean of what they reflect.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/gltf/coats.h"
#include "scene/load.h"
#include "scene/material/bsdf.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

Scene load(const Json& material) {
  static int n = 0;
  test::Gltf g;
  g.square_node(material);
  const std::string path = test::scratch("coats" + std::to_string(n++)) + "/scene.glb";
  test::spill(path, g.bytes());
  return load_scene(path);
}

/// Mean of the albedo over the hemisphere, by sampling.
double albedo(const Scene& scene) {
  const Bsdf bsdf(scene, 0);
  constexpr int kN = 20, kSamples = 8000;
  double sum = 0;
  for (int a = 0; a < kN; ++a) {
    const float cosine = std::sqrt((static_cast<float>(a) + 0.5f) / kN);
    const Vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
    for (int b = 0; b < kSamples; ++b) {
      const auto at = [&](double g) { return static_cast<float>(std::fmod(0.5 + g * (b + 1), 1.0)); };
      BsdfSample s;
      if (bsdf.sample(wo, at(0.8191725133961645), {at(0.6710436067037893), at(0.5497004779019703)}, s))
        sum += static_cast<double>(luminance(s.weight));
    }
  }
  return sum / (kN * kSamples);
}

Json base(double grey, double metallic, double roughness, double specular = 1) {
  Json m;
  m["pbrMetallicRoughness"]["baseColorFactor"] = Json::Array{grey, grey, grey, 1};
  m["pbrMetallicRoughness"]["metallicFactor"] = metallic;
  m["pbrMetallicRoughness"]["roughnessFactor"] = roughness;
  m["extensions"]["KHR_materials_specular"]["specularFactor"] = specular;
  return m;
}

Json coated(Json m, double factor, double roughness = 0) {
  m["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = factor;
  m["extensions"]["KHR_materials_clearcoat"]["clearcoatRoughnessFactor"] = roughness;
  return m;
}

TEST(Coats, VarnishOverBlackReflectsFresnel) {
  const Scene s = load(coated(base(0, 0, 1, 0), 1));
  EXPECT_NEAR(albedo(s), 0.0857, 0.004) << "Schlick's mean of 0.04";
  const Bsdf bsdf(s, 0);
  BsdfSample branch[2];
  ASSERT_EQ(bsdf.specular_branches(Vec3(0, 0, 1), branch), 1);
  EXPECT_NEAR(luminance(branch[0].weight), 0.04, 1e-4);
}

TEST(Coats, AttenuateWhatIsBelow) {
  constexpr double kFresnel = 0.0857;
  for (const double factor : {0.2, 0.5, 1.0}) {
    for (const double grey : {0.0, 0.2, 0.8, 1.0}) {
      for (const double metallic : {0.0, 1.0}) {
        const double under = albedo(load(base(grey, metallic, 0.6)));
        const double over = albedo(load(coated(base(grey, metallic, 0.6), factor, 0.3)));
        const double wanted = factor * kFresnel + (1 - factor * kFresnel) * under;
        EXPECT_NEAR(over, wanted, 0.03) << factor << " over " << grey << ", metallic " << metallic;
        EXPECT_LE(over, 1.005);
      }
    }
  }
}

TEST(Coats, MeanSheenAlbedo) {
  double before = 0;
  for (const double roughness : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0}) {
    const double e = mean_sheen_albedo(roughness);
    EXPECT_GE(e, before) << roughness;
    EXPECT_LE(e, 1);
    before = e;
  }
  EXPECT_GT(mean_sheen_albedo(0.5), 0.05);
}

TEST(Coats, SheenIsAddedAndTakesFromTheBase) {
  const double e = mean_sheen_albedo(0.5);
  for (const double grey : {0.0, 0.5, 1.0}) {
    Json m = base(grey, 0, 1);
    const double under = albedo(load(m));
    m["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = Json::Array{1, 1, 1};
    m["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = 0.5;
    EXPECT_NEAR(albedo(load(m)), e + (1 - e) * under, 0.01) << grey;
  }
}

TEST(Coats, FactorsBeyondOneAreBadInput) {
  EXPECT_NE(test::complaint_of([] { load(coated(base(0, 0, 1), 2)); }).find("clearcoatFactor"),
            std::string::npos);
  Json m = base(0, 0, 1);
  m["extensions"]["KHR_materials_sheen"]["sheenColorFactor"] = Json::Array{1, -1, 1};
  EXPECT_NE(test::complaint_of([&] { load(m); }).find("sheenColorFactor"), std::string::npos);
}

}  // namespace
}  // namespace phos
