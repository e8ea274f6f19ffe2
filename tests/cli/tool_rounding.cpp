// Nothing cancels away: results hardly move where every rounding is another one. The same small study with
// another instruction set of the ray tracer, with another arithmetic library (glibc's functions without FMA
// and AVX2 round differently), and with programs built to fuse multiplications and additions
// (PHOS_OTHER_TOOLS=build/fma/bin; tests/extremes/rounding.sh).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "file/csv.h"
#include "image/image.h"
#include "support/faults.h"

namespace phos::test {
namespace {

struct Variant {
  std::string name, tools, isa, tunables;
};

class Rounding : public testing::Test {
 protected:
  /// The small study in a folder of its own.
  std::string make(const Variant& v) {
    const std::string folder = scratch("rounding-" + v.name), room = data("cornell-glossy22.glb");
    const auto at = [&](const std::string& name) { return folder + "/" + name; };
    spill(at("points.csv"),
          "x,y,z,nx,ny,nz\n0.3,0.001,0.1,0,1,0\n0.4,0.001,0.2,0,1,0\n0.2,0.001,0.3,0,1,0\n0.1,0.001,0.5,0,1,"
          "0\n");
    const auto run = [&](std::vector<std::string> words, const std::string& output, bool rays = true) {
      if (rays) words.insert(words.end(), {"--isa", v.isa});
      words.insert(words.end(), {"--quiet", "-o", at(output)});
      Hit hit;
      hit.tools = v.tools;
      hit.in_child = [&] {
        if (!v.tunables.empty()) setenv("GLIBC_TUNABLES", v.tunables.c_str(), 1);
      };
      const Outcome done = run_hit(words, folder, hit);
      ASSERT_EQ(done.code, 0) << v.name << ", " << words[0] << ": " << done.err;
    };
    std::filesystem::create_directories(at("tmp"));
    run({"photons", room, "--photons", "50000"}, "a.photons");
    run({"brdf", room, "--resolution", "8"}, "a.brdf", false);
    run({"irradiance", room, at("a.photons"), "--accuracy", "0.4"}, "hull.irradiance");
    run({"irradiance", room, at("hull.irradiance"), "--estimate", "gather", "--rays", "256", "--accuracy",
         "0.6"},
        "gather.irradiance");
    run({"radiance", room, at("a.photons"), at("a.brdf"), "--accuracy", "0.9"}, "a.radiance");
    run({"splat", room, at("hull.irradiance"), at("a.radiance"), at("a.brdf"), "--width", "32", "--height",
         "32", "--splat", "cpu"},
        "a.exr");
    for (const std::string kind : {"hull", "gather"})
      run({"sense", room, at(kind + ".irradiance"), "--points", at("points.csv")}, kind + ".csv");
    run({"reference", room, "--points", at("points.csv"), "--samples", "4096"}, "reference.csv", false);
    return folder;
  }

  /// The largest move of a lux figure, in its own standard errors.
  static double moved(const std::string& a, const std::string& b) {
    const CsvTable x = parse_csv(slurp(a), a), y = parse_csv(slurp(b), b);
    EXPECT_EQ(x.columns, y.columns);
    EXPECT_EQ(x.rows.size(), y.rows.size());
    const bool sensed = std::find(x.columns.begin(), x.columns.end(), "E_lx") != x.columns.end();
    const std::size_t lux = x.column(sensed ? "E_lx" : "illuminance_lx", a), error = x.column("stderr_lx", a);
    double most = 0;
    for (std::size_t i = 0; i < std::min(x.rows.size(), y.rows.size()); ++i)
      most = std::max(most, std::fabs(x.number(i, lux) - y.number(i, lux)) / x.number(i, error));
    return most;
  }

  void compare(const std::string& plain, const Variant& v) {
    const std::string other = make(v);
    if (HasFailure()) return;
    std::printf("%-10s", v.name.c_str());
    for (const std::string name : {"hull.csv", "gather.csv", "reference.csv"}) {
      const double most = moved(plain + "/" + name, other + "/" + name);
      EXPECT_LT(most, kMost) << v.name << ": " << name;
      std::printf("  %s moves by %.2g standard errors", name.c_str(), most);
    }
    const Image a = read_image(plain + "/a.exr"), b = read_image(other + "/a.exr");
    double difference = 0, sum = 0;
    for (const char* channel : {"R", "G", "B"}) {
      const std::span<const float> p = a.channel(channel), q = b.channel(channel);
      for (std::size_t i = 0; i < p.size(); ++i) {
        ASSERT_TRUE(std::isfinite(q[i]));
        difference += std::fabs(static_cast<double>(p[i]) - static_cast<double>(q[i]));
        sum += static_cast<double>(p[i]);
      }
    }
    EXPECT_LT(difference, kMostOfPicture * sum) << v.name;
    std::printf("  the picture by %.2g\n", difference / sum);
  }

  static constexpr double kMost = 0.5;            // standard errors
  static constexpr double kMostOfPicture = 0.01;  // mean change over mean
};

TEST_F(Rounding, MovesResultsByLessThanTheirErrors) {
  const std::string plain = make({"plain", PHOS_TOOLS, "best", ""});
  ASSERT_FALSE(HasFailure());
  const std::string other_libm =
      "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX,-AVX512F,-AVX2_Usable,-FMA_Usable,-AVX_Usable";
  compare(plain, {"sse2", PHOS_TOOLS, "sse2", ""});
  compare(plain, {"libm", PHOS_TOOLS, "best", other_libm});
  if (const char* tools = std::getenv("PHOS_OTHER_TOOLS")) compare(plain, {"fused", tools, "best", ""});
}

}  // namespace
}  // namespace phos::test
