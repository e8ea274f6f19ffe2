// What fuzzers found, in every reader below studies, and small files that ask for much.
#include <gtest/gtest.h>
#include "support/greedy_files.h"
#include "support/little_memory.h"
#include "support/run.h"

// Each fuzzer is a function here: it aborts where a reader does what none may.
#define LLVMFuzzerTestOneInput read_brdf_bytes
#include "fuzz/fuzz_brdf.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_container_bytes
#include "fuzz/fuzz_container.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_csv_bytes
#include "fuzz/fuzz_csv.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_environment_bytes
#include "fuzz/fuzz_environment.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_exr_bytes
#include "fuzz/fuzz_exr.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_film_bytes
#include "fuzz/fuzz_film.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_gltf_bytes
#include "fuzz/fuzz_gltf.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_hdr_bytes
#include "fuzz/fuzz_hdr.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_ies_bytes
#include "fuzz/fuzz_ies.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_ldt_bytes
#include "fuzz/fuzz_ldt.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_irradiance_bytes
#include "fuzz/fuzz_irradiance.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_json_bytes
#include "fuzz/fuzz_json.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_merl_bytes
#include "fuzz/fuzz_merl.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_obj_bytes
#include "fuzz/fuzz_obj.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_photons_bytes
#include "fuzz/fuzz_photons.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_png_bytes
#include "fuzz/fuzz_png.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_radiance_bytes
#include "fuzz/fuzz_radiance.cpp"
#undef LLVMFuzzerTestOneInput
#define LLVMFuzzerTestOneInput read_texture_bytes
#include "fuzz/fuzz_texture.cpp"
#undef LLVMFuzzerTestOneInput

namespace phos {
namespace {

using namespace test;

using Reader = int (*)(const std::uint8_t*, std::size_t);
const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all{
      {"brdf", read_brdf_bytes},         {"container", read_container_bytes},
      {"csv", read_csv_bytes},           {"environment", read_environment_bytes},
      {"exr", read_exr_bytes},           {"film", read_film_bytes},
      {"gltf", read_gltf_bytes},         {"hdr", read_hdr_bytes},
      {"ies", read_ies_bytes},           {"irradiance", read_irradiance_bytes},
      {"json", read_json_bytes},         {"ldt", read_ldt_bytes},
      {"merl", read_merl_bytes},         {"obj", read_obj_bytes},
      {"photons", read_photons_bytes},   {"png", read_png_bytes},
      {"radiance", read_radiance_bytes}, {"texture", read_texture_bytes}};
  return all;
}

int read_as(const std::string& kind, const std::string& bytes) {
  return readers().at(kind)(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

/// data/damaged/<reader>-<what it is>. Studies are elsewhere.
TEST(Regression, WhatFuzzersFoundIsAnswered) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::data("damaged"))) {
    const std::string name = entry.path().filename().string(), kind = name.substr(0, name.find('-'));
    if (kind == "toml") continue;
    ASSERT_TRUE(readers().contains(kind)) << name;
    SCOPED_TRACE(name);
    EXPECT_EQ(read_as(kind, test::slurp(entry.path().string())), 0);
    ++read;
  }
  EXPECT_GT(read, 0);
}

struct Case {
  const char* what;
  const char* kind;
  std::string bytes;
};

std::vector<Case> small_files_that_ask_for_much() {
  Json sparse = accessor_of(4e9), buffer, far;
  sparse["sparse"]["count"] = 2000000000;
  for (const char* part : {"indices", "values"}) sparse["sparse"][part]["bufferView"] = 0;
  sparse["sparse"]["indices"]["componentType"] = 5125;
  buffer["byteLength"] = 1e12, buffer["uri"] = "data:application/octet-stream;base64,AAAA";
  far["buffer"] = 0, far["byteOffset"] = 1e15, far["byteLength"] = 1e15;
  const std::string tiles =
      exr_attribute("tiles", "tiledesc", word(0x7fffffff, 4) + word(0x7fffffff, 4) + '\2', 9);
  const std::string a_lot(100, '9');
  return {
      {"glTF, an accessor of nothing", "gltf", scene_with("accessors", accessor_of(1e9), true)},
      {"glTF, an accessor of more than memory", "gltf", scene_with("accessors", accessor_of(9e15), true)},
      {"glTF, an accessor that is sparse", "gltf", scene_with("accessors", sparse, true)},
      {"glTF, a buffer", "gltf", scene_of_buffer(buffer)},
      {"glTF, a view of a buffer", "gltf", scene_with("bufferViews", far)},
      {"glTF, a chunk", "gltf", "glTF" + word(2, 4) + word(0xffffffff, 4) + word(0xfffffff0, 4) + "JSON{}"},
      {"glTF, a TGA picture", "gltf", scene_with("images", image_of(targa(32767, 2048, false)))},
      {"glTF, a PNG picture", "gltf", scene_with("images", image_of(png(32768, 2048)))},
      {"TGA", "texture", targa(32767, 2048, false)},
      {"TGA in runs", "texture", targa(32767, 2048, true)},
      {"TGA of most pixels", "texture", targa(65535, 65535, true)},
      {"PNG as texture", "texture", png(32768, 2048)},
      {"PNG, a chunk", "texture", test::slurp(test::data("damaged/texture-chunk-of-gigabytes.png"))},
      {"PNG", "png", png(0x7fffffff, 0x7fffffff)},
      {"PNG, small enough for its format", "png", png(100000, 100000)},
      {"OBJ, indices", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 2147483647 2147483646 2147483645\n"},
      {"OBJ, indices from the end", "obj", "v 0 0 0\nf -2147483648 -1 -2147483647\n"},
      {"OBJ, a number of many digits", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf " + a_lot + " 2 3\n"},
      {"OpenEXR, windows", "exr", exr(262144)},
      {"OpenEXR, windows beyond numbers", "exr", exr(0x7fffffff)},
      {"OpenEXR, a text", "exr", exr(8, exr_attribute("comments", "string", "x", 0x7fffffff))},
      {"OpenEXR, a preview", "exr", exr(8, exr_attribute("preview", "preview", word(0xffffffffffff, 8), 12))},
      {"OpenEXR, tiles", "exr", exr(8, tiles, true)},
      {"OpenEXR, tiles of a large window", "exr", exr(200000, tiles, true)},
      {"OpenEXR, environment", "environment", exr(131072)},
      {"Radiance", "hdr", "#?RADIANCE\n\n-Y 99999999 +X 99999999\n\1\2\3\4"},
      {"Radiance, one row", "hdr", "#?RADIANCE\n\n-Y 1 +X 999999999\n\1\2\3\4"},
      {"Radiance, environment", "environment", "#?RADIANCE\n\n-Y 30000 +X 60000\n\2\2\x0a\xaa"},
      {"LM-63, angles", "ies",
       "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 1000000000 1000000000 1 2 0 0 0\n1 1 1\n0 1\n"},
      {"LM-63, tilt angles", "ies", "IESNA91\nTILT=INCLUDE\n1\n1000000000\n0 1 2\n"},
      {"EULUMDAT, planes", "ldt", "a\n1\n0\n100000\n0\n100000\n0\nb\nc\nd\ne\nf\n1\n1\n1\n1\n1\n1\n"},
      {"MERL", "merl", word(0x7fffffff, 4) + word(0x7fffffff, 4) + word(0x7fffffff, 4)},
      {"MERL, all but the sizes is missing", "merl", word(90, 4) + word(90, 4) + word(180, 4)},
      {"a header", "container", word(std::uint64_t{1} << 40, 8) + "{"},
      {"a column", "container", container("[1000000000,3]", 12000000000)},
      {"a column beyond numbers", "container", container("[4611686018427387904,3]", 64)},
      {"photons", "photons", photons_of_much()},
      {"photons, columns", "photons", container("[1000000000,3]", 12000000000)},
      {"irradiance", "irradiance", container("[1000000000,3]", 12000000000)},
      {"films", "film", film_of_much()},
      {"radiance", "radiance", radiance_of_much()},
      {"lobes", "brdf", brdf_of_much()},
      {"JSON", "json", std::string(100000, '[')},
      {"a table of many columns", "csv",
       [] {
         std::string names;
         for (int i = 0; i < 200000; ++i) names += text("c", i, ",");
         return names + "\n1\n";
       }()},
  };
}

TEST(Sizes, SmallFilesThatAskForMuchAreAnswered) {
  constexpr std::uint64_t kEnough = std::uint64_t{1} << 30;
  for (const Case& c : small_files_that_ask_for_much()) {
    SCOPED_TRACE(c.what);
    // The table of names alone is larger: time is what it would take.
    EXPECT_LE(c.bytes.size(), std::string(c.kind) == "csv" ? 2000000u : 150000u);
    const Child child = in_little_memory(kEnough, [&] { return read_as(c.kind, c.bytes); });
    EXPECT_EQ(child.code, 0);
    EXPECT_LT(child.peak_kb, 1 << 20);
  }
}

TEST(Sizes, AReaderThatTookTheMemoryWouldBeSeen) {
  const Child child = in_little_memory(std::uint64_t{1} << 30, [] {
    std::vector<char> much(std::size_t{2} << 30, 1);
    fuzz::use(much);
    return 0;
  });
  EXPECT_TRUE(child.code != 0 || child.peak_kb > 1 << 20);
}

TEST(Scene, MayNotNameADevice) {
  const std::string folder = test::scratch("devices");
  test::spill(
      folder + "/zero.obj",
      "mtllib /dev/zero\nmtllib ../../../../../../../../dev/zero\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(load_scene(folder + "/zero.obj").triangle.size(), 1u);
  Json buffer;
  buffer["byteLength"] = 10, buffer["uri"] = "../../../../../../../../../../dev/zero";
  test::spill(folder + "/zero.gltf", scene_of_buffer(buffer));
  try {
    load_scene(folder + "/zero.gltf");
    ADD_FAILURE() << "a buffer without end was read";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::bad_input);
    EXPECT_NE(std::string(e.what()).find("is not a file"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace phos
