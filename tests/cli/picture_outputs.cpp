// phos-picture from a shell.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/error.h"
#include "file/csv.h"
#include "image/image.h"
#include "support/refused.h"

namespace phos {
namespace {

using test::run_tool;

class PictureTool : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch("picture");
    Image image(64, 48);
    std::vector<Rgb> ramp(image.pixels());
    for (std::size_t i = 0; i < ramp.size(); ++i)
      ramp[i] = Rgb(1, 2, 3) * std::exp2(static_cast<float>(i % 64) / 6);
    image.set_rgb("", ramp);
    for (float& v : image.channel("illuminance.Y")) v = 300;
    for (const char* c : {"normal.X", "normal.Y"}) image.channel(c);
    for (float& v : image.channel("normal.Z")) v = 1;
    image.attributes["VIEW"] = "-vtv";
    write_exr(path("in.exr"), image);
    image.channel("R")[5] = NAN;
    write_exr(path("nan.exr"), image);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string folder_;
};

TEST_F(PictureTool, ToneMappedPng) {
  for (const char* op : {"reinhard", "filmic", "linear"}) {
    const auto run = run_tool({"picture", path("in.exr"), "-o", path("out.png"), "--operator", op});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.out, "");
    const Picture p = read_png(path("out.png"));
    EXPECT_EQ(p.width, 64);
    EXPECT_EQ(p.height, 48);
    EXPECT_LT(p.rgb[1], p.rgb[3 * 40 + 1]);
  }
}

TEST_F(PictureTool, SameBytesOnAnyNumberOfThreads) {
  run_tool({"picture", path("in.exr"), "-o", path("1.png"), "--threads", "1"});
  run_tool({"picture", path("in.exr"), "-o", path("4.png"), "--threads", "4"});
  EXPECT_FALSE(test::slurp(path("1.png")).empty());
  EXPECT_EQ(test::slurp(path("1.png")), test::slurp(path("4.png")));
}

TEST_F(PictureTool, FalseColourOfEveryScale) {
  for (const std::vector<std::string>& extra :
       std::vector<std::vector<std::string>>{{},
                                             {"--scale", "linear"},
                                             {"--scale", "log", "--min", "1", "--max", "1000"},
                                             {"--palette", "turbo"},
                                             {"--layer", "illuminance"}}) {
    std::vector<std::string> words{"picture", path("in.exr"), "-o", path("fc.png"), "--false-colour"};
    words.insert(words.end(), extra.begin(), extra.end());
    const auto run = run_tool(words);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_GT(read_png(path("fc.png")).width, 64);
  }
}

TEST_F(PictureTool, NormalsAsColours) {
  EXPECT_EQ(run_tool({"picture", path("in.exr"), "-o", path("n.png"), "--layer", "normal"}).code, 0);
  const Picture p = read_png(path("n.png"));
  EXPECT_EQ(p.rgb[2], 255);
  EXPECT_EQ(p.rgb[0], p.rgb[1]);
}

TEST_F(PictureTool, NonFinitePixelsAreMagentaAndReported) {
  const auto run = run_tool({"picture", path("nan.exr"), "-o", path("out.png")});
  EXPECT_EQ(run.code, 0);
  EXPECT_NE(run.err.find("1 of 3072 pixels are not finite"), std::string::npos) << run.err;
  const Picture p = read_png(path("out.png"));
  EXPECT_EQ(p.rgb[15], 255);
  EXPECT_EQ(p.rgb[16], 0);
  EXPECT_EQ(p.rgb[17], 255);
}

TEST_F(PictureTool, RadianceOutput) {
  EXPECT_EQ(run_tool({"picture", path("in.exr"), "-o", path("out.hdr")}).code, 0);
  const Image back = read_image(path("out.hdr"));
  EXPECT_EQ(back.attributes.at("VIEW"), "-vtv");
  EXPECT_NEAR(luminance(back.rgb("")[0]), luminance(Rgb(1, 2, 3)), 0.02);
}

TEST_F(PictureTool, NumbersAsATable) {
  EXPECT_EQ(run_tool({"picture", path("in.exr"), "-o", path("out.csv"), "--layer", "illuminance"}).code, 0);
  const Image image = read_image(path("in.exr"));
  const CsvTable table = parse_csv(test::slurp(path("out.csv")), "out.csv");
  ASSERT_EQ(table.rows.size(), image.pixels());
  const std::size_t i = image.pixels() - 1;
  EXPECT_EQ(table.number(i, table.column("x", "")), image.width() - 1);
  EXPECT_EQ(table.number(i, table.column("y", "")), image.height() - 1);
  EXPECT_FLOAT_EQ(static_cast<float>(table.number(i, table.column("illuminance.Y", ""))),
                  image.channel("illuminance.Y")[i]);
  EXPECT_EQ(run_tool({"picture", path("in.exr"), "-o", path("rgb.csv")}).code, 0);
  EXPECT_TRUE(test::slurp(path("rgb.csv")).starts_with("x,y,R,G,B\n0,0,"));
  test::expect_refused("picture", {path("in.exr"), "-o", path("no.csv"), "--layer", "glossy"}, 3, "glossy");
}

TEST_F(PictureTool, PlotsOfATable) {
  test::spill(path("t.dat"), "method,seconds,rmse\na,1,0.1\nb,1,0.2\na,10,0.03\nb,10,0\n");
  const std::vector<std::string> words{"picture",  path("t.dat"), "--x",     "seconds", "--y", "rmse",
                                       "--series", "method",      "--log-x", "--log-y", "-o"};
  for (const std::string name : {"t.svg", "t.png"}) {
    std::vector<std::string> all = words;
    all.push_back(path(name));
    const auto run = run_tool(all);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NE(run.err.find("1 points are left out"), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
  }
  const std::string svg = test::slurp(path("t.svg"));
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_EQ(read_png(path("t.png")).width, 1440);
}

TEST_F(PictureTool, LinesOfEqualValue) {
  // Over the tone-mapped beauty, over false colours, and as plans of a table.
  Image image(200, 120);
  image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(1)));
  for (std::size_t i = 0; i < image.pixels(); ++i)
    image.channel("illuminance.Y")[i] = static_cast<float>(i % 200);
  write_exr(path("lit.exr"), image);
  const auto make = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "picture");
    const auto run = run_tool(words);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err, "");
  };
  make({path("lit.exr"), "-o", path("plain.png")});
  make({path("lit.exr"), "-o", path("lines.png"), "--contours", "illuminance"});
  make({path("lit.exr"), "-o", path("two.png"), "--contours", "illuminance", "--levels", "50,150"});
  make({path("lit.exr"), "-o", path("false.png"), "--layer", "illuminance", "--false-colour", "--contours",
        "illuminance"});
  EXPECT_EQ(read_png(path("lines.png")).width, 200);
  EXPECT_NE(read_png(path("lines.png")).rgb, read_png(path("plain.png")).rgb);
  EXPECT_NE(read_png(path("lines.png")).rgb, read_png(path("two.png")).rgb);
  std::string csv = "id,x,y,z,E_lx\n";
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) csv += text("p", i, ",", i, ",0.8,", j, ",", 100 * i, "\n");
  test::spill(path("plane.csv"), csv);
  for (const std::string name : {"plan.svg", "plan.png"}) {
    const std::vector<std::string> words{path("plane.csv"), "--contours", "E_lx", "--spacing", "1", "-o"};
    std::vector<std::string> all = words;
    all.push_back(path(name));
    make(all);
    const std::string bytes = test::slurp(path(name));
    all.back() = path("again" + name);
    make(all);
    EXPECT_EQ(test::slurp(path("again" + name)), bytes);
  }
  EXPECT_EQ(read_png(path("plan.png")).width, 1440);
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& word) {
    words.insert(words.end(), {"-o", path("no.png")});
    test::expect_refused("picture", words, code, word);
  };
  refused({path("plane.csv"), "--contours", "E_lx"}, 2, "--spacing");
  refused({path("plane.csv"), "--contours", "df", "--spacing", "1"}, 2, "\"df\"");
  refused({path("plane.csv"), "--contours", "E_lx", "--spacing", "0.3"}, 3, "neighbours");
  refused({path("plane.csv"), "--contours", "E_lx", "--spacing", "1", "--x", "x"}, 2, "--x");
  refused({path("plane.csv"), "--levels", "5"}, 2, "--levels");
  refused({path("lit.exr"), "--contours", "glossy"}, 3, "glossy");
  refused({path("lit.exr"), "--contours", "illuminance", "--levels", "5,x"}, 2, "\"x\"");
  refused({path("lit.exr"), "--contours", "illuminance", "--spacing", "1"}, 2, "--spacing");
  test::expect_refused("picture", {path("lit.exr"), "--contours", "illuminance", "-o", path("no.hdr")}, 2,
                       "--contours");
}

TEST_F(PictureTool, LinesOfASequenceAreThoseOfItsFirstFrame) {
  for (int frame = 0; frame < 2; ++frame) {
    Image image(60, 40);
    image.set_rgb("", std::vector<Rgb>(image.pixels(), Rgb(1)));
    for (std::size_t i = 0; i < image.pixels(); ++i)
      image.channel("illuminance.Y")[i] = static_cast<float>(i % 60) * (frame == 0 ? 1.0f : 100.0f);
    write_exr(path("f" + std::to_string(frame) + ".exr"), image);
  }
  const auto run = run_tool({"picture", path("f%01d.exr"), "--frames", "0:1", "--contours", "illuminance",
                             "-o", path("f%01d.png")});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_NE(run.err.find("lines of frame 0: --levels 20,40"), std::string::npos) << run.err;
}

TEST_F(PictureTool, LettersDoNotDependOnSettingsOfFonts) {
  test::spill(path("t.csv"), "n,e\n1,2\n3,4\n");
  const auto draw = [&](const std::string& name) {
    return run_tool({"picture", path("t.csv"), "--x", "n", "--y", "e", "-o", path(name)});
  };
  ASSERT_EQ(draw("a.png").code, 0);
  const std::string head = "<?xml version=\"1.0\"?><!DOCTYPE fontconfig SYSTEM \"fonts.dtd\"><fontconfig>",
                    cache = "<cachedir>" + path("cache") + "</cachedir>";
  test::spill(path("odd.conf"),
              head + "<dir>/usr/share/fonts</dir>" + cache +
                  "<match target=\"pattern\"><edit name=\"antialias\"><bool>false</bool></edit></match>"
                  "<match target=\"font\"><edit name=\"antialias\"><bool>false</bool></edit>"
                  "<edit name=\"hintstyle\"><const>hintfull</const></edit>"
                  "<edit name=\"embolden\"><bool>true</bool></edit></match></fontconfig>");
  test::spill(path("none.conf"), head + "<dir>" + path("nowhere") + "</dir>" + cache + "</fontconfig>");
  setenv("FONTCONFIG_FILE", path("odd.conf").c_str(), 1);
  const auto odd = draw("b.png");
  setenv("FONTCONFIG_FILE", path("none.conf").c_str(), 1);
  const auto none = draw("c.png");
  unsetenv("FONTCONFIG_FILE");
  EXPECT_EQ(odd.code, 0) << odd.err;
  EXPECT_EQ(test::slurp(path("a.png")), test::slurp(path("b.png")));
  EXPECT_EQ(none.code, 3);
  EXPECT_NE(none.err.find("fonts-dejavu-core"), std::string::npos) << none.err;
  EXPECT_FALSE(std::filesystem::exists(path("c.png")));
}

TEST_F(PictureTool, PlotErrors) {
  test::spill(path("t.csv"), "n,e\n1,2\n3,x\n");
  test::spill(path("ragged.csv"), "n,e\n1,2\n3\n");
  test::expect_refused("picture", {path("t.csv"), "-o", path("t.svg")}, 2, "n, e");
  test::expect_refused("picture", {path("t.csv"), "--x", "n", "--y", "f", "-o", path("t.svg")}, 2, "\"f\"");
  test::expect_refused("picture", {path("t.csv"), "--x", "n", "--y", "e", "-o", path("t.svg")}, 3, "t.csv:3");
  test::expect_refused("picture", {path("ragged.csv"), "--x", "n", "--y", "e", "-o", path("t.svg")}, 3, ":3");
  test::expect_refused("picture", {path("t.csv"), "--x", "n", "--y", "e", "-o", path("t.hdr")}, 2, "a table");
  test::expect_refused("picture", {path("in.exr"), "-o", path("t.svg")}, 2, "an image");
  test::expect_refused("picture", {path("in.exr"), "--x", "n", "-o", path("t.png")}, 2, "--x");
  EXPECT_FALSE(std::filesystem::exists(path("t.svg")));
}

TEST_F(PictureTool, Errors) {
  const auto expect = [&](int code, std::vector<std::string> words) {
    const auto run = run_tool(words);
    EXPECT_EQ(run.code, code) << run.err;
    EXPECT_TRUE(test::is_one_line(run.err)) << run.err;
  };
  test::spill(path("old.png"), "what was there before");
  expect(3, {"picture", path("missing.exr"), "-o", path("old.png")});
  expect(3, {"picture", path("in.exr"), "-o", path("old.png"), "--layer", "glossy"});
  expect(3, {"picture", path("in.exr"), "-o", path("old.png"), "--layer", "normal", "--false-colour"});
  expect(2, {"picture", path("in.exr"), "-o", path("old.png"), "--false-colour", "--min", "5", "--max", "2"});
  EXPECT_EQ(test::slurp(path("old.png")), "what was there before");
  expect(2, {"picture", path("in.exr"), "-o", path("out.jpg")});
  expect(2, {"picture", path("in.exr"), "-o", path("out.hdr"), "--false-colour"});
  expect(3, {"picture", path("in.exr"), "-o", path("no/out.png")});
  expect(2, {"picture", path("in.exr")});
}

}  // namespace
}  // namespace phos
