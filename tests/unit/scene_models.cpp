// The table of reflection models, and what is asked of it.
#include <gtest/gtest.h>

#include <set>

#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/material/sharp_materials.h"
#include "scene/report/describe.h"
#include "support/one_material.h"

using namespace phos;
using namespace phos::test;

TEST(Models, RowsStandInTheOrderOfTheModels) {
  EXPECT_STREQ(model_name(Model::metallic_roughness), "metallic-roughness");
  EXPECT_STREQ(model_name(Model::phong), "phong");
  EXPECT_STREQ(model_name(Model::thin_dielectric), "thindielectric");
  EXPECT_STREQ(model_name(Model::measured), "merl");
  EXPECT_STREQ(model_name(Model::oren_nayar), "oren-nayar");
}

TEST(Models, EveryRowIsComplete) {
  std::set<std::string> names;
  for (const ModelRow& row : model_rows()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_NE(row.resolve, nullptr) << row.name;
    EXPECT_NE(row.summarise, nullptr) << row.name;
    EXPECT_EQ(model_named(row.name) != nullptr, row.stated) << row.name;
  }
  EXPECT_EQ(model_named("velvet"), nullptr);
}

TEST(Models, StatedOnesAreFoundByName) {
  for (std::size_t i = 0; i < model_rows().size(); ++i) {
    const Model* model = model_named(model_rows()[i].name);
    if (model) {
      EXPECT_EQ(*model, static_cast<Model>(i));
    }
  }
}

TEST(Models, GlassTransmitsAndOnlySolidGlassBendsLight) {
  for (std::size_t i = 0; i < model_rows().size(); ++i) {
    const auto model = static_cast<Model>(i);
    const Scene scene = scene_of(make_material(model, Rgb(0.5f), Rgb(0)));
    const Material& m = scene.material[0];
    const bool solid = model == Model::dielectric, pane = model == Model::thin_dielectric;
    EXPECT_EQ(is_solid_glass(m), solid) << model_rows()[i].name;
    EXPECT_EQ(passes_straight(scene, m), pane) << model_rows()[i].name;
    EXPECT_EQ(transmits(scene, m), solid || pane) << model_rows()[i].name;
  }
  Material sheet = make_material(Model::metallic_roughness, Rgb(0.5f), Rgb(0));
  sheet.transmission = 0.5f;
  EXPECT_TRUE(transmits(scene_of(sheet), sheet));
}

TEST(Models, SignedGlossIsSaidToTakeFromTheLambertPart) {
  for (const Named& named : models()) {
    const Scene scene = scene_of(named.material);
    const Bsdf bsdf(scene, flat_point());
    float least = 0;
    for (float o = 0.05f; o < 1; o += 0.1f)
      for (float i = 0.05f; i < 1; i += 0.1f) {
        const Rgb gloss = bsdf.evaluate_gloss(direction(o, 0), direction(i, 1));
        least = std::min(least, std::min(gloss.x, std::min(gloss.y, gloss.z)));
      }
    EXPECT_TRUE(least > -1e-6f || row_of(named.material).takes_from_lambert) << named.name << " " << least;
  }
}
