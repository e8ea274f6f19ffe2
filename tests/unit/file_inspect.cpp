// Descriptions, CSV and PLY of a container.
#include "file/inspect/inspect.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/error.h"
#include "file/inspect/rows.h"
#include "support/container.h"
#include "support/run.h"

namespace phos {
namespace {

Container sample() {
  const std::string path = test::scratch("inspect") + "/a.photons";
  test::SampleColumns().writer().write(path, test::sample_provenance());
  return Container::open(path);
}

std::string csv(const Container& file, const std::vector<std::string>& names, bool decode = false) {
  std::string out;
  dump_csv(file, names, decode, [&](std::string_view s) { out += s; });
  return out;
}

std::string ply(const Container& file, PlyFormat format) {
  std::string out;
  write_ply(file, format, [&](std::string_view s) { out += s; });
  return out;
}

TEST(Describe, RangesPerColumn) {
  const Json tensors = *describe(sample()).find("tensors");
  const Json position = *tensors.find("position");
  EXPECT_EQ(position.find("min")->dump(), "[-1,-2,-3]");
  EXPECT_EQ(position.find("max")->dump(), "[6,7,8.5]");
  EXPECT_NEAR(position.find("mean")->as_array()[0].as_number(), (0 + 3 + 6 - 1 + 0.1) / 5, 1e-8);
  EXPECT_EQ(position.find("unit")->as_string(), "m");
  EXPECT_EQ(position.find("shape")->dump(), "[5,3]");
  EXPECT_EQ(tensors.find("whole")->find("min")->as_number(), -1);
  EXPECT_EQ(tensors.find("gradient")->find("mean")->as_number(), 0.5);
  EXPECT_EQ(tensors.find("normal")->find("min"), nullptr);  // codes have no order
  EXPECT_EQ(tensors.find("none")->find("min"), nullptr);
}

TEST(Describe, NonFiniteValuesAreCountedAndLeftOut) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  const std::vector<float> v{1, kNan, 3, kInf, -kInf, 2}, all_bad{kNan, kNan};
  const std::string path = test::scratch("inspect-nan") + "/a";
  ContainerWriter writer;
  writer.add<float>("v", v, {6}, "lx");
  writer.add<float>("bad", all_bad, {2}, "lx");
  writer.write(path, test::sample_provenance());
  const Container file = Container::open(path);
  const Json all = describe(file), t = *all.find("tensors")->find("v");
  EXPECT_EQ(t.find("non_finite")->as_integer(), 3);
  EXPECT_EQ(t.find("min")->as_number(), 1);
  EXPECT_EQ(t.find("max")->as_number(), 3);
  EXPECT_EQ(t.find("mean")->as_number(), 2);
  EXPECT_TRUE(all.find("tensors")->find("bad")->find("mean")->is_null());
  EXPECT_NE(describe_text(file).find("NOT FINITE: 3"), std::string::npos);
}

TEST(Describe, TextHasEverything) {
  const std::string s = describe_text(sample());
  for (const char* part : {"photons 1", "phos-photons 0.1.0", "--photons 5", "roulette", "0123456789abcdef",
                           "position", "F32  5 x 3  m", "degenerate triangle", "emitted", "1.25"})
    EXPECT_NE(s.find(part), std::string::npos) << part << "\n" << s;
}

TEST(Describe, ListsOfObjectsHaveALineEach) {
  const std::string path = test::scratch("inspect-list") + "/c";
  Provenance p = test::sample_provenance();
  p.extra["materials"] = Json::Array{Json::Object{{"material", "floor"}, {"order", 7}, {"albedo", 0.25}},
                                     Json::Object{{"material", "wall"}, {"order", 0}, {"albedo", 0.5}}};
  test::SampleColumns().writer().write(path, p);
  const Container file = Container::open(path);
  EXPECT_NE(describe_text(file).find("  materials\n    albedo 0.25, material floor, order 7\n"
                                     "    albedo 0.5, material wall, order 0\n"),
            std::string::npos)
      << describe_text(file);
  EXPECT_NE(canonical_text(file).find("  materials\n    material \"floor\", order 7\n"
                                      "    material \"wall\", order 0\n"),
            std::string::npos)
      << canonical_text(file);
}

// Golden files compare this text: another last bit, checksum or version of the program must not change it.
TEST(Canonical, IgnoresWhatRoundingChanges) {
  const std::string path = test::scratch("inspect-canonical") + "/b";
  test::SampleColumns c;
  c.flux[2].x = 1e-7f;
  Provenance p = test::sample_provenance();
  p.tool = "phos-photons 9.9.9", p.key = "other", p.inputs["scene"] = "other", p.scene_hash = "other";
  p.extra["total_flux"] = 1.2500001;
  c.writer().write(path, p);
  EXPECT_EQ(canonical_text(Container::open(path)), canonical_text(sample()));
  p.counters.add("degenerate triangle");
  c.writer().write(path, p);
  EXPECT_NE(canonical_text(Container::open(path)), canonical_text(sample()));
  p = test::sample_provenance();
  p.parameters["roulette"] = 0.2;
  c.writer().write(path, p);
  EXPECT_NE(canonical_text(Container::open(path)), canonical_text(sample()));
}

TEST(Csv, ColumnsHaveNames) {
  const Container file = sample();
  EXPECT_EQ(csv(file, {"path"}), "path\n0\n1\n2\n1\n0\n");
  EXPECT_EQ(csv(file, {"wide"}), "wide\n-9223372036854775808\n9223372036854775807\n");
  EXPECT_EQ(csv(file, {"id"}), "id\n18446744073709551615\n7\n");
  EXPECT_EQ(csv(file, {"exact"}), "exact\n1e-300\n1e+300\n");
  EXPECT_EQ(
      csv(file, {"position", "path"}),
      "position.x,position.y,position.z,path\n0,1,2,0\n3,4,5,1\n6,7,8.5,2\n-1,-2,-3,1\n0.1,0.2,0.3,0\n");
  EXPECT_EQ(csv(file, {"flux"}).substr(0, 21), "flux.r,flux.g,flux.b\n");
  EXPECT_EQ(csv(file, {"gradient"}).substr(0, 24), "gradient.0.0,gradient.0.") << "no tensor of photons";
  EXPECT_EQ(csv(file, {"none"}), "none.0,none.1,none.2\n");
}

// Where all extents are 3, the table tells colours from axes and from numbers.
TEST(Csv, ColoursAndAxesAreThoseOfTheTable) {
  const std::string path = test::scratch("inspect-names") + "/d";
  const std::vector<float> three(2 * 3 * 3, 1.f);
  const auto names = [&](FileKind kind, const std::string& tensor) {
    ContainerWriter writer;
    writer.add<float>(tensor, three, {2, 3, 3}, "1");
    Provenance p = test::sample_provenance();
    p.kind = kind;
    writer.write(path, p);
    const std::string all = csv(Container::open(path), {tensor});
    return all.substr(0, all.find(",", all.find(",") + 1));
  };
  EXPECT_EQ(names(FileKind::brdf, "7.coefficients"), "7.coefficients.0.r,7.coefficients.0.g");
  EXPECT_EQ(names(FileKind::irradiance, "rotation_gradient"), "rotation_gradient.r.x,rotation_gradient.r.y");
  EXPECT_EQ(names(FileKind::radiance, "stderr"), "stderr.r.0,stderr.r.1");
}

TEST(Describe, SaysWhatTensorsMean) {
  const Json tensors = *describe(sample()).find("tensors");
  EXPECT_EQ(tensors.find("flux")->find("meaning")->as_string(), "flux before the surface reflects");
  EXPECT_EQ(tensors.find("whole")->find("meaning"), nullptr);
  EXPECT_NE(describe_text(sample()).find("flux before the surface reflects"), std::string::npos);
}

TEST(Csv, DirectionsStayCodesUnlessDecoded) {
  const Container file = sample();
  EXPECT_EQ(csv(file, {"normal"}).substr(0, 7), "normal\n");
  const std::string decoded = csv(file, {"normal"}, true);
  EXPECT_EQ(decoded.substr(0, 27), "normal.x,normal.y,normal.z\n");
  float x = 9, y = 9, z = 9;
  ASSERT_EQ(std::sscanf(decoded.c_str() + 27, "%f,%f,%f", &x, &y, &z), 3);
  EXPECT_NEAR(x, 0, 1e-4);
  EXPECT_NEAR(y, 0, 1e-4);
  EXPECT_NEAR(z, 1, 1e-4);
}

TEST(Csv, WrongRequestsAreUsageErrors) {
  const Container file = sample();
  for (const std::vector<std::string>& names : {std::vector<std::string>{"nothing"}, {"position", "wide"}}) {
    try {
      csv(file, names);
      ADD_FAILURE();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::usage);
    }
  }
}

TEST(Ply, AsciiHasOneLinePerPoint) {
  const std::string s = ply(sample(), PlyFormat::ascii);
  EXPECT_EQ(s.find("ply\nformat ascii 1.0\n"), 0u);
  EXPECT_NE(s.find("element vertex 5\n"), std::string::npos);
  const std::string body = s.substr(s.find("end_header\n") + 11);
  EXPECT_EQ(std::count(body.begin(), body.end(), '\n'), 5);
  float v[6], y = 0;
  int rgb[3];
  ASSERT_EQ(std::sscanf(body.c_str() + body.find('\n') + 1, "%f %f %f %f %f %f %d %d %d %f", v, v + 1, v + 2,
                        v + 3, v + 4, v + 5, rgb, rgb + 1, rgb + 2, &y),
            10);
  EXPECT_EQ(v[0], 3);
  EXPECT_EQ(v[2], 5);
  EXPECT_NEAR(v[5], -1, 1e-4);
  EXPECT_GT(rgb[0], 0);
  EXPECT_EQ(rgb[1], 0);
  EXPECT_FLOAT_EQ(y, 2 * 0.2126f);
}

TEST(Ply, BinaryHasTheSameValues) {
  const std::string s = ply(sample(), PlyFormat::binary);
  const std::string body = s.substr(s.find("end_header\n") + 11);
  constexpr std::size_t kVertex = 6 * 4 + 3 + 4;
  ASSERT_EQ(body.size(), 5 * kVertex);
  float x = 0, y = 0;
  std::memcpy(&x, body.data() + kVertex, 4);
  std::memcpy(&y, body.data() + kVertex + 27, 4);
  EXPECT_EQ(x, 3.f);
  EXPECT_FLOAT_EQ(y, 2 * 0.2126f);
}

TEST(Ply, ColoursDoNotDependOnTheScaleOfTheLight) {
  const auto with_scale = [](float scale) {
    test::SampleColumns c;
    for (Vec3& f : c.flux) f *= scale;
    const std::string path = test::scratch("inspect-scale") + "/a";
    c.writer().write(path, test::sample_provenance());
    const std::string s = ply(Container::open(path), PlyFormat::binary);
    return s.substr(s.find("end_header\n") + 11 + 24, 3);
  };
  EXPECT_EQ(with_scale(0x1p-40f), with_scale(1.f));
  EXPECT_EQ(with_scale(0x1p40f), with_scale(1.f));
  EXPECT_EQ(with_scale(0.f), std::string(3, '\0'));
}

TEST(Ply, NoPositionsIsAnError) {
  const std::string path = test::scratch("inspect-no-positions") + "/a";
  ContainerWriter().write(path, test::sample_provenance());
  EXPECT_THROW(ply(Container::open(path), PlyFormat::ascii), Error);
}

}  // namespace
}  // namespace phos
