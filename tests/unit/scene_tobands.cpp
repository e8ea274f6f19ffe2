// Scenes in bands: lumens stay, what is grey stays grey, spectra go where they belong, and what is refused.
#include "scene/spectral/to_bands.h"

#include <gtest/gtest.h>

#include "scene/material/merl.h"
#include "scene/sky/environment.h"
#include "scene/spectral/bands.h"
#include "scene/spectral/reflectance.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/luminaires.h"
#include "support/one_material.h"
#include "support/run.h"
#include "support/scenes.h"

namespace phos::test {
namespace {

constexpr int kBands = 39, kTriplets = 13;

BandOptions triplet(int k, std::vector<std::string> spectra = {}, int number = kBands) {
  BandOptions o;
  o.number = number, o.triplet = k, o.spectra = std::move(spectra);
  return o;
}

Scene in_bands(Scene scene, const BandOptions& options) {
  to_bands(scene, options);
  finalize(scene);
  return scene;
}

std::string file_of(const std::string& rows) {
  static int number = 0;
  const std::string path = scratch("scene_tobands" + std::to_string(++number)) + "/spectrum.csv";
  spill(path, "wavelength_nm,value\n" + rows);
  return path;
}

/// A floor, a lamp on the ceiling that shines by its material, and a bulb.
Scene room(const Rgb& paint = Rgb(0.5f), const Rgb& lamp_cd_m2 = Rgb(100), const Rgb& bulb_cd = Rgb(20)) {
  Scene scene;
  const std::uint32_t grey = add_lambert(scene, "paint", 0.5f), tube = add_lambert(scene, "tube", 0);
  scene.material[grey].kd = paint;
  scene.material[tube].emission = lamp_cd_m2;
  begin_instance(scene, "floor", grey);
  add_quad(scene, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  begin_instance(scene, "ceiling lamp", tube);
  add_quad(scene, {-0.1f, 2, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f});
  add_point_light(scene, {0, 1, 0}, 1);
  scene.light.back().name = "bulb";
  scene.light.back().intensity = bulb_cd;
  return scene;
}

double lumens(const Scene& scene, const std::string& name) {
  for (const Light& l : scene.light)
    if (l.name == name) return static_cast<double>(luminance(l.flux_lm));
  return 0;
}

std::string usage_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.where() + ": " + e.what();
  }
  return "";
}

}  // namespace

/// The triplets' lumens add up to those of RGB, whatever the spectrum and however coloured the light is in
/// RGB.
TEST(ToBands, LumensStay) {
  Scene rgb = room(Rgb(0.5f), {100, 70, 20}, {5, 10, 30});
  const Scene before = rgb;
  finalize(rgb);
  for (const int number : {12, 39, 40}) {
    const std::vector<std::string> none,
        all{"tube=" + data("spectra/fluorescent-fl11.csv"), "bulb=" + data("spectra/sodium.csv")};
    for (const auto& spectra : {none, all}) {
      double tube = 0, bulb = 0;
      for (int k = 1; k <= (number + 2) / 3; ++k) {
        const Scene scene = in_bands(before, triplet(k, spectra, number));
        tube += lumens(scene, "ceiling lamp"), bulb += lumens(scene, "bulb");
      }
      // With a spectrum exactly; by RGB as exactly as the colour can be made (12 bands: nearly).
      const double most = spectra.empty() && number == 12 ? 2e-3 : 2e-5;
      EXPECT_NEAR(tube / lumens(rgb, "ceiling lamp"), 1, most) << number;
      EXPECT_NEAR(bulb / lumens(rgb, "bulb"), 1, most) << number;
    }
  }
}

/// White light in every triplet is the same light times its share, and grey paint is grey.
TEST(ToBands, GreyScenesStayGrey) {
  const Bands bands(kBands);
  for (int k = 1; k <= kTriplets; ++k) {
    const Scene scene = in_bands(room(), triplet(k));
    EXPECT_EQ(scene.material[0].kd, Rgb(0.5f));
    const Rgb white = BandColours(bands, k).white_light();
    EXPECT_LT(glm::length(scene.material[1].emission / (100.f * white) - Rgb(1)), 1e-6f);
    for (const Light& l : scene.light)
      if (l.name == "bulb") {
        EXPECT_LT(glm::length(l.intensity / (20.f * white) - Rgb(1)), 1e-6f);
      }
    EXPECT_TRUE(scene.warnings.empty());
  }
}

/// The feet of a lamp's spectrum that are next to nothing are left out, and this is counted.
TEST(ToBands, LampsHaveNoEndlessFeet) {
  const std::string lamp = file_of("500,1e-20\n520,1e-20\n540,1\n560,1\n");
  const Scene dark = in_bands(room(), triplet(4, {"tube=" + lamp, "bulb=" + lamp})),
              lit = in_bands(room(), triplet(5, {"tube=" + lamp, "bulb=" + lamp}));
  EXPECT_TRUE(dark.light.empty());
  EXPECT_EQ(dark.events.count("bands in which a lamp has too little of its lumens (1e-12), left dark"), 1u);
  EXPECT_EQ(lit.light.size(), 2u);
}

TEST(ToBands, SpectraOfPaintsAreTheirMeans) {
  const Bands bands(kBands);
  const std::string file = data("spectra/cornell-green.csv");
  const std::vector<double> means = bands.means(read_spectrum(file, SpectrumKind::reflectance));
  for (int k = 1; k <= kTriplets; ++k) {
    const Scene scene = in_bands(room(Rgb(0.1f, 0.4f, 0.1f)), triplet(k, {"paint=" + file}));
    EXPECT_EQ(scene.material[0].kd, Rgb(bands.triplet_of(means, k)));
  }
}

TEST(ToBands, SpectraReachTheRightFieldOfEachModel) {
  const std::string file = file_of("400,0.25\n700,0.25\n");
  for (const Model model : {Model::lambert, Model::phong, Model::ward, Model::plastic,
                            Model::metallic_roughness, Model::oren_nayar}) {
    Scene scene = room(Rgb(0.6f));
    scene.material[0].model = model, scene.material[0].ks = Rgb(0.1f), scene.material[0].alpha_x = 0.2f;
    scene.material[0].alpha_y = 0.2f;
    scene = in_bands(std::move(scene), triplet(6, {"paint=" + file}));
    EXPECT_EQ(scene.material[0].kd, Rgb(0.25f));
    EXPECT_EQ(scene.material[0].ks, Rgb(0.1f));
  }
  for (const Model model : {Model::mirror, Model::conductor}) {
    Scene scene = room(Rgb(0));
    scene.material[0].model = model, scene.material[0].ks = Rgb(0.9f, 0.6f, 0.3f);
    scene = in_bands(std::move(scene), triplet(6, {"paint=" + file}));
    EXPECT_EQ(scene.material[0].ks, Rgb(0.25f));
  }
}

/// Saturated red beside white gloss: in the red bands their sum would be above 1.
TEST(ToBands, NoPaintReflectsMoreThanItGets) {
  bool cut = false;
  for (int k = 1; k <= kTriplets; ++k) {
    Scene scene = room({0.9f, 0.05f, 0.05f});
    scene.material[0].model = Model::phong, scene.material[0].ks = Rgb(0.1f), scene.material[0].exponent = 20;
    scene = in_bands(std::move(scene), triplet(k));
    EXPECT_LE(max_component(scene.material[0].kd + scene.material[0].ks), 1.0001f);
    cut |= scene.events.count("bands in which kd + ks was cut to 1") > 0;
  }
  EXPECT_TRUE(cut);
}

TEST(ToBands, TexturesAndVertexColoursAreConverted) {
  Scene scene = room();
  Texture texture;
  texture.width = 2, texture.height = 1, texture.srgb = true;
  texture.codes = {{255, 0, 0, 128}, {128, 128, 128, 255}};
  scene.texture = {texture, texture};
  scene.texture[1].srgb = false;
  scene.material[0].base_colour.texture = 0, scene.material[0].normal.texture = 1;
  scene.colour.assign(scene.position.size(), Vec4(0.3f, 0.2f, 0.1f, 0.5f));
  scene.uv0.assign(scene.position.size(), Vec2(0));
  const Bands bands(kBands);
  const BandColours colours(bands, 9);
  to_bands(scene, triplet(9));
  ASSERT_EQ(scene.texture[0].size(), 2u);
  EXPECT_NEAR(scene.texture[0].texel(0).w, 128.f / 255, 1e-6f);
  EXPECT_LT(glm::length(Rgb(scene.texture[0].texel(0)) - colours.reflectance({1, 0, 0})), 1e-3f);
  EXPECT_LT(glm::length(Rgb(scene.texture[0].texel(1)) - Rgb(texture.texel(1))), 1e-5f);
  EXPECT_EQ(scene.texture[1].codes, texture.codes) << "normals are no colours";
  EXPECT_EQ(scene.colour[0].w, 0.5f);
  EXPECT_LT(glm::length(Rgb(scene.colour[0]) - colours.reflectance({0.3f, 0.2f, 0.1f})), 0.02f);
}

TEST(ToBands, MeasuredDataAreConverted) {
  Material material;
  material.model = Model::measured;
  material.measured = kMeasuredHalfLobe;
  Scene scene = scene_of(material);
  const Vec3 o = glm::normalize(Vec3(0.2f, 0, 1)), i = glm::normalize(Vec3(-0.1f, 0.3f, 1));
  const Rgb before = scene.measured[kMeasuredHalfLobe]->evaluate(o, i);
  const Bands bands(kBands);
  DVec3 rgb(0);
  for (int k = 1; k <= kTriplets; ++k) {
    Scene other = scene;
    to_bands(other, triplet(k));
    const Rgb value = other.measured[kMeasuredHalfLobe]->evaluate(o, i);
    const Rgb white = BandColours(bands, k).white_light();
    for (int c = 0; c < 3; ++c) rgb += static_cast<double>(white[c] * value[c]) * bands.rgb_of(k, c);
    EXPECT_EQ(other.measured[kMeasuredHalfLobe]->contents(), scene.measured[kMeasuredHalfLobe]->contents());
  }
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(rgb[c], static_cast<double>(before[c]), 0.002 * static_cast<double>(before[c]));
}

TEST(ToBands, LuminairesAndSkiesKeepTheirLight) {
  Scene scene = room();
  hang_luminaire(scene, luminaire(lopsided()), {"lamp", hanging_down({0, 2, 0}, {1, 0, 0}, 1), Rgb(2, 1, 1)},
                 LuminairesAs::points);
  Environment::Sun sun;
  sun.radius_rad = 0.01, sun.illuminance_lx = Rgb(1000);
  Environment sky(2, 1, {Rgb(3, 4, 5), Rgb(1)}, 0, sun);
  sky.set_recipe("a sky");
  scene.environment = std::make_shared<const Environment>(sky);
  Scene rgb = scene;
  finalize(rgb);
  for (const std::vector<std::string>& spectra :
       {std::vector<std::string>{},
        {"lamp=" + data("spectra/led.csv"), "environment=" + data("spectra/fluorescent-fl2.csv")}}) {
    double lamp = 0, light = 0;
    std::vector<std::string> recipes;
    for (int k = 1; k <= kTriplets; ++k) {
      const Scene s = in_bands(scene, triplet(k, spectra));
      lamp += lumens(s, "lamp"), light += lumens(s, "environment");
      recipes.push_back(s.environment->recipe());
      EXPECT_TRUE(s.environment->sun());
    }
    EXPECT_NEAR(lamp / lumens(rgb, "lamp"), 1, 2e-5);
    EXPECT_NEAR(light / lumens(rgb, "environment"), 1, 2e-5);
    EXPECT_NE(recipes[3], recipes[4]);
  }
}

TEST(ToBands, IsPartOfTheScenesHash) {
  Scene rgb = room();
  finalize(rgb);
  EXPECT_EQ(rgb.parts.find("bands"), nullptr);
  const Scene a = in_bands(room(), triplet(4)), again = in_bands(room(), triplet(4)),
              b = in_bands(room(), triplet(5)),
              led = in_bands(room(), triplet(4, {"tube=" + data("spectra/led.csv")}));
  EXPECT_EQ(a.hash, again.hash);
  EXPECT_NE(a.hash, rgb.hash);
  EXPECT_NE(a.hash, b.hash);
  EXPECT_NE(a.hash, led.hash);
  ASSERT_NE(a.parts.find("bands"), nullptr);
  EXPECT_EQ(a.parts.find("bands")->find("triplet")->as_integer(), 4);
  // Black in two triplets: still two scenes.
  const std::vector<std::string> dark{"tube=" + data("spectra/sodium.csv"),
                                      "bulb=" + data("spectra/sodium.csv")};
  const Scene dark_1 = in_bands(room(Rgb(0)), triplet(1, dark)),
              dark_2 = in_bands(room(Rgb(0)), triplet(2, dark));
  EXPECT_TRUE(dark_1.light.empty());
  EXPECT_TRUE(dark_1.warnings.empty()) << dark_1.warnings[0].line();
  EXPECT_NE(dark_1.hash, dark_2.hash);
}

TEST(ToBands, NamesAreFoundOrRefused) {
  const std::string led = data("spectra/led.csv");
  const auto refusal = [&](Scene scene, const std::vector<std::string>& spectra) {
    return usage_of([&] { to_bands(scene, triplet(4, spectra)); });
  };
  EXPECT_EQ(refusal(room(), {"ceiling lamp=" + led}), "") << "a node whose material shines";
  const std::string unknown = refusal(room(), {"nobody=" + led});
  EXPECT_NE(unknown.find("\"bulb\", \"paint\", \"tube\""), std::string::npos) << unknown;
  EXPECT_NE(refusal(room(), {"tube=" + led, "tube=" + led}).find("twice"), std::string::npos);
  EXPECT_NE(refusal(room(), {"tube"}).find("NAME=FILE"), std::string::npos);
  EXPECT_NE(refusal(room(), {"environment=" + led}).find("no light or material"), std::string::npos);
  Scene both = room();
  both.material[0].name = "bulb";
  EXPECT_NE(refusal(both, {"bulb=" + led}).find("both"), std::string::npos);
  Scene glass = room();
  glass.material[0].model = Model::thin_dielectric;
  EXPECT_NE(refusal(glass, {"paint=" + data("spectra/pigment-a.csv")}).find("glass"), std::string::npos);
}

/// A lamp that an animation has switched off just now is a lamp still.
TEST(ToBands, LampsThatAreOffAreLamps) {
  Scene scene = room(Rgb(0.5f), Rgb(0));
  scene.material[1].kd = Rgb(0.25f);
  Animation blinking;
  blinking.targets = {"/materials/1/extensions/KHR_materials_emissive_strength/emissiveStrength"};
  scene.animation.push_back(blinking);
  const std::string led = file_of("400,0\n500,70\n600,0\n");
  for (const char* name : {"tube=", "ceiling lamp="}) {
    Scene off = scene;
    to_bands(off, triplet(6, {name + led}));
    EXPECT_EQ(off.material[1].kd, Rgb(0.25f));
    EXPECT_EQ(off.material[1].emission, Rgb(0));
  }
}

TEST(ToBands, SpectraThatDoNotMeetAreRefused) {
  const std::string blue = file_of("400,0.2\n480,0.3\n"), sodium = data("spectra/sodium.csv");
  const std::string refusal = complaint_of([&] {
    Scene scene = room();
    to_bands(scene, triplet(4, {"paint=" + blue, "tube=" + sodium}));
  });
  EXPECT_NE(refusal.find("400 to 480 nm, hold nothing of the light of"), std::string::npos) << refusal;
  EXPECT_NE(complaint_of([&] {
              Scene scene = room();
              to_bands(scene, triplet(4, {"paint=" + file_of("800,0.2\n900,0.3\n")}));
            }).find("do not overlap 380 to 780"),
            std::string::npos);
  EXPECT_NE(complaint_of([&] {
              Scene scene = room();
              to_bands(scene, triplet(4, {"tube=/nowhere.csv"}));
            }).size(),
            0u);
}

TEST(BandOptions, AreChecked) {
  BandOptions o;
  EXPECT_EQ(usage_of([&] { check(o); }), "");
  o.triplet = 1;
  EXPECT_NE(usage_of([&] { check(o); }).find("--bands"), std::string::npos);
  o = triplet(0);
  EXPECT_NE(usage_of([&] { check(o); }).find("1 to 13"), std::string::npos);
  o = triplet(14);
  EXPECT_NE(usage_of([&] { check(o); }).find("13 triplets"), std::string::npos);
  o = triplet(1, {}, 2);
  EXPECT_NE(usage_of([&] { check(o); }).find("3 to 400"), std::string::npos);
  o = BandOptions();
  o.spectra = {"a=b"};
  EXPECT_NE(usage_of([&] { check(o); }).find("needs --bands"), std::string::npos);
  const BandOptions some = triplet(5, {"a=b"});
  BandOptions read;
  const std::vector<std::string> words = band_words(some);
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) read_band_word(words[i], words[i + 1], read);
  EXPECT_EQ(read.number, some.number);
  EXPECT_EQ(read.triplet, some.triplet);
  EXPECT_EQ(read.spectra, some.spectra);
}

/// extras.phos.spectrum of materials and lights names a file beside the scene; RGB does not look at it.
TEST(GltfSpectra, AreReadFromBesideTheScene) {
  const auto scene_with = [](const std::string& of_material, const std::string& of_light) {
    Gltf g;
    Json material;
    material["name"] = "paint";
    material["extras"]["phos"]["spectrum"] = of_material;
    g.square_node(material);
    Json light;
    light["type"] = "point", light["name"] = "bulb";
    light["extras"]["phos"]["spectrum"] = of_light;
    g.json["extensionsUsed"] = Json::Array{"KHR_lights_punctual"};
    g.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::Array{light};
    Json node;
    node["translation"] = Json::Array{0.5, 0.5, 1};
    node["extensions"]["KHR_lights_punctual"]["light"] = 0;
    g.node(node);
    return g;
  };
  const std::string folder = scratch("scene_gltfspectra");
  for (const char* name : {"pigment-a.csv", "led.csv"})
    std::filesystem::copy_file(data(std::string("spectra/") + name), folder + "/" + name);
  spill(folder + "/scene.glb", scene_with("pigment-a.csv", "led.csv").bytes());
  const Scene rgb = load_scene(folder + "/scene.glb");
  EXPECT_EQ(scene_files(folder + "/scene.glb").size(), 1u);
  SceneOptions options;
  options.bands = triplet(7);
  const Scene scene = load_scene(folder + "/scene.glb", options);
  EXPECT_EQ(scene_files(folder + "/scene.glb", options).size(), 3u);
  const Bands bands(kBands);
  EXPECT_EQ(scene.material[0].kd,
            Rgb(bands.triplet_of(
                bands.means(read_spectrum(folder + "/pigment-a.csv", SpectrumKind::reflectance)), 7)));
  ASSERT_EQ(scene.light.size(), 1u);
  const std::vector<double> shares =
      bands.luminous_shares(read_spectrum(folder + "/led.csv", SpectrumKind::power));
  EXPECT_NEAR(luminance(scene.light[0].intensity), shares[18] + shares[19] + shares[20], 1e-6);
  EXPECT_EQ(luminance(rgb.light[0].intensity), 1);

  spill(folder + "/bad.glb", scene_with("../pigment-a.csv", "led.csv").bytes());
  EXPECT_NE(complaint_of([&] { load_scene(folder + "/bad.glb", options); }).find("beside the scene"),
            std::string::npos);
  spill(folder + "/missing.glb", scene_with("pigment-a.csv", "none.csv").bytes());
  EXPECT_NE(complaint_of([&] { load_scene(folder + "/missing.glb", options); }).size(), 0u);
}

}  // namespace phos::test
