// docs/scenes.md says what phos makes of scene files, from the table that the loaders use.
#include <gtest/gtest.h>

#include "scene/report/features.h"
#include "support/page.h"

namespace phos {
namespace {

TEST(SceneFeatures, TheDocumentHoldsTheTables) {
  test::expect_rest("docs/scenes.md", "tables", feature_tables());
}

TEST(SceneFeatures, EveryRowSaysWhatIsDone) {
  for (const Feature& f : scene_features()) {
    EXPECT_FALSE(f.name.empty());
    const bool sentence = f.state == Feature::State::told || f.state == Feature::State::in_part;
    EXPECT_TRUE(!sentence || !f.sentence.empty()) << f.name;
    EXPECT_EQ(f.sentence.find('|'), std::string::npos) << f.name;
  }
}

TEST(SceneFeatures, RatifiedExtensionsAreAllThere) {
  for (const char* name : {"KHR_animation_pointer",
                           "KHR_draco_mesh_compression",
                           "KHR_lights_punctual",
                           "KHR_materials_anisotropy",
                           "KHR_materials_clearcoat",
                           "KHR_materials_diffuse_transmission",
                           "KHR_materials_dispersion",
                           "KHR_materials_emissive_strength",
                           "KHR_materials_ior",
                           "KHR_materials_iridescence",
                           "KHR_materials_pbrSpecularGlossiness",
                           "KHR_materials_sheen",
                           "KHR_materials_specular",
                           "KHR_materials_transmission",
                           "KHR_materials_unlit",
                           "KHR_materials_variants",
                           "KHR_materials_volume",
                           "KHR_mesh_quantization",
                           "KHR_node_visibility",
                           "KHR_texture_basisu",
                           "KHR_texture_transform",
                           "KHR_xmp_json_ld",
                           "EXT_lights_ies",
                           "EXT_lights_image_based",
                           "EXT_mesh_gpu_instancing",
                           "EXT_meshopt_compression",
                           "EXT_texture_webp"})
    EXPECT_NE(find_extension(name), nullptr) << name;
}

TEST(SceneFeatures, WhatMayBeRequired) {
  for (const char* name : {"KHR_lights_punctual", "EXT_mesh_gpu_instancing", "KHR_node_visibility",
                           "KHR_materials_clearcoat", "KHR_materials_unlit", "KHR_xmp_json_ld"})
    EXPECT_TRUE(can_be_required(name)) << name;
  for (const char* name : {"KHR_draco_mesh_compression", "KHR_texture_basisu", "ACME_louvre", "any"})
    EXPECT_FALSE(can_be_required(name)) << name;
}

}  // namespace
}  // namespace phos
