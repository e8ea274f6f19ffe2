// Readers of LM-63 and EULUMDAT: what files say, and what is wrong with them.
#include "scene/luminaire/photometric_file.h"

#include <gtest/gtest.h>

#include "support/complaint.h"
#include "support/run.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

std::string replaced(std::string s, const std::string& from, const std::string& to) {
  const std::size_t at = s.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? s : s.replace(at, from.size(), to);
}

/// 100 cd at nadir, linear to 0 at the horizontal.
std::string small_ies(const std::string& edition = "IESNA:LM-63-2002") {
  return edition +
         "\n[TEST] 1\n[MANUFAC] Maker\n[LUMINAIRE] Lamp\nTILT=NONE\n1 1000 2.0 3 1 1 2 -0.1 -0.1 0\n0.9 1 "
         "50\n0 45 90\n0\n"
         "100 50 0\n";
}

PhotometricFile parse(const std::string& bytes) { return parse_photometry(bytes, "lamp.ies"); }
float at(const PhotometricFile& file, double c, double gamma) {
  return file.photometry->candela(c_gamma_direction(c, gamma));
}
bool warns(const PhotometricFile& file, const std::string& word) {
  return std::any_of(file.warnings.begin(), file.warnings.end(),
                     [&](const std::string& w) { return w.find(word) != std::string::npos; });
}

TEST(Ies, AppliesItsFactors) {
  const PhotometricFile file = parse(small_ies());
  // Multiplier 2, ballast 0.9.
  EXPECT_NEAR(at(file, 0, 0), 180, 1e-3);
  EXPECT_NEAR(at(file, 77, 67.5), 45, 1e-3);
  EXPECT_NEAR(file.photometry->flux_lm(), 360 * kPiD * (1 - 2 / kPiD), 1e-3);
  EXPECT_EQ(file.lamp_lm, 1000);
  EXPECT_EQ(file.watts, 50);
  EXPECT_FALSE(file.absolute);
  EXPECT_EQ(file.title(""), "Maker, Lamp");
  EXPECT_EQ(file.opening.form, LuminousOpening::Form::cylinder_z);
  EXPECT_TRUE(file.warnings.empty()) << file.warnings[0];
}

TEST(Ies, EveryEditionHasItsFactors) {
  for (const auto& [edition, factor, told] : {std::tuple{"IESNA:LM-63-2002", 1.0, true},
                                              {"IESNA:LM-63-1995", 1.0, true},
                                              {"IES:LM-63-2019", 1.0, false},
                                              {"IESNA91", 0.5, false},
                                              {"a maker of 1986", 0.5, false}}) {
    const PhotometricFile file = parse(replaced(small_ies(edition), "0.9 1 50", "0.9 0.5 50"));
    EXPECT_NEAR(at(file, 0, 0), 180 * factor, 1e-3) << edition;
    EXPECT_EQ(warns(file, "no use for it"), told) << edition;
  }
  EXPECT_EQ(parse(small_ies("IES:LM-63-2019")).format, "LM-63-2019, type C");
  EXPECT_TRUE(warns(parse(small_ies("IESNA:LM-63-2077")), "is not known"));
}

TEST(Ies, FeetAndWindowsLinesAndAnything) {
  std::string s = replaced(small_ies(), "3 1 1 2 -0.1", "3 1 1 1 -0.1");
  EXPECT_NEAR(parse(s).opening.size_m.y, 0.03048f, 1e-7f);
  // Windows line ends, a byte-order mark, commas between numbers, Ctrl-Z, a plus, an exponent.
  std::string windows;
  for (const char c : small_ies()) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  windows = "\xef\xbb\xbf" + replaced(windows, "100 50 0", "1e2,+50 , 0") + "\x1agarbage 1 2 3";
  EXPECT_EQ(parse(windows).photometry->hash(), parse(small_ies()).photometry->hash());
  EXPECT_TRUE(warns(parse(small_ies() + "end of file\n"), "no numbers"));
}

TEST(Ies, AbsolutePhotometryHasNoLampLumens) {
  const PhotometricFile file = parse(replaced(small_ies(), "1 1000", "1 -1"));
  EXPECT_TRUE(file.absolute);
  EXPECT_EQ(file.lamp_lm, 0);
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_TRUE(warns(parse(replaced(small_ies(), "1 1000", "1 -5")), "absolute photometry is -1"));
}

TEST(Ies, SymmetryFillsTheCircle) {
  const auto lines = [](const std::string& angles, int planes) {
    std::string cd;
    for (int i = 0; i < planes; ++i) cd += text(10 * (i + 1), " ", 10 * (i + 1), "\n");
    return text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 ", planes, " 1 2 0 0 0\n1 1 1\n0 90\n", angles, "\n",
                cd);
  };
  const PhotometricFile quarter = parse(lines("0 45 90", 3));
  for (const double c : {45.0, 135.0, 225.0, 315.0}) EXPECT_NEAR(at(quarter, c, 30), 20, 1e-4) << c;
  EXPECT_NEAR(at(quarter, 90, 30), 30, 1e-4);
  EXPECT_NEAR(at(quarter, 270, 30), 30, 1e-4);
  EXPECT_NEAR(at(quarter, 180, 30), 10, 1e-4);
  const PhotometricFile half = parse(lines("0 60 180", 3));
  EXPECT_NEAR(at(half, 300, 30), 20, 1e-4);
  EXPECT_NEAR(at(half, 180, 30), 30, 1e-4);
  const PhotometricFile front = parse(lines("90 150 270", 3));  // LM-63-1995
  EXPECT_NEAR(at(front, 150, 30), 20, 1e-4);
  EXPECT_NEAR(at(front, 30, 30), 20, 1e-4);
  EXPECT_NEAR(at(front, 270, 30), 30, 1e-4);
  const PhotometricFile all = parse(lines("0 120 240 360", 4));
  EXPECT_NEAR(at(all, 240, 30), 30, 1e-4);
  EXPECT_NEAR(at(all, 180, 30), 25, 1e-4);
  const PhotometricFile open = parse(lines("0 120 240", 3));
  EXPECT_TRUE(warns(open, "taken to be that at 0"));
  EXPECT_NEAR(at(open, 300, 30), 20, 1e-4);
  EXPECT_NE(complaint_of([&] {
              parse(lines("0 30 60", 3));
            }).find("lamp.ies:6: horizontal angles run from 0 to 60"),
            std::string::npos);
  EXPECT_NE(complaint_of([&] { parse(lines("10 30 60", 3)); }).find("begin at 0"), std::string::npos);
}

TEST(Ies, TypeBLiesOnItsSide) {
  // Vertical angles -90 0 90 about y, horizontal 0 to 90 with the other side alike.
  const PhotometricFile file =
      parse("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 2 2 2 0 0 0\n1 1 1\n-90 0 90\n0 90\n1 10 4\n2 2 2\n");
  EXPECT_EQ(file.format, "LM-63-2002, type B");
  EXPECT_NEAR(file.photometry->candela({0, 0, -1}), 10, 1e-4);
  EXPECT_NEAR(file.photometry->candela({1, 0, 0}), 4, 1e-3);
  EXPECT_NEAR(file.photometry->candela({0, 1, 0}), 2, 1e-4);
  EXPECT_NEAR(file.photometry->candela({0, -1, 0}), 2, 1e-4);
  const float r = std::sqrt(0.5f);
  EXPECT_NEAR(file.photometry->candela({0, r, -r}), 6, 1e-3);
  EXPECT_EQ(file.photometry->candela({0, 0, 1}), 0);
}

TEST(Ies, TiltTables) {
  const std::string include =
      replaced(small_ies(), "TILT=NONE\n", "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.5\n");
  const PhotometricFile file = parse(include);
  EXPECT_EQ(file.tilt.factor(0), 1);
  EXPECT_NEAR(file.tilt.factor(22.5), 0.95, 1e-12);
  EXPECT_EQ(file.tilt.factor(120), 0.5);
  const std::string named = replaced(small_ies(), "TILT=NONE", "TILT=lamp.tlt");
  const auto beside = [](const std::string& name) {
    EXPECT_EQ(name, "lamp.tlt");
    return std::string("1\n2\n0 90\n1 0\n");
  };
  EXPECT_NEAR(parse_photometry(named, "lamp.ies", beside).tilt.factor(45), 0.5, 1e-12);
  EXPECT_NE(complaint_of([&] { parse(named); }).find("lamp.tlt"), std::string::npos);
}

TEST(Ies, TellsWhatIsWrongAndWhere) {
  const std::string good = small_ies();
  struct Case {
    std::string from, to, complaint;
  };
  for (const Case& c : {
           Case{"100 50 0\n", "100 50\n", "lamp.ies:10: ends before intensity 3 of horizontal angle 0"},
           {"100 50 0\n", "100 50 0 7\n", "lamp.ies:10: holds more numbers than its 3 x 1 angles need"},
           {"100 50 0\n", "1,5 50 0\n", "decimals are written with commas"},
           {"100 50 0", "100 nan 0", "lamp.ies:10: intensity 2 of horizontal angle 0 is \"nan\""},
           {"100 50 0", "100 1e999 0", "which is no finite number"},
           {"100 50 0", "100 -50 0", "lamp.ies:10: an intensity is negative: -50"},
           {"0 45 90", "0 90 45", "lamp.ies:8: vertical angles must ascend, but 90 is followed by 45"},
           {"0 45 90", "0 42,5 90", "are its decimals written with commas?"},
           {"0 45 90", "0 45 200", "vertical angles run from 0 to 200"},
           {"2.0 3 1", "2.0 1000000000 1", "ends before"},
           {"2.0 3 1", "2.0 1 1",
            "lamp.ies:6: the number of vertical angles is 1; it must be a whole number"},
           {"2.0 3 1", "2.0 3.5 1", "the number of vertical angles is 3.5"},
           {"2.0 3 1", "0 3 1", "the candela multiplier is 0"},
           {"3 1 1 2", "3 1 4 2", "the photometric type is 4"},
           {"3 1 1 2", "3 1 1 7", "the unit of lengths is 7"},
           {"TILT=NONE", "TILT=", "TILT= must be NONE"},
           {"TILT=NONE\n", "TILT=INCLUDE\n9\n", "lamp.ies:6: the lamp-to-luminaire geometry is 9"},
           {"TILT=NONE\n", "", "has no line TILT="},
       }) {
    const std::string told = complaint_of([&] { parse(replaced(good, c.from, c.to)); });
    EXPECT_NE(told.find(c.complaint), std::string::npos) << "expected: " << c.complaint << "\ntold: " << told;
  }
  // Noise below zero is accepted, and told.
  const PhotometricFile noise = parse(replaced(good, "100 50 0\n", "100 50 -0.3\n"));
  EXPECT_TRUE(warns(noise, "slightly negative"));
  EXPECT_EQ(at(noise, 0, 90), 0);
  // Lamps that give ten times what the intensities do are told; so is the other way.
  EXPECT_TRUE(warns(parse(replaced(good, "1 1000 2.0", "1 1000 20")), "of the 1000 lm of its lamps"));
  EXPECT_TRUE(warns(parse(replaced(good, "100 50 0\n", "0 0 0\n")), "gives no light"));
}

TEST(Ies, TellsOfNumbersThatAreMissingBeforeTheAngles) {
  const auto complaint = [](const std::string& bytes) { return complaint_of([&] { parse(bytes); }); };
  EXPECT_EQ(complaint(replaced(small_ies(), "0.9 1 50\n", "")),
            "lamp.ies:7: 3 numbers are missing before the angles: ballast factor, ballast-lamp factor and "
            "input watts; ask the maker for a sound file");
  // Without a height of the opening; without watts.
  for (const auto& [from, to] : {std::pair{"-0.1 -0.1 0", "-0.1 -0.1"}, {"0.9 1 50", "0.9 1"}}) {
    const std::string why = complaint(replaced(small_ies(), from, to));
    EXPECT_NE(why.find("1 number is missing before the angles"), std::string::npos) << why;
  }
  // As many are missing at the end of a file that is cut short.
  const std::string cut = complaint(replaced(small_ies(), "100 50 0\n", ""));
  EXPECT_NE(cut.find("cut short"), std::string::npos) << cut;
}

TEST(Ies, SurvivesBeingCutAnywhere) {
  for (const std::string name : {"spot.ies", "street.ies", "flood.ies", "pendant.ldt"}) {
    const std::string bytes = slurp(data("luminaires/" + name));
    ASSERT_FALSE(bytes.empty()) << name;
    for (std::size_t n = 0; n < bytes.size(); n += 1 + bytes.size() / 700)
      complaint_of([&] { parse(bytes.substr(0, n)); });
  }
}

TEST(Eulumdat, ReadsThePendant) {
  const PhotometricFile file = read_photometry(data("luminaires/pendant.ldt"));
  EXPECT_EQ(file.format, "EULUMDAT");
  EXPECT_EQ(file.lamp_lm, 4000);
  EXPECT_EQ(file.opening.form, LuminousOpening::Form::box);
  EXPECT_NEAR(glm::length(file.opening.size_m - Vec3(0.15f, 1.2f, 0.04f)), 0, 1e-6);
  // The first value of the file, in cd per 1000 lm of 4000 lm.
  EXPECT_NEAR(at(file, 0, 0), 4 * 148.2, 0.05);
  EXPECT_NEAR(file.photometry->flux_lm(), 4000 * 0.8243, 1);
  EXPECT_GT(at(file, 0, 135), 0);
  EXPECT_NEAR(at(file, 30, 60), at(file, 330, 60), 1e-3);
  EXPECT_NEAR(at(file, 30, 60), at(file, 150, 60), 1e-3);
  EXPECT_TRUE(file.warnings.empty()) << file.warnings[0];
}

/// 4 planes, 3 gammas; the planes' values differ.
std::string small_ldt(int symmetry) {
  std::string s = text("Maker\n1\n", symmetry, "\n4\n90\n3\n45\nreport\nLamp\nL-1\nlamp.ldt\n2026\n");
  s += "200\n0\n100\n150\n0\n10\n10\n10\n10\n100\n0\n1\n0\n1\n1\nLED\n1000\n3000\n80\n12\n";
  for (int k = 0; k < 10; ++k) s += "0.5\n";
  s += "0\n90\n180\n270\n0\n45\n90\n";
  const int stored[] = {4, 1, 3, 3, 2};
  for (int i = 0; i < stored[symmetry]; ++i)
    for (int j = 0; j < 3; ++j) s += text(10 * (i + 1), "\n");
  return s;
}

TEST(Eulumdat, SymmetryFillsTheCircle) {
  struct Case {
    int symmetry;
    float c0, c90, c180, c270;
  };
  for (const Case& c : {Case{0, 10, 20, 30, 40},
                        {1, 10, 10, 10, 10},
                        {2, 10, 20, 30, 20},
                        {3, 20, 30, 20, 10},
                        {4, 10, 20, 10, 20}}) {
    const PhotometricFile file = parse(small_ldt(c.symmetry));
    EXPECT_NEAR(at(file, 0, 30), c.c0, 1e-4) << c.symmetry;
    EXPECT_NEAR(at(file, 90, 30), c.c90, 1e-4) << c.symmetry;
    EXPECT_NEAR(at(file, 180, 30), c.c180, 1e-4) << c.symmetry;
    EXPECT_NEAR(at(file, 270, 30), c.c270, 1e-4) << c.symmetry;
    EXPECT_EQ(file.opening.describe(), "cylinder 0.15 m across, 0.01 m high");
  }
}

TEST(Eulumdat, AcceptsCommasAndAbsolutePhotometry) {
  const PhotometricFile plain = parse(small_ldt(1));
  const PhotometricFile commas = parse(replaced(small_ldt(1), "90\n10\n", "90\n10,0\n"));
  EXPECT_EQ(commas.photometry->hash(), plain.photometry->hash());
  EXPECT_TRUE(warns(commas, "decimal commas"));
  EXPECT_TRUE(parse(replaced(small_ldt(1), "1\n1\nLED", "1\n-1\nLED")).absolute);
  const PhotometricFile sets = parse(replaced(small_ldt(1), "1\n1\nLED\n1000\n3000\n80\n12\n",
                                              "2\n1\nLED\n1000\n3000\n80\n12\n2\nLED\n2000\n3000\n80\n24\n"));
  EXPECT_EQ(sets.lamp_lm, 1000);
  EXPECT_TRUE(warns(sets, "2 sets of lamps"));
  const PhotometricFile off = parse(replaced(small_ldt(1), "100\n0\n1\n0\n1\n", "40\n90\n1\n0\n1\n"));
  EXPECT_TRUE(warns(off, "light output ratio is stated as 90 %"));
  EXPECT_TRUE(warns(off, "downward flux fraction is stated as 40 %"));
}

TEST(Eulumdat, TellsWhatIsWrongAndWhere) {
  const std::string good = small_ldt(1);
  struct Case {
    std::string from, to, complaint;
  };
  for (const Case& c : {
           Case{"Maker\n1\n1\n4", "Maker\n1\n7\n4", "lamp.ies:3: the symmetry is 7"},
           {"1\n4\n90\n3\n", "1\n4\n90\n1000000000\n",
            "lamp.ies:6: the number of intensities in a plane is 1e+09"},
           {"0\n45\n90\n10", "0\n90\n45\n10", "gamma angles must ascend"},
           {"0\n45\n90\n10", "0\n45\n190\n10", "gamma runs from 0 to 190"},
           {"LED\n1000", "LED\n0", "states no lumens of lamps"},
           {"90\n10\n10\n10\n", "90\n10\nnan\n10\n", "intensity 2 of plane 1 of 1 is \"nan\""},
           {"90\n10\n10\n10\n", "90\n10\n10\n", "ends before intensity 3 of plane 1 of 1"},
           {"90\n10\n10\n10\n", "90\n10\n10\n10\n10\n", "has more numbers than its 1 x 3 intensities"},
           {"90\n10\n10\n10\n", "90\n10\n-10\n10\n", "an intensity is negative: -10"},
       }) {
    const std::string told = complaint_of([&] { parse(replaced(good, c.from, c.to)); });
    EXPECT_NE(told.find(c.complaint), std::string::npos) << "expected: " << c.complaint << "\ntold: " << told;
  }
  EXPECT_NE(complaint_of([] { parse("a,b\n1,2\n"); }).find("neither an IES"), std::string::npos);
}

TEST(PhotometricFile, NamesAreTextWhateverTheirBytes) {
  const PhotometricFile file = parse(replaced(small_ies(), "Maker", "B\xfcro \xc3\xbc \x01"));
  EXPECT_EQ(file.maker, "B\xc3\xbcro \xc3\xbc");
  EXPECT_EQ(describe_photometry(file).find("maker")->as_string(), file.maker);
}

}  // namespace
}  // namespace phos::test
