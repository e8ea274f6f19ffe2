// A small container with every dtype, and files made by hand.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "file/container.h"

namespace phos::test {

/// Columns like those of a cache: vectors, codes, bytes, wide numbers, an empty one.
struct SampleColumns {
  std::vector<Vec3> position{{0, 1, 2}, {3, 4, 5}, {6, 7, 8.5f}, {-1, -2, -3}, {0.1f, 0.2f, 0.3f}};
  std::vector<Vec3> flux{{1, 1, 1}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}, {0.5f, 0.25f, 0.125f}};
  std::vector<std::uint32_t> normal;
  std::vector<std::uint8_t> path{0, 1, 2, 1, 0};
  std::vector<std::uint16_t> small{1, 2, 3};
  std::vector<std::int32_t> whole{-1, 0, 1};
  std::vector<std::int64_t> wide{INT64_MIN, INT64_MAX};
  std::vector<std::uint64_t> id{UINT64_MAX, 7};
  std::vector<double> exact{1e-300, 1e300};
  std::vector<float> gradient = std::vector<float>(5 * 9, 0.5f);
  std::vector<float> none;

  SampleColumns() {
    for (const Vec3& n : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
      normal.push_back(encode_octahedral(n));
  }

  ContainerWriter writer() const {
    ContainerWriter w;
    w.add_vectors("position", position, "m");
    w.add_vectors("flux", flux, "lm");
    w.add<std::uint32_t>("normal", normal, {5}, "octahedral");
    w.add<std::uint8_t>("path", path, {5}, "1");
    w.add<std::uint16_t>("small", small, {3}, "1");
    w.add<std::int32_t>("whole", whole, {3}, "1");
    w.add<std::int64_t>("wide", wide, {2}, "1");
    w.add<std::uint64_t>("id", id, {2}, "1");
    w.add<double>("exact", exact, {2}, "s");
    w.add<float>("gradient", gradient, {5, 3, 3}, "lx/m");
    w.add<float>("none", none, {0, 3}, "m");
    return w;
  }
};

inline Provenance sample_provenance() {
  Provenance p;
  p.kind = FileKind::photons;
  p.tool = "phos-photons 0.1.0";
  p.algorithm = 3;
  p.command = "phos-photons --photons 5";
  p.parameters["photons"] = 5;
  p.parameters["roulette"] = 0.1;
  p.inputs["scene"] = "0123456789abcdef0123456789abcdef";
  p.scene_hash = "00112233445566778899aabbccddeeff";
  p.scene_parts["geometry"] = "g";
  p.scene_parts["nodes"]["lamp"] = "n";
  p.key = "ffeeddccbbaa99887766554433221100";
  p.extra["emitted"] = 17;
  p.extra["total_flux"] = 1.25;
  p.counters.add("degenerate triangle", 2);
  return p;
}

/// Length prefix, header text, data.
inline std::string container_bytes(const std::string& header, const std::string& data = "") {
  std::string out;
  for (int i = 0; i < 8; ++i) out += static_cast<char>((header.size() >> (8 * i)) & 255);
  return out + header + data;
}

}  // namespace phos::test
