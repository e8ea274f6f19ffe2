// Bands at the command line: options of every stage, phos-bands, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "file/csv.h"
#include "image/image.h"
#include "support/refused.h"

namespace {

using namespace phos;
using namespace phos::test;
using Words = std::vector<std::string>;

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::string kBox = data("cornell-measured.glb");
constexpr int kTriplets = 4;  // of 12 bands

Words in_triplet(int k) { return {"--bands", "12", "--triplet", std::to_string(k)}; }

/// A grey room with a white lamp, and points in it.
struct Grey {
  std::string folder = scratch("bands-grey"), room = folder + "/room.obj", points = folder + "/points.csv";
  Grey() {
    spill(room,
          "mtllib room.mtl\nv 0 0 0\nv 2 0 0\nv 2 0 2\nv 0 0 2\nv 0 1.5 0\nv 2 1.5 0\nv 2 1.5 2\nv 0 1.5 2\n"
          "v 0.8 1.49 0.8\nv 1.2 1.49 0.8\nv 1.2 1.49 1.2\nv 0.8 1.49 1.2\n"
          "usemtl grey\no walls\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"
          "usemtl lamp\no lamp\nf 9 10 11 12\n");
    spill(folder + "/room.mtl", "newmtl grey\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 1000 1000 1000\n");
    spill(folder + "/room.lights.json",
          "{\"cameras\": [{\"name\": \"c\", \"eye\": [0.2, 0.7, 0.2], \"target\": [1.5, 0.4, 1.5]}]}");
    spill(points, "id,x,y,z,nx,ny,nz\n\"a, b\",1,0.001,1,0,1,0\nwall,0.001,0.7,1,1,0,0\n");
  }
};
const Grey& grey() {
  static const Grey made;
  return made;
}

/// Photons, records, a picture and sensors at `base`, with these words for every stage.
void stages(const std::string& scene, const std::string& points, const std::string& base,
            const Words& words) {
  const Words view{"--width", "40", "--height", "30"};
  ASSERT_EQ(run_tool(Words{"photons", scene, "--photons", "20000", "-o", base + ".photons"} + words).code, 0);
  ASSERT_EQ(run_tool(Words{"irradiance", scene, base + ".photons", "--place", "view", "--estimate", "gather",
                           "--rays", "32", "-o", base + ".irradiance"} +
                     view + words)
                .code,
            0);
  ASSERT_EQ(run_tool(Words{"splat", scene, base + ".irradiance", "-o", base + ".exr"} + view + words).code,
            0);
  const auto sense =
      run_tool(Words{"sense", scene, base + ".irradiance", "--points", points, "-o", base + ".csv"} + words);
  ASSERT_EQ(sense.code, 0) << sense.err;
}

/// The stages of the grey room in RGB, "rgb", and in triplets, "1" ..., made once.
const std::string& made() {
  static const std::string folder = [] {
    const Grey& g = grey();
    stages(g.room, g.points, g.folder + "/rgb", {});
    for (int k = 1; k <= kTriplets; ++k)
      stages(g.room, g.points, g.folder + "/" + std::to_string(k), in_triplet(k));
    return g.folder;
  }();
  return folder;
}

Words parts(const std::string& kind, std::initializer_list<int> triplets) {
  Words words;
  for (const int k : triplets) words.push_back(made() + "/" + std::to_string(k) + kind);
  return words;
}

CsvTable table_of(const std::string& path) { return parse_csv(slurp(path), path); }
double cell(const CsvTable& t, std::size_t row, const std::string& column) {
  return t.number(row, t.column(column, "test"));
}

}  // namespace

TEST(BandsTool, HelpSaysWhatItJoins) {
  const auto help = run_tool({"bands", "--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--dark", "Ra", "Duv", "CIE", "Rec.709", "130"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  for (const char* tool : {"photons", "irradiance", "splat", "sense", "reference", "scene", "plan"})
    for (const char* word : {"--bands", "--triplet", "--spectrum"})
      EXPECT_NE(run_tool({tool, "--help"}).out.find(word), std::string::npos) << tool << " " << word;
}

/// White light on grey walls: in bands the picture of RGB, to rounding, with as much noise.
TEST(BandsTool, GreyRoomsAreWhatTheyAreInRgb) {
  const std::string out = made() + "/joined.exr";
  const auto run = run_tool(Words{"bands", "-o", out} + parts(".exr", {3, 1, 4, 2}));
  ASSERT_EQ(run.code, 0) << run.err;
  const Image bands = read_image(out), rgb = read_image(made() + "/rgb.exr");
  for (const auto& [name, values] : rgb.channels()) {
    ASSERT_TRUE(bands.has(name)) << name;
    const std::span<const float> joined = bands.channel(name);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const float value = values[i], least = std::fabs(value) + 0.1f;
      if (name.starts_with("stderr"))  // about as much, and more where each band erring on its own is more
        ASSERT_TRUE(joined[i] > 0.9f * value - 0.01f * least && joined[i] < 1.6f * value + 0.01f * least)
            << name << " " << i << ": " << joined[i] << ", in RGB " << value;
      else
        ASSERT_NEAR(joined[i], value, 2e-5f * least) << name << " " << i << " " << joined[i] << " " << value;
    }
  }
  // The same files in another order are the same picture.
  const std::string again = made() + "/again.exr";
  EXPECT_EQ(run_tool(Words{"bands", "-o", again} + parts(".exr", {1, 2, 3, 4})).code, 0);
  EXPECT_EQ(read_image(again).channels(), bands.channels());
}

TEST(BandsTool, SensorsHaveLuxColourAndSpectrum) {
  const std::string out = made() + "/joined.csv";
  const auto run = run_tool(Words{"bands", "-o", out} + parts(".csv", {1, 2, 3, 4}));
  ASSERT_EQ(run.code, 0) << run.err;
  const CsvTable joined = table_of(out), rgb = table_of(made() + "/rgb.csv");
  ASSERT_EQ(joined.rows.size(), 2u);
  EXPECT_EQ(joined.rows[0][0], "a, b");
  for (std::size_t row = 0; row < 2; ++row) {
    for (const char* name : {"x", "ny", "E_lx", "direct_lx", "indirect_lx"})
      EXPECT_NEAR(cell(joined, row, name), cell(rgb, row, name), 2e-5 * std::fabs(cell(rgb, row, name)))
          << name;
    EXPECT_NEAR(cell(joined, row, "stderr_lx") / cell(rgb, row, "stderr_lx"), 1, 0.01);
    const double y = cell(joined, row, "Y_lx");
    EXPECT_NEAR(y / cell(joined, row, "E_lx"), 1, 1e-5);
    EXPECT_NEAR(cell(joined, row, "X_lx") / y, 0.3127 / 0.3290, 1e-4);
    EXPECT_NEAR(cell(joined, row, "Z_lx") / y, (1 - 0.3127 - 0.3290) / 0.3290, 1e-4);
    EXPECT_NEAR(cell(joined, row, "CCT_K"), 6504, 5);
    EXPECT_NEAR(cell(joined, row, "Ra"), 100, 0.5);
    double sum = 0;
    for (int b = 1; b <= 12; ++b) sum += cell(joined, row, "band_" + std::to_string(b) + "_of_12_lx");
    EXPECT_NEAR(sum / y, 1, 1e-5);
  }
  // To stdout too.
  const auto piped = run_tool(Words{"bands"} + parts(".csv", {1, 2, 3, 4}));
  EXPECT_EQ(piped.out, slurp(out));
}

TEST(BandsTool, RefusesWhatDoesNotBelongTogether) {
  const std::string out = made() + "/never.exr", rgb = made() + "/rgb.exr";
  const auto refused = [&](const Words& words, int code, const std::string& word) {
    expect_refused("bands", words + Words{"-o", out}, code, word);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  EXPECT_EQ(run_tool({"bands"}).code, 2);
  refused(parts(".exr", {1, 2, 4}), 4, "triplet 3 of 4 is missing");
  refused(parts(".csv", {4}), 4, "triplets 1,2,3 of 4 are missing");
  refused(parts(".exr", {1, 2, 2, 3, 4}), 4, "is triplet 2, and so is");
  refused(parts(".exr", {1, 2, 3, 4}) + Words{"--dark", "2"}, 4, "dark");
  refused(parts(".exr", {1, 2, 3, 4}) + Words{"--dark", "5"}, 2, "have 4 triplets");
  refused(parts(".exr", {1, 2, 3, 4}) + Words{"--dark", "x"}, 2, "no triplet");
  refused(parts(".exr", {1, 2, 3}) + parts(".csv", {4}), 2, "each on their own");
  refused(parts(".exr", {1, 2, 3}) + Words{rgb}, 3, "rgb.exr: is a picture in RGB");
  refused(parts(".csv", {1, 2, 3}) + Words{made() + "/rgb.csv"}, 3, "has no bands");
  refused(parts(".exr", {1, 2, 3}) + Words{data("sky.hdr")}, 3, "sky.hdr");
  refused({made() + "/nothing.exr"}, 3, "nothing.exr");
  const std::string whole = made() + "/whole.csv", odd = made() + "/odd.csv";
  ASSERT_EQ(run_tool(Words{"bands", "-o", whole} + parts(".csv", {1, 2, 3, 4})).code, 0);
  refused({whole}, 3, "more than one triplet");
  spill(odd, "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx,band_1_of_3_lx,band_400_of_400_lx\n");
  refused({odd}, 3, "more than one triplet");
  spill(odd, "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx,band_1_of_3_lx,band_2_of_3_lx\n");
  refused({odd}, 3, "band_3_of_3_lx");
  spill(odd, "id,x,y,z,nx,ny,nz,E_lx,stderr_lx,direct_lx,indirect_lx,band_1_of_1_lx\n");
  refused({odd}, 3, "has no bands");
  expect_refused("bands", parts(".exr", {1, 2, 3, 4}), 2, "-o");

  const std::string cut = made() + "/cut.exr";
  spill(cut, slurp(made() + "/4.exr").substr(0, 3000));
  refused(parts(".exr", {1, 2, 3}) + Words{cut}, 3, "cut.exr");
  // Another width, another scene, another number of bands, other sensors.
  const std::string other = made() + "/other";
  ASSERT_EQ(run_tool(Words{"splat", grey().room, made() + "/4.irradiance", "--width", "20", "--height", "30",
                           "-o", other + ".exr"} +
                     in_triplet(4))
                .code,
            0);
  refused(parts(".exr", {1, 2, 3}) + Words{other + ".exr"}, 4, "--width");
  const std::string points = made() + "/others.csv";
  spill(points, "x,y,z,nx,ny,nz\n1,0.001,1,0,1,0\n");
  ASSERT_EQ(run_tool(Words{"sense", grey().room, "--direct-only", "--points", points, "-o", other + ".csv"} +
                     in_triplet(4))
                .code,
            0);
  refused(parts(".csv", {1, 2, 3}) + Words{other + ".csv"}, 4, "same sensors");
  ASSERT_EQ(run_tool({"sense", grey().room, "--direct-only", "--points", grey().points, "-o", other + ".csv",
                      "--bands", "24", "--triplet", "4"})
                .code,
            0);
  refused(parts(".csv", {1, 2, 3}) + Words{other + ".csv"}, 4, "24 bands");
  ASSERT_EQ(run_tool(Words{"reference", kBox, "--width", "8", "--samples", "2", "-o", other + ".exr"} +
                     in_triplet(4))
                .code,
            0);
  refused(parts(".exr", {1, 2, 3}) + Words{other + ".exr"}, 4, "another program");
}

/// Dark triplets add nothing; the table's other columns are there, their colour is unknown where it is none.
TEST(BandsTool, DarkTripletsNeedNoPart) {
  const std::string out = made() + "/dark.exr";
  ASSERT_EQ(run_tool(Words{"bands", "--dark", "1,2", "-o", out} + parts(".exr", {3, 4})).code, 0);
  const Image image = read_image(out);
  EXPECT_FALSE(image.has_layer("albedo"));
  EXPECT_TRUE(image.has_layer("direct"));
  const auto table = run_tool(Words{"bands", "--dark", "2,3,4"} + parts(".csv", {1}));
  ASSERT_EQ(table.code, 0) << table.err;
  const CsvTable joined = parse_csv(table.out, "stdout");
  EXPECT_TRUE(std::isnan(cell(joined, 0, "Ra"))) << "violet light has no colour temperature";
  EXPECT_EQ(cell(joined, 0, "band_7_of_12_lx"), 0);
}

TEST(BandOptions, AreRefusedInOneLine) {
  const std::string out = scratch("bands-refused") + "/x.photons";
  const auto refused = [&](const Words& words, int code, const std::string& word) {
    expect_refused("photons", Words{kBox, "-o", out} + words, code, word);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  const std::string led = data("spectra/led.csv");
  refused({"--bands", "12"}, 2, "--triplet");
  refused({"--bands", "2", "--triplet", "1"}, 2, "3 to 400");
  refused({"--bands", "12", "--triplet", "5"}, 2, "4 triplets");
  refused({"--triplet", "1"}, 2, "--bands");
  refused({"--spectrum", "light=" + led}, 2, "--bands");
  refused(in_triplet(2) + Words{"--spectrum", "nobody=" + led}, 2, "nobody");
  refused(in_triplet(2) + Words{"--spectrum", "white=" + led + "x"}, 3, "led.csvx");
  refused(in_triplet(2) + Words{"--spectrum", "white=" + data("sky.hdr")}, 3, "sky.hdr");
  const std::string blue = scratch("bands-blue") + "/blue.csv";
  spill(blue, "wavelength_nm,value\n400,0.5\n450,0.5\n");
  refused(in_triplet(2) +
              Words{"--spectrum", "white=" + blue, "--spectrum", "light=" + data("spectra/sodium.csv")},
          3, "hold nothing of the light of");
  spill(blue, "wavelength_nm,value\n0.4,0.5\n0.7,0.5\n");
  refused(in_triplet(2) + Words{"--spectrum", "white=" + blue}, 3, "do not overlap 380 to 780");
  // A lamp that is dark in this triplet.
  refused({"--bands", "39", "--triplet", "2", "--spectrum", "light=" + data("spectra/sodium.csv")}, 3,
          "--dark 2");
}

TEST(BandOptions, CachesKnowTheirTriplet) {
  const std::string cache = made() + "/2.irradiance", out = made() + "/wrong.exr";
  expect_refused("splat", Words{grey().room, cache, "-o", out} + in_triplet(3), 4,
                 "made with --bands 12 --triplet 2, not with --bands 12 --triplet 3");
  expect_refused("splat", {grey().room, cache, "--bands", "12", "--triplet", "1", "-o", out}, 4,
                 "not with --bands 12 --triplet 1");
  expect_refused("splat", Words{grey().room, made() + "/rgb.irradiance", "-o", out} + in_triplet(3), 4,
                 "made in RGB");
  const auto info = run_tool({"info", cache});
  EXPECT_NE(info.out.find("--bands 12"), std::string::npos) << info.out;
  // What is not given is the cache's.
  const Words view{"splat", grey().room, cache, "--width", "16", "--splat", "cpu", "-o"};
  const auto silent = run_tool(view + Words{made() + "/silent.exr"});
  ASSERT_EQ(silent.code, 0) << silent.err;
  EXPECT_NE(silent.err.find("bands 12, triplet 2: as of " + cache), std::string::npos) << silent.err;
  ASSERT_EQ(run_tool(view + Words{made() + "/said.exr"} + in_triplet(2)).code, 0);
  EXPECT_EQ(slurp(made() + "/silent.exr"), slurp(made() + "/said.exr"));
}

TEST(BandOptions, SceneReportsSayWhichLightItIs) {
  const auto report = run_tool(Words{"scene", kBox} + in_triplet(4));
  EXPECT_NE(report.out.find("light of 680 to 780 nm alone: triplet 4 of 12 bands"), std::string::npos)
      << report.out;
  EXPECT_EQ(run_tool({"scene", kBox}).out.find("nm alone"), std::string::npos);
}
