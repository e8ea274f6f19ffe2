// The photons of the Cornell box as they were when data/golden/photons-cornell.json was made: what the file
// says of itself exactly, its numbers to the tolerance below. `golden_photons_cornell --update` prints what
// changed and writes the file anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

#include "core/error.h"
#include "file/container.h"
#include "file/json_parse.h"
#include "support/run.h"

namespace phos {
namespace {

// With --isa sse2 only the C library's sine and cosine may differ between machines, in the last bit: rarely,
// a path then goes elsewhere. One of the 5,139 photons more or less changes a mean by 2e-4 of itself.
constexpr double kTolerance = 2e-3;

std::vector<std::string> command(const std::string& out) {
  return {"photons",   test::data("cornell-measured.glb"),
          "--photons", "3000",
          "--seed",    "1",
          "--isa",     "sse2",
          "-o",        out};
}

Json exact_of(const Container& file) {
  const Provenance& p = file.provenance();
  Json j;
  j["command"] = p.command;
  j["kind"] = text(p.kind, "/", p.version);
  j["parameters"] = p.parameters;
  j["scene"] = p.scene_hash;
  Json tensors;
  for (const auto& [name, tensor] : file.tensors())
    tensors[name] = text(dtype_name(tensor.dtype), " ", tensor.shape.size(), "D, ", tensor.unit);
  j["tensors"] = tensors;
  return j;
}

double mean(std::span<const float> v) {
  double sum = 0;
  for (const float x : v) sum += static_cast<double>(x);
  return sum / static_cast<double>(v.size());
}

Json numbers_of(const Container& file) {
  Json j;
  const std::span<const Vec3> position = file.vectors("position"), flux = file.vectors("flux");
  j["photons"] = static_cast<double>(position.size());
  for (int c = 0; c < 3; ++c) {
    double place = 0, light = 0;
    for (const Vec3& p : position) place += static_cast<double>(p[c]);
    for (const Vec3& f : flux) light += static_cast<double>(f[c]);
    j[text("mean position ", c)] = place / static_cast<double>(position.size());
    j[text("flux ", c)] = light;
  }
  j["mean distance"] = mean(file.values<float>("distance", {0}));
  std::array<double, 3> kinds{};
  for (const std::uint8_t k : file.values<std::uint8_t>("path", {0})) ++kinds.at(k);
  j["direct"] = kinds[0], j["indirect"] = kinds[1], j["caustic"] = kinds[2];
  double bounces = 0;
  for (const std::uint8_t b : file.values<std::uint8_t>("bounce", {0})) bounces += b;
  j["bounces"] = bounces;
  return j;
}

bool update_asked() {
  const std::vector<std::string> arguments = ::testing::internal::GetArgvs();
  return std::find(arguments.begin(), arguments.end(), "--update") != arguments.end();
}

TEST(GoldenPhotons, CornellBox) {
  const std::string golden = test::data("golden/photons-cornell.json"),
                    out = test::scratch("golden_photons") + "/a.photons";
  const auto run = test::run_tool(command(out));
  ASSERT_EQ(run.code, 0) << run.err;
  const Container file = Container::open(out, "photons");
  Json now;
  now["exact"] = exact_of(file), now["numbers"] = numbers_of(file);
  if (update_asked()) {
    const std::string before = std::filesystem::exists(golden) ? test::slurp(golden) : "";
    if (before != now.dump(2) + "\n") std::cout << "before:\n" << before << "after:\n" << now.dump(2) << "\n";
    test::spill(golden, now.dump(2) + "\n");
  }
  ASSERT_TRUE(std::filesystem::exists(golden)) << golden << " is not there; make it with --update";
  const Json then = parse_json(test::slurp(golden), golden);
  EXPECT_EQ(now["exact"].dump(2), then.find("exact")->dump(2));
  const Json::Object& numbers = then.find("numbers")->as_object();
  EXPECT_EQ(numbers.size(), now["numbers"].as_object().size());
  for (const auto& [name, value] : numbers) {
    const Json* mine = now["numbers"].find(name);
    ASSERT_NE(mine, nullptr) << name;
    EXPECT_NEAR(mine->as_number(), value.as_number(), kTolerance * std::fabs(value.as_number())) << name;
  }
}

}  // namespace
}  // namespace phos
