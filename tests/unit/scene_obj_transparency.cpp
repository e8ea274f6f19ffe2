// Transparency in MTL: what a leaf between a lamp and a floor lets through, straight down.
#include <gtest/gtest.h>

#include "core/error.h"
#include "scene/load.h"
#include "scene/material/passage.h"
#include "support/run.h"

namespace phos {
namespace {

/// Uncompressed Targa, all texels alike; 4 channels where `alpha` is given.
std::string targa(int size, int grey, int alpha = -1) {
  std::string bytes(18, '\0');
  bytes[2] = 2;
  bytes[12] = bytes[14] = static_cast<char>(size);
  bytes[16] = alpha < 0 ? 24 : 32;
  bytes[17] = alpha < 0 ? 0x20 : 0x28;
  for (int i = 0; i < size * size; ++i) {
    bytes.append(3, static_cast<char>(grey));
    if (alpha >= 0) bytes.push_back(static_cast<char>(alpha));
  }
  return bytes;
}

constexpr const char* kSheet =
    "o floor\nusemtl floor\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "f 1/1 2/2 3/3 4/4\no leaf\nusemtl leaf\n"
    "v -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 1 -1\nf 5/1 6/2 7/3 8/4\n";
/// A plate 1 cm thick; `faces` in its own group each.
std::string plate(bool inside_out, bool open = false) {
  std::string obj =
      "usemtl leaf\nv -1 1 1\nv 1 1 1\nv 1 1 -1\nv -1 1 -1\nv -1 1.01 1\nv 1 1.01 1\nv 1 1.01 -1\nv -1 1.01 "
      "-1\n";
  const std::vector<std::array<int, 4>> faces = {{4, 3, 2, 1}, {5, 6, 7, 8}, {1, 2, 6, 5},
                                                 {2, 3, 7, 6}, {3, 4, 8, 7}, {4, 1, 5, 8}};
  for (std::size_t i = open ? 2 : 0; i < faces.size(); ++i) {
    std::array<int, 4> f = faces[i];
    if (inside_out) std::swap(f[1], f[3]);
    obj += text("g face", i, "\nf ", f[0], " ", f[1], " ", f[2], " ", f[3], "\n");
  }
  return obj;
}

class ObjTransparency : public ::testing::Test {
 protected:
  std::string folder = test::scratch("scene_obj_transparency");

  Scene load(const std::string& leaf, const std::string& obj = kSheet) {
    test::spill(folder + "/x.mtl", "newmtl floor\nKd 0 0 0\nnewmtl leaf\nKd 0.5 0.5 0.5\n" + leaf);
    test::spill(folder + "/x.obj", "mtllib x.mtl\n" + obj);
    return load_scene(folder + "/x.obj");
  }
  /// Of light straight down.
  static Rgb passes(const Scene& scene) {
    const RayScene rays(scene);
    Ray ray;
    ray.origin = Vec3(0.1f, 2, 0.2f), ray.direction = Vec3(0, -1, 0);
    SurfacePoint point;
    Rgb share;
    if (!trace_straight(rays, ray, point, share)) return share;
    return point.position.y < 0.5f ? share : Rgb(0);
  }
  float share(const std::string& leaf, const std::string& obj = kSheet) { return passes(load(leaf, obj)).y; }
  static const Material& leaf(const Scene& scene) { return scene.material.at(1); }
  static int warned(const Scene& scene, const std::string& what) {
    int n = 0;
    for (const Note& w : scene.warnings) n += w.line().find(what) != std::string::npos;
    return n;
  }
};

TEST_F(ObjTransparency, DissolveIsTheShareThatIsThere) {
  EXPECT_FLOAT_EQ(share("d 0.1\n"), 0.9f);
  EXPECT_FLOAT_EQ(share("Tr 0.9\n"), 0.9f);
  EXPECT_FLOAT_EQ(share("d 1\n"), 0);
  EXPECT_FLOAT_EQ(share("Tr 0\nd 1\nTf 1 1 1\nNi 1.5\nillum 2\n"), 0);
  EXPECT_FLOAT_EQ(share("d 0.25\nKs 0.2 0.2 0.2\nNs 20\nillum 2\n"), 0.75f);
  const Scene scene = load("Tr 0.25\nKs 0.2 0.2 0.2\nNs 20\nillum 2\n");
  EXPECT_EQ(leaf(scene).alpha_mode, Material::Alpha::blend);
  EXPECT_EQ(leaf(scene).model, Model::phong);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0].line();
}

TEST_F(ObjTransparency, DWinsAndContradictionsAreTold) {
  const Scene scene = load("Tr 1\nd 1\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0);
  EXPECT_EQ(warned(scene, "contradict"), 1);
  EXPECT_EQ(warned(load("Tr 0.3\nd 0.7\n"), "contradict"), 0);
}

TEST_F(ObjTransparency, DOfZeroLeavesNothingAndIsTold) {
  const Scene scene = load("d 0\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 1);
  EXPECT_EQ(warned(scene, "it is invisible"), 1);
  EXPECT_EQ(warned(load("Tr 1\n"), "it is invisible"), 1);
  EXPECT_FLOAT_EQ(share("d -3\n"), 1);
  EXPECT_FLOAT_EQ(share("d 7\n"), 0);
  EXPECT_FLOAT_EQ(share("d nan\n"), 0);
}

TEST_F(ObjTransparency, HaloIsToldAndItsFactorTaken) {
  const Scene scene = load("d -halo 0.4\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0.6f);
  EXPECT_EQ(warned(scene, "-halo"), 1);
}

TEST_F(ObjTransparency, MapOfCoverage) {
  test::spill(folder + "/none.tga", targa(4, 0));
  test::spill(folder + "/grey.tga", targa(4, 51));        // 0.2, not decoded from sRGB
  test::spill(folder + "/cut.tga", targa(2, 255, 102));   // an alpha of 0.4
  test::spill(folder + "/alone.tga", targa(2, 0, 102));   // alpha, and no colour
  test::spill(folder + "/whole.tga", targa(2, 51, 255));  // an alpha that says nothing
  test::spill(folder + "/wood.tga", targa(8, 128));
  EXPECT_FLOAT_EQ(share("map_d none.tga\n"), 1);
  EXPECT_FLOAT_EQ(share("map_d grey.tga\n"), 0.8f);
  EXPECT_FLOAT_EQ(share("map_d grey.tga\nd 0.5\n"), 0.9f);
  EXPECT_FLOAT_EQ(share("map_d cut.tga\n"), 0.6f);
  EXPECT_FLOAT_EQ(share("map_d alone.tga\n"), 0.6f);
  EXPECT_FLOAT_EQ(share("map_d whole.tga\n"), 0.8f);
  EXPECT_FLOAT_EQ(share("map_d -imfchan l cut.tga\n"), 0);
  EXPECT_FLOAT_EQ(share("map_d -clamp on -s 2 2 1 grey.tga\n"), 0.8f);
  const Scene scene = load("map_Kd wood.tga\nmap_d grey.tga\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0.8f);
  const Texture& joined = scene.texture.at(static_cast<std::size_t>(leaf(scene).base_colour.texture));
  EXPECT_EQ(joined.width, 8);
  EXPECT_NEAR(joined.texel(0).x, 0.2159f, 1e-3);  // 128 of sRGB
  EXPECT_NEAR(joined.texel(0).w, 0.2f, 1e-6);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0].line();
}

TEST_F(ObjTransparency, MapOfCoverageLargerThanTheColours) {
  test::spill(folder + "/fine.tga", targa(16, 51));
  test::spill(folder + "/wood.tga", targa(8, 128));
  const Scene scene = load("map_Kd wood.tga\nmap_d fine.tga\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0.8f);
  const Texture& joined = scene.texture.at(static_cast<std::size_t>(leaf(scene).base_colour.texture));
  EXPECT_EQ(joined.width, 16);
  EXPECT_NEAR(joined.texel(100).x, 0.2159f, 1e-3);
}

TEST_F(ObjTransparency, AnAlphaOfMapKdSaysNothing) {
  test::spill(folder + "/cut.tga", targa(2, 255, 102));
  EXPECT_FLOAT_EQ(share("map_Kd cut.tga\n"), 0);
  EXPECT_FLOAT_EQ(share("map_Kd cut.tga\nd 0.5\n"), 0.5f);
  EXPECT_FLOAT_EQ(share("map_Kd cut.tga\nmap_d cut.tga\n"), 0.6f);
}

TEST_F(ObjTransparency, AMapOfCoverageThatCannotBeReadIsTold) {
  const Scene scene = load("map_d nowhere.png\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0);
  EXPECT_EQ(leaf(scene).alpha_mode, Material::Alpha::opaque);
  EXPECT_EQ(warned(scene, "texture not found: nowhere.png"), 1);
  const Scene share = load("map_d nowhere.png\nd 0.5\n");
  EXPECT_FLOAT_EQ(passes(share).y, 0.5f);
}

TEST_F(ObjTransparency, ASheetOfGlassIsAPane) {
  for (const char* illum : {"4", "6", "7", "9"}) {
    // Index 1.5: 2 n / (n^2 + 1) = 0.923.
    EXPECT_NEAR(share(text("illum ", illum, "\nNi 1.5\nTf 1 1 1\n")), 3 / 3.25, 1e-4) << illum;
    EXPECT_NEAR(share(text("Ni 1.5\nillum ", illum, "\n")), 3 / 3.25, 1e-4) << illum;
    EXPECT_NEAR(share(text("Ni 1.5\nd 0\nillum ", illum, "\n")), 3 / 3.25, 1e-4) << illum;
  }
  const Scene tinted = load("illum 4\nNi 1.5\nTf 0.5 0.25 1\n");
  EXPECT_EQ(leaf(tinted).model, Model::thin_dielectric);
  EXPECT_NEAR(passes(tinted).x, 0.5 * 3 / 3.25, 1e-4);
  EXPECT_NEAR(passes(tinted).y, 0.25 * 3 / 3.25, 1e-4);
  EXPECT_NEAR(share("illum 4\nNi 1.5\nTf 0.5\n"), 0.5 * 3 / 3.25, 1e-4);  // one number: grey
  EXPECT_NEAR(share("illum 6\nTf 0.5\n"), 0.5, 1e-6);                     // no index: no reflection
  EXPECT_EQ(warned(load("illum 4\nNi 1.5\n"), "Kd, Ks and Ns are not used"), 1);
}

TEST_F(ObjTransparency, WhatModellersWriteOfOpaqueMaterialsIsOpaque) {
  EXPECT_FLOAT_EQ(share("illum 4\nTf 1 1 1\nNi 1\n"), 0);
  EXPECT_EQ(warned(load("illum 4\nTf 1 1 1\nNi 1\n"), "glass needs an Ni above 1"), 1);
  EXPECT_FLOAT_EQ(share("illum 2\nTf 1 1 1\nNi 1.5\n"), 0);
  EXPECT_TRUE(load("illum 2\nTf 1 1 1\nNi 1.5\n").warnings.empty());
  EXPECT_EQ(warned(load("illum 2\nTf 0.5 1 1\n"), "Tf is not used"), 1);
}

TEST_F(ObjTransparency, ADissolveBesideIllumOfGlassSaysHowMuchPasses) {
  const Scene scene = load("illum 9\nNi 1.45\nd 0.3\n");
  EXPECT_FLOAT_EQ(passes(scene).y, 0.7f);
  EXPECT_EQ(warned(scene, "illum 9 and Ni are not used"), 1);
}

TEST_F(ObjTransparency, AClosedSolidRefractsHoweverItIsWoundAndSplit) {
  for (const bool inside_out : {false, true}) {
    const Scene scene = load("illum 7\nNi 1.5\nTf 0.5 0.5 0.5\n", plate(inside_out));
    EXPECT_EQ(leaf(scene).model, Model::dielectric);
    const RayScene rays(scene);
    Ray ray;
    ray.origin = Vec3(0.1f, 2, 0.2f), ray.direction = Vec3(0, -1, 0);
    Hit hit;
    std::vector<Crossing> crossings;
    EXPECT_FALSE(rays.through(ray, hit, crossings)) << inside_out;
    ASSERT_EQ(crossings.size(), 1u);
    // Filtered once, however many faces there are.
    EXPECT_NEAR(crossings[0].layer.transmittance().y, 0.5 * 3 / 3.25, 1e-4);
  }
  EXPECT_EQ(leaf(load("illum 7\nNi 1.5\n", plate(false, true))).model, Model::thin_dielectric);
}

TEST_F(ObjTransparency, SheetsAndSolidsOfOneMaterialAreToldApart) {
  const Scene scene =
      load("illum 7\nNi 1.5\n", plate(false) + "g sheet\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 9 10 11\n");
  std::map<Model, int> models;
  for (const Instance& i : scene.instance) ++models[scene.material[i.material].model];
  EXPECT_EQ(models[Model::dielectric], 6);
  EXPECT_EQ(models[Model::thin_dielectric], 1);
}

TEST_F(ObjTransparency, ReflectionIsAMirrorOfKs) {
  const Scene alone = load("Kd 0 0 0\nKs 0.8 0.8 0.8\nillum 3\n");
  EXPECT_EQ(leaf(alone).model, Model::mirror);
  EXPECT_EQ(leaf(alone).ks, Rgb(0.8f));
  const Scene beside = load("Ks 0.3 0.3 0.3\nNs 1000\nillum 8\n");
  const Bsdf bsdf(beside, 1);
  BsdfSample branch[2];
  ASSERT_EQ(bsdf.specular_branches(Vec3(0, 0.6f, 0.8f), branch), 1);
  EXPECT_FLOAT_EQ(branch[0].weight.y, 0.3f);
  EXPECT_FLOAT_EQ(bsdf.diffuse_reflectance().y, 0.5f);
  EXPECT_EQ(leaf(load("Ks 0.3 0.3 0.3\nNs 60\nillum 3\n")).model, Model::phong);
  EXPECT_EQ(warned(load("Ks 0.3 0.3 0.3\nillum 5\n"), "without Fresnel"), 1);
}

TEST_F(ObjTransparency, EachStatementThatIsNotModelledIsToldOnce) {
  for (const char* statement :
       {"map_Ks a.png", "map_Ns a.png", "map_bump a.png", "bump a.png", "map_Bump a.png", "disp a.png",
        "decal a.png", "refl -type sphere a.png", "map_aat on", "sharpness 60", "Pr 0.5", "Pm 1", "Pc 0.1",
        "Ps 0.3", "aniso 0.5", "map_Pr a.png", "something 3"}) {
    const Scene scene = load(text(statement, "\n"));
    const std::string keyword = std::string(statement).substr(0, std::string(statement).find(' '));
    EXPECT_EQ(scene.warnings.size(), 1u) << statement;
    EXPECT_EQ(warned(scene, keyword + " is not"), 1) << statement;
    EXPECT_EQ(warned(scene, "\"leaf\""), 1) << statement;
  }
  EXPECT_TRUE(load("Ka 0.1 0.1 0.1\nmap_aat off\n").warnings.empty());
  EXPECT_EQ(warned(load("Tf spectral glass.rfl\n"), "Tf is read as numbers only"), 1);
  EXPECT_EQ(warned(load("Ks 0.1 0.1 0.1\n"), "no illum"), 1);
  EXPECT_EQ(warned(load("map_Ke a.png\n"), "map_Ke is not used"), 1);
  test::spill(folder + "/a.tga", targa(4, 200));
  EXPECT_EQ(warned(load("map_Kd -mm 0 2 a.tga\n"), "-mm of map_Kd is not modelled"), 1);
  EXPECT_EQ(warned(load("map_Kd -s 2 2 2 a.tga\n"), "map_Kd"), 0);
  EXPECT_EQ(warned(load("", text(kSheet, "surf 0 1 0 1 1 2 3 4\nsurf 0 1 0 1 1 2 3 4\n")),
                   "statement \"surf\", 2 times, is not read"),
            1);
}

TEST_F(ObjTransparency, TexturesAreMovedAndScaled) {
  std::string left = targa(2, 0);  // left column white, right black; rows from above
  for (int j = 0; j < 2; ++j)
    for (int c = 0; c < 3; ++c) left[static_cast<std::size_t>(18 + 6 * j + c)] = '\xff';
  test::spill(folder + "/left.tga", left);
  const auto at = [&](const std::string& options) {
    const Scene scene = load("map_Kd " + options + " left.tga\n");
    const TextureUse& use = leaf(scene).base_colour;
    return scene.texture.at(0).at(use.offset + use.scale * Vec2(0.25f, 0.25f)).x;
  };
  EXPECT_FLOAT_EQ(at(""), 1);
  EXPECT_FLOAT_EQ(at("-o 0.5 0 0"), 0);
  EXPECT_FLOAT_EQ(at("-s 3 1 1"), 0);
}

TEST_F(ObjTransparency, FilesThatAMapOfCoverageNamesAreHashed) {
  test::spill(folder + "/leaf.tga", targa(2, 9));
  load("map_d leaf.tga\n");
  const std::vector<std::string> files = scene_files(folder + "/x.obj");
  EXPECT_NE(std::find(files.begin(), files.end(), folder + "/leaf.tga"), files.end());
}

/// ../shared/faults/12: a lamp of 25000 cd/m2, 0.2 m square, 1.999 m above the sensor.
TEST_F(ObjTransparency, TheFaultsReported) {
  const std::string faults = test::shared("faults/12-obj-transparency-maps-ignored");
  if (faults.empty()) GTEST_SKIP() << "../shared/faults is not here";
  EXPECT_NEAR(passes(load_scene(faults + "/map_d.obj")).y, 1, 1e-6);
  EXPECT_NEAR(passes(load_scene(faults + "/d.obj")).y, 0.9, 1e-6);
  EXPECT_NEAR(passes(load_scene(faults + "/illum4.obj")).y, 3 / 3.25, 1e-4);
}

}  // namespace
}  // namespace phos
