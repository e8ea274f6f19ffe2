// Files that hold no data: pointers of Git LFS, and geometry that only an extension could decode.
#include <gtest/gtest.h>

#include "file/csv.h"
#include "image/image.h"
#include "scene/load.h"
#include "scene/luminaire/photometric_file.h"
#include "support/complaint.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos {
namespace {

constexpr const char* kPointer =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:0000000000000000000000000000000000000000000000000000000000000000\nsize 123\n";

class NotFetched : public ::testing::Test {
 protected:
  std::string folder = test::scratch("not_fetched");
  std::string spill(const std::string& name, const std::string& bytes = kPointer) {
    test::spill(folder + "/" + name, bytes);
    return folder + "/" + name;
  }
  std::string load_error(const std::string& path, const SceneOptions& options = {}) {
    return test::complaint_of([&] { load_scene(path, options); });
  }
};

void expect_says(const std::string& why, const std::string& what) {
  EXPECT_NE(why.find(what), std::string::npos) << why;
}

std::string all_warnings(const Scene& scene) {
  std::string all;
  for (const Note& note : scene.warnings) all += note.line() + '\n';
  return all;
}

TEST_F(NotFetched, PointersAreToldAsSuch) {
  for (const char* name : {"a.hdr", "a.exr"}) {
    const std::string path = spill(name);
    EXPECT_EQ(test::complaint_of([&] { read_image(path); }),
              path +
                  ": neither an OpenEXR nor a Radiance .hdr image, but a Git LFS pointer; fetch the file "
                  "that it stands for (git lfs pull)");
    EXPECT_TRUE(is_named_image(path));
  }
  EXPECT_TRUE(is_named_image("A.HDR"));
  EXPECT_FALSE(is_named_image("hdr"));
  for (const char* name : {"a.glb", "a.gltf", "a.obj"})
    expect_says(load_error(spill(name)), "neither glTF nor OBJ, but a Git LFS pointer");
  expect_says(test::complaint_of([&] { read_photometry(spill("a.ies")); }), "but a Git LFS pointer");
  expect_says(test::complaint_of([] { parse_csv(kPointer, "a.csv"); }), "is no table, but a Git LFS pointer");
}

TEST_F(NotFetched, PointersThatASceneNames) {
  test::Gltf g;
  Json m;
  m["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  Json image, texture;
  image["uri"] = "wood.png", texture["source"] = 0;
  g.json["images"].push_back(image), g.json["textures"].push_back(texture);
  g.square_node(m);
  spill("wood.png");
  const std::string path = spill("room.glb", g.bytes());
  const Scene scene = load_scene(path);
  expect_says(all_warnings(scene), "wood.png is a Git LFS pointer");
  SceneOptions options;
  options.environment = spill("sky.hdr");
  expect_says(load_error(path, options), "but a Git LFS pointer");
  spill("room.mtl");
  const Scene obj = load_scene(spill("room.obj", "mtllib room.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  expect_says(all_warnings(obj), "room.mtl is a Git LFS pointer");
}

/// A square whose attributes stand in the accessors, or only in what Draco holds.
test::Gltf draco(bool also_plain) {
  test::Gltf g;
  Json p = g.square(), extension;
  extension["bufferView"] = 0, extension["attributes"]["POSITION"] = 0;
  p["extensions"]["KHR_draco_mesh_compression"] = extension;
  if (!also_plain) {
    Json::Array accessors;
    for (Json a : g.json.find("accessors")->as_array()) {
      Json::Object without = a.as_object();
      without.erase("bufferView");
      accessors.emplace_back(std::move(without));
    }
    g.json["accessors"] = accessors;
  }
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  g.json["extensionsUsed"] = Json::Array{"KHR_draco_mesh_compression"};
  return g;
}

TEST_F(NotFetched, GeometryThatOnlyDracoHolds) {
  const std::string expected =
      "mesh \"mesh\" is compressed with the extension KHR_draco_mesh_compression, which is not supported; "
      "export it without";
  expect_says(load_error(spill("a.glb", draco(false).bytes())), expected);
  EXPECT_EQ(load_scene(spill("b.glb", draco(true).bytes())).triangle.size(), 2u);
  test::Gltf required = draco(false);
  required.json["extensionsRequired"] = Json::Array{"KHR_draco_mesh_compression"};
  expect_says(load_error(spill("c.glb", required.bytes())),
              "KHR_draco_mesh_compression, which is not supported; export it without");
}

TEST_F(NotFetched, GeometryThatOnlyMeshoptHolds) {
  test::Gltf g;
  g.square_node();
  Json placeholder;
  placeholder["byteLength"] = 48;
  placeholder["extensions"]["EXT_meshopt_compression"]["fallback"] = true;
  Json::Array views = g.json.find("bufferViews")->as_array();
  views[0]["buffer"] = 1;
  views[0]["extensions"]["EXT_meshopt_compression"]["buffer"] = 0;
  g.json["bufferViews"] = views;
  std::string json = g.json.dump();
  Json own;
  own["byteLength"] = g.bin.size();
  g.json["buffers"] = Json::Array{own, placeholder};
  expect_says(load_error(spill("a.glb", test::glb(g.json.dump(), g.bin))),
              "bufferViews[0] is compressed with the extension EXT_meshopt_compression, which is not "
              "supported; export it without");
}

TEST_F(NotFetched, SharedFiles) {
  const std::string faults = test::shared("faults/16-unclear-messages");
  if (faults.empty()) GTEST_SKIP() << "the shared faults are not here";
  expect_says(load_error(faults + "/draco-optional.gltf"), "KHR_draco_mesh_compression");
  expect_says(test::complaint_of([&] { read_image(faults + "/pointer.hdr"); }),
              "neither an OpenEXR nor a Radiance .hdr image");
  expect_says(test::complaint_of([&] { read_photometry(faults + "/no-ballast-line.ies"); }),
              "numbers are missing before the angles");
}

}  // namespace
}  // namespace phos
