// What fuzzers found, in every reader below studies, and small files that ask for much.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <functional>

#include "support/films.h"
#include "support/gltf.h"
#include "support/run.h"

// The address sanitizer needs an address space without end.
#if defined(__SANITIZE_ADDRESS__)
#define PHOS_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PHOS_ADDRESS_SANITIZER 1
#endif
#endif
#ifndef PHOS_ADDRESS_SANITIZER
#define PHOS_ADDRESS_SANITIZER 0
#endif

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

using Reader = int (*)(const std::uint8_t*, std::size_t);
const std::map<std::string, Reader>& readers() {
  static const std::map<std::string, Reader> all{{"brdf", read_brdf_bytes},
                                                 {"container", read_container_bytes},
                                                 {"csv", read_csv_bytes},
                                                 {"environment", read_environment_bytes},
                                                 {"exr", read_exr_bytes},
                                                 {"film", read_film_bytes},
                                                 {"gltf", read_gltf_bytes},
                                                 {"hdr", read_hdr_bytes},
                                                 {"irradiance", read_irradiance_bytes},
                                                 {"json", read_json_bytes},
                                                 {"merl", read_merl_bytes},
                                                 {"obj", read_obj_bytes},
                                                 {"photons", read_photons_bytes},
                                                 {"png", read_png_bytes},
                                                 {"radiance", read_radiance_bytes},
                                                 {"texture", read_texture_bytes}};
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

/// What a child process that may take this much memory beyond what it has says of `body`: its exit code, or
/// 128 and the signal that ended it; and the memory that it took, kB.
struct Child {
  int code;
  long peak_kb;
};

Child in_little_memory([[maybe_unused]] std::uint64_t bytes, const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
#if !PHOS_ADDRESS_SANITIZER
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    const std::uint64_t most = pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) + bytes;
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
#endif
    int code = 1;
    try {
      code = body();
    } catch (...) {
      code = 100;
    }
    _exit(code);
  }
  int status = 0;
  rusage usage{};
  wait4(pid, &status, 0, &usage);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), usage.ru_maxrss};
}

std::string word(std::uint64_t v, int bytes) {
  std::string s;
  for (int i = 0; i < bytes; ++i) s += static_cast<char>(v >> 8 * i & 255);
  return s;
}

std::string big_endian(std::uint32_t v) {
  std::string s = word(v, 4);
  std::reverse(s.begin(), s.end());
  return s;
}

std::string scene_of_buffer(const Json& buffer) {
  Json scene;
  scene["asset"]["version"] = "2.0";
  scene["buffers"] = Json::Array{buffer};
  return scene.dump();
}

/// A scene of one triangle, in which this is another accessor, buffer or picture.
std::string scene_with(const std::string& list, const Json& member, bool as_position = false) {
  test::Gltf g;
  Json material;
  material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  Json p = g.square();
  if (list == "images") {
    Json texture;
    texture["source"] = 0;
    g.json["textures"] = Json::Array{texture};
    p["material"] = g.material(material);
  }
  g.json[list].push_back(member);
  if (as_position) {
    Json::Object attributes;
    attributes["POSITION"] = static_cast<int>(g.size(list.c_str())) - 1;
    p = Json();
    p["attributes"] = attributes;
  }
  Json n;
  n["mesh"] = g.mesh(p);
  g.node(n);
  return g.bytes();
}

Json accessor_of(double count) {
  Json a;
  a["componentType"] = 5126, a["count"] = count, a["type"] = "VEC3";
  return a;
}

std::string base64(const std::string& s) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < s.size(); i += 3) {
    std::uint32_t v = 0;
    for (std::size_t k = 0; k < 3; ++k)
      v = v << 8 | (i + k < s.size() ? static_cast<unsigned char>(s[i + k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6) out += kDigits[v >> shift & 63];
  }
  return out;
}

Json image_of(const std::string& bytes) {
  Json image;
  image["uri"] = "data:image/png;base64," + base64(bytes);
  return image;
}

std::string targa(int width, int height, bool runs) {
  std::string s(18, '\0');
  s[2] = runs ? 10 : 2, s[16] = 32;
  s.replace(12, 4, word(static_cast<std::uint64_t>(width), 2) + word(static_cast<std::uint64_t>(height), 2));
  return s + "abcdefgh";
}

std::string png(std::uint32_t width, std::uint32_t height) {
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + big_endian(width) + big_endian(height) +
         std::string("\x08\x06\0\0\0", 5) + big_endian(0) + big_endian(0) + "IDAT" + big_endian(0);
}

std::string exr_attribute(const std::string& name, const std::string& type, const std::string& value,
                          std::uint64_t size) {
  return name + '\0' + type + '\0' + word(size, 4) + value;
}

/// An OpenEXR header alone, with a window of that size.
std::string exr(std::int32_t side, const std::string& more = "", bool tiled = false) {
  const std::string box = word(0, 8) + word(static_cast<std::uint32_t>(side - 1), 4) +
                          word(static_cast<std::uint32_t>(side - 1), 4);
  const std::string channel =
      std::string("R\0", 2) + word(2, 4) + word(0, 4) + word(1, 4) + word(1, 4) + '\0';
  return word(20000630, 4) + word(tiled ? 0x202 : 2, 4) +
         exr_attribute("channels", "chlist", channel, channel.size()) +
         exr_attribute("compression", "compression", std::string(1, '\0'), 1) +
         exr_attribute("dataWindow", "box2i", box, 16) + exr_attribute("displayWindow", "box2i", box, 16) +
         exr_attribute("lineOrder", "lineOrder", std::string(1, '\0'), 1) +
         exr_attribute("pixelAspectRatio", "float", word(0x3f800000, 4), 4) +
         exr_attribute("screenWindowCenter", "v2f", word(0, 8), 8) +
         exr_attribute("screenWindowWidth", "float", word(0x3f800000, 4), 4) + more + '\0';
}

/// A cache's file of no rows whose header says this more.
std::string cache_of(const std::string& kind, const Json& extra,
                     const std::vector<std::pair<std::string, Shape>>& columns) {
  Provenance p;
  p.kind = kind, p.tool = "test", p.extra = extra;
  ContainerWriter file;
  static const std::vector<float> zeros(4096);
  for (const auto& [name, shape] : columns) {
    std::uint64_t n = 1;
    for (const std::uint64_t extent : shape) n *= extent;
    file.add<float>(name, std::span(zeros).first(static_cast<std::size_t>(n)), shape, "1");
  }
  const std::string path = test::scratch("sizes") + "/file";
  file.write(path, p);
  return test::slurp(path);
}

std::string brdf_of_much() {
  Json table;
  table["material"] = "paint", table["index"] = 0, table["isotropic"] = false, table["resolution"] = 1024;
  table["order"] = 30, table["albedo"] = 0.5;
  Json extra;
  extra["materials"] = Json::Array{table};
  return cache_of("brdf", extra, {{"0.coefficients", {1, 900, 3}}});
}

std::string film_of_much() {
  Json extra, film;
  film["frames"] = Json::Array{0, 2147483646}, film["temporal_accuracy"] = 0.1, film["max_life"] = 10;
  film["fade"] = 2147483646, film["gradients"] = "none", film["scene_hash"] = Json::Array{"a"};
  extra["film"] = film, extra["accuracy"] = 0.3, extra["quantity"] = "all";
  return cache_of("irradiance", extra, {{"position", {0, 3}}});
}

std::string radiance_of_much() {
  Json extra;
  extra["accuracy"] = 0.3, extra["order"] = 30;
  return cache_of("radiance", extra, {{"position", {1000, 3}}, {"coefficients", {1, 3, 900}}});
}

std::string photons_of_much() {
  Json extra, totals;
  totals["emitted"] = INT64_MAX, totals["stored"] = INT64_MAX, totals["first_path"] = 0,
  totals["paths"] = INT64_MAX;
  totals["flux_exponent"] = 0;
  for (const char* sum : {"emitted_units", "stored_units", "escaped_units", "absorbed_units"})
    totals[sum] = Json::Array{INT64_MAX, INT64_MAX, INT64_MAX};
  extra["totals"] = totals;
  return cache_of("photons", extra, {{"position", {2, 3}}, {"flux", {2, 3}}});
}

std::string container(const std::string& shape, std::uint64_t end) {
  const std::string header =
      text(R"({"__metadata__":{"format":"phos/photons/1","checksums":"{}","units":"{}"},)",
           R"("position":{"dtype":"F32","shape":)", shape, R"(,"data_offsets":[0,)", end, "]}}");
  return word(header.size(), 8) + header;
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
    EXPECT_NE(std::string(e.what()).find("is no file"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace phos
