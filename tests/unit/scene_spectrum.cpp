// Spectra and their files.
#include "scene/spectral/spectrum.h"

#include <gtest/gtest.h>

#include "support/complaint.h"

namespace phos::test {
namespace {

Spectrum paint(const std::string& rows) {
  return parse_spectrum("wavelength_nm,value\n" + rows, "paint.csv", SpectrumKind::reflectance);
}
std::string refusal(const std::string& text, SpectrumKind kind = SpectrumKind::reflectance) {
  return complaint_of([&] { parse_spectrum(text, "x.csv", kind); });
}
std::string refusal_of_rows(const std::string& rows, SpectrumKind kind = SpectrumKind::reflectance) {
  return refusal("wavelength_nm,value\n" + rows, kind);
}

}  // namespace

TEST(Spectrum, IsLinearBetweenAndEndsAsItsKindSays) {
  const Spectrum r = paint("400,0.2\n500,0.6\n700,0.4\n");
  EXPECT_EQ(r.at(390), 0.2);
  EXPECT_EQ(r.at(400), 0.2);
  EXPECT_DOUBLE_EQ(r.at(450), 0.4);
  EXPECT_DOUBLE_EQ(r.at(600), 0.5);
  EXPECT_EQ(r.at(780), 0.4);
  const Spectrum lamp({400, 500}, {2, 2}, Spectrum::Beyond::zero);
  EXPECT_EQ(lamp.at(399.9), 0);
  EXPECT_EQ(lamp.at(400), 2);
  EXPECT_EQ(lamp.at(500), 2);
  EXPECT_EQ(lamp.at(500.1), 0);
}

/// Means over parts of any size add up to the mean over all, whatever points they cut.
TEST(Spectrum, MeansAreExact) {
  const Spectrum r = paint("400,0.2\n500,0.6\n700,0.4\n");
  // By hand: 20 at 0.2, 100 at 0.4, 200 at 0.5, 80 at 0.4.
  EXPECT_DOUBLE_EQ(r.integral(380, 780), 4 + 40 + 100 + 32);
  EXPECT_DOUBLE_EQ(r.mean(490, 510), (10 * 0.58 + 10 * 0.595) / 20);
  EXPECT_DOUBLE_EQ(r.mean(380, 390), 0.2);
  EXPECT_DOUBLE_EQ(r.mean(720, 780), 0.4);
  const Spectrum line({588, 589, 590}, {0, 3, 0}, Spectrum::Beyond::zero);
  for (const Spectrum& s : {r, line, Spectrum(kCieD65), Spectrum(kCieZ)})
    for (const int n : {1, 7, 39, 400}) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += s.integral(380 + 400.0 * i / n, 380 + 400.0 * (i + 1) / n);
      EXPECT_NEAR(sum, s.integral(380, 780), 1e-10 * s.integral(380, 780)) << n;
    }
  EXPECT_DOUBLE_EQ(line.integral(380, 780), 3);
  EXPECT_DOUBLE_EQ(line.integral(380, 589), 1.5);
}

TEST(Spectrum, KnowsWhereItShines) {
  const Spectrum line({400, 500, 510, 520, 600}, {0, 0, 1, 0, 0}, Spectrum::Beyond::zero);
  EXPECT_EQ(line.above_zero_nm().lo_nm, 500);
  EXPECT_EQ(line.above_zero_nm().hi_nm, 520);
  const Spectrum dark({400, 500}, {0, 0}, Spectrum::Beyond::zero);
  EXPECT_GT(dark.above_zero_nm().lo_nm, dark.above_zero_nm().hi_nm);
}

TEST(SpectrumFile, ReadsWhatSpreadsheetsWrite) {
  const Spectrum r =
      parse_spectrum("\xEF\xBB\xBF# a paint\r\nvalue,wavelength_nm,note\r\n0.5,400,x\r\n\"0.25\",500,\r\n",
                     "p.csv", SpectrumKind::reflectance);
  EXPECT_EQ(r.wavelengths_nm(), (std::vector<double>{400, 500}));
  EXPECT_EQ(r.values(), (std::vector<double>{0.5, 0.25}));
}

TEST(SpectrumFile, PowerIsOfAnyUnit) {
  const auto lamp = [](const std::string& rows) {
    return parse_spectrum("wavelength_nm,value\n" + rows, "lamp.csv", SpectrumKind::power).values();
  };
  EXPECT_EQ(lamp("400,1\n500,4\n"), (std::vector<double>{0.25, 1}));
  EXPECT_EQ(lamp("400,1e307\n500,4e307\n"), (std::vector<double>{0.25, 1}));
  EXPECT_EQ(lamp("400,1e-307\n500,4e-307\n"), (std::vector<double>{0.25, 1}));
}

TEST(SpectrumFile, IsRefusedInOneLine) {
  EXPECT_NE(refusal("nm,v\n400,1\n").find("wavelength_nm"), std::string::npos);
  EXPECT_NE(refusal_of_rows("").find("no row"), std::string::npos);
  EXPECT_NE(refusal_of_rows("400,0.5\n400,0.5\n").find("line 3"), std::string::npos);
  EXPECT_NE(refusal_of_rows("500,0.5\n400,0.5\n").find("sort"), std::string::npos);
  EXPECT_NE(refusal_of_rows("-1,0.5\n").find("above 0"), std::string::npos);
  EXPECT_NE(refusal_of_rows("400,-0.5\n").find("not negative"), std::string::npos);
  EXPECT_NE(refusal_of_rows("400,nan\n").find("not negative"), std::string::npos);
  EXPECT_NE(refusal_of_rows("400,inf\n").size(), 0u);
  EXPECT_NE(refusal_of_rows("400,1e999\n").size(), 0u);
  EXPECT_NE(refusal_of_rows("400,x\n").find("x.csv:2"), std::string::npos) << refusal_of_rows("400,x\n");
  EXPECT_NE(refusal_of_rows("400\n").size(), 0u);
  EXPECT_NE(refusal_of_rows("400,45\n").find("percent"), std::string::npos);
  EXPECT_NE(refusal_of_rows("0.4,0.5\n0.7,0.5\n").find("do not overlap 380 to 780"), std::string::npos);
  EXPECT_NE(refusal_of_rows("800,0.5\n900,0.5\n").find("do not overlap"), std::string::npos);
  EXPECT_NE(refusal_of_rows("400,0\n700,0\n", SpectrumKind::power).find("no power"), std::string::npos);
  EXPECT_NE(refusal_of_rows("300,1\n380,0\n780,0\n900,1\n", SpectrumKind::power).find("no power"),
            std::string::npos);
  EXPECT_EQ(refusal_of_rows("400,45\n500,3\n", SpectrumKind::power), "");
  EXPECT_EQ(refusal_of_rows("500,0.5\n"), "") << "one point is a grey";
}

}  // namespace phos::test
