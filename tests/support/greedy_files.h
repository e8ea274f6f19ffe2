// Small files of every kind whose headers speak of much.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "file/container.h"
#include "support/gltf.h"
#include "support/run.h"

namespace phos::test {

inline std::string word(std::uint64_t v, int bytes) {
  std::string s;
  for (int i = 0; i < bytes; ++i) s += static_cast<char>(v >> 8 * i & 255);
  return s;
}

inline std::string big_endian(std::uint32_t v) {
  std::string s = word(v, 4);
  std::reverse(s.begin(), s.end());
  return s;
}

inline std::string scene_of_buffer(const Json& buffer) {
  Json scene;
  scene["asset"]["version"] = "2.0";
  scene["buffers"] = Json::Array{buffer};
  return scene.dump();
}

/// A scene of one triangle, in which this is another accessor, buffer or picture.
inline std::string scene_with(const std::string& list, const Json& member, bool as_position = false) {
  Gltf g;
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

inline Json accessor_of(double count) {
  Json a;
  a["componentType"] = 5126, a["count"] = count, a["type"] = "VEC3";
  return a;
}

inline std::string base64(const std::string& s) {
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

inline Json image_of(const std::string& bytes) {
  Json image;
  image["uri"] = "data:image/png;base64," + base64(bytes);
  return image;
}

inline std::string targa(int width, int height, bool runs) {
  std::string s(18, '\0');
  s[2] = runs ? 10 : 2, s[16] = 32;
  s.replace(12, 4, word(static_cast<std::uint64_t>(width), 2) + word(static_cast<std::uint64_t>(height), 2));
  return s + "abcdefgh";
}

inline std::string png(std::uint32_t width, std::uint32_t height) {
  return "\x89PNG\r\n\x1a\n" + big_endian(13) + "IHDR" + big_endian(width) + big_endian(height) +
         std::string("\x08\x06\0\0\0", 5) + big_endian(0) + big_endian(0) + "IDAT" + big_endian(0);
}

inline std::string exr_attribute(const std::string& name, const std::string& type, const std::string& value,
                                 std::uint64_t size) {
  return name + '\0' + type + '\0' + word(size, 4) + value;
}

/// An OpenEXR header alone, with a window of that size.
inline std::string exr(std::int32_t side, const std::string& more = "", bool tiled = false) {
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
inline std::string cache_of(FileKind kind, const Json& extra,
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
  const std::string path = scratch("sizes") + "/file";
  file.write(path, p);
  return slurp(path);
}

inline std::string brdf_of_much() {
  Json table;
  table["material"] = "paint", table["index"] = 0, table["isotropic"] = false, table["resolution"] = 1024;
  table["order"] = 30, table["albedo"] = 0.5;
  Json extra;
  extra["materials"] = Json::Array{table};
  return cache_of(FileKind::brdf, extra, {{"0.coefficients", {1, 900, 3}}});
}

inline std::string film_of_much() {
  Json extra, film;
  film["frames"] = Json::Array{0, 2147483646}, film["temporal_accuracy"] = 0.1, film["max_life"] = 10;
  film["fade"] = 2147483646, film["gradients"] = "none", film["scene_hash"] = Json::Array{"a"};
  extra["film"] = film, extra["accuracy"] = 0.3, extra["quantity"] = "all";
  return cache_of(FileKind::irradiance, extra, {{"position", {0, 3}}});
}

inline std::string radiance_of_much() {
  Json extra;
  extra["accuracy"] = 0.3, extra["order"] = 30;
  return cache_of(FileKind::radiance, extra, {{"position", {1000, 3}}, {"coefficients", {1, 3, 900}}});
}

inline std::string photons_of_much() {
  Json extra, totals;
  totals["emitted"] = INT64_MAX, totals["stored"] = INT64_MAX, totals["first_path"] = 0,
  totals["paths"] = INT64_MAX;
  totals["flux_exponent"] = 0;
  for (const char* sum : {"emitted_units", "stored_units", "escaped_units", "absorbed_units"})
    totals[sum] = Json::Array{INT64_MAX, INT64_MAX, INT64_MAX};
  extra["totals"] = totals;
  return cache_of(FileKind::photons, extra, {{"position", {2, 3}}, {"flux", {2, 3}}});
}

inline std::string container(const std::string& shape, std::uint64_t end) {
  const std::string header =
      text(R"({"__metadata__":{"format":"phos/photons/1","checksums":"{}","units":"{}"},)",
           R"("position":{"dtype":"F32","shape":)", shape, R"(,"data_offsets":[0,)", end, "]}}");
  return word(header.size(), 8) + header;
}

}  // namespace phos::test
