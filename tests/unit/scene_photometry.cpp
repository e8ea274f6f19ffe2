// Distributions of luminous intensity: what lies between the nodes, their flux, and where they shine.
#include "scene/luminaire/photometry.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "core/sampling.h"
#include "support/luminaires.h"

namespace phos::test {
namespace {

constexpr double kPiD = std::numbers::pi;

/// Midpoints of a fine grid over the sphere about z.
double quadrature(const Photometry& photometry) {
  constexpr int kRows = 2000, kColumns = 720;
  double sum = 0;
  for (int i = 0; i < kRows; ++i) {
    const double z = -1 + 2 * (i + 0.5) / kRows, s = std::sqrt(1 - z * z);
    for (int j = 0; j < kColumns; ++j) {
      const double phi = 2 * kPiD * (j + 0.5) / kColumns;
      sum += photometry.candela(Vec3(DVec3(s * std::cos(phi), s * std::sin(phi), z)));
    }
  }
  return sum * 4 * kPiD / kRows / kColumns;
}

TEST(Photometry, KnowsTheFluxOfClosedForms) {
  // Isotropic: 4 pi I. Lambertian: pi I.
  EXPECT_NEAR(Photometry(grid_of(isotropic(100))).flux_lm(), 400 * kPiD, 1e-4);
  EXPECT_NEAR(Photometry(grid_of(lambertian(1000))).flux_lm(), 1000 * kPiD, 1e-2);
  // A linear fall from I to 0 over gamma: 2 pi I int (1 - 2 g / pi) sin g dg = 2 pi I (1 - 2 / pi).
  const Formula linear{[](double, double gamma) { return 100 * (1 - gamma / 90); }, 360, 90, 90};
  EXPECT_NEAR(Photometry(grid_of(linear)).flux_lm(), 200 * kPiD * (1 - 2 / kPiD), 2e-4);
}

TEST(Photometry, FluxIsTheIntegralOfWhatIsInterpolated) {
  PhotometricGrid grid =
      grid_of({[](double c, double g) { return 1 + std::fmod(7 * c + 3 * g, 50); }, 30, 7.5, 150});
  for (const auto poles : {PhotometricGrid::Poles::c, PhotometricGrid::Poles::b, PhotometricGrid::Poles::a}) {
    grid.poles = poles;
    const Photometry photometry(grid);
    EXPECT_NEAR(photometry.flux_lm(), quadrature(photometry), 1e-3 * photometry.flux_lm());
  }
}

TEST(Photometry, IsLinearBetweenNodesAndZeroBeyond) {
  const Formula f = lopsided();
  const Photometry photometry(grid_of(f));
  for (const double c : {0.0, 17.0, 179.0, 200.0, 359.0})
    for (const double gamma : {0.5, 12.0, 45.0, 89.5})
      EXPECT_NEAR(photometry.candela(c_gamma_direction(c, gamma)), f.candela(c, gamma), 1e-3)
          << c << " " << gamma;
  EXPECT_EQ(photometry.candela({0, 0, 1}), 0);
  EXPECT_EQ(photometry.candela(c_gamma_direction(30, 91)), 0);
  EXPECT_NEAR(photometry.peak_cd(), f.candela(0, 90), 1e-3);
  EXPECT_LT(glm::length(photometry.peak_direction() - Vec3(1, 0, 0)), 1e-5f);
}

TEST(Photometry, SplitsFluxAtTheHorizontal) {
  // Even over a step that crosses the horizontal: half of an isotropic lamp goes down.
  EXPECT_NEAR(Photometry(grid_of({[](double, double) { return 3.0; }, 360, 60, 180})).downward_share(), 0.5,
              1e-6);
  EXPECT_EQ(Photometry(grid_of(lambertian(10))).downward_share(), 1);
  PhotometricGrid b = grid_of(isotropic(5));
  b.poles = PhotometricGrid::Poles::b;
  b.azimuth_deg = {-90, 90};
  EXPECT_EQ(Photometry(b).downward_share(), 1);
  EXPECT_NEAR(Photometry(b).flux_lm(), 10 * kPiD, 1e-4);
}

TEST(Photometry, TypesBAndALieAsTheStandardsSay) {
  PhotometricGrid grid;  // brightest at the last node of both angles
  grid.azimuth_deg = {-90, 0, 90}, grid.polar_deg = {0, 90, 180};
  const auto lit = [&](PhotometricGrid::Poles poles, std::size_t azimuth, std::size_t polar) {
    grid.poles = poles;
    grid.candela.assign(9, 0);
    grid.candela[3 * azimuth + polar] = 1;
    return Photometry(grid).peak_direction();
  };
  const auto near = [](const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-5f; };
  using Poles = PhotometricGrid::Poles;
  // The aim of all types is straight down; of B, vertical angle 90 is C0, and positive horizontal angles turn
  // clockwise seen from above, towards -y. A is the same about the other axis.
  EXPECT_TRUE(near(lit(Poles::b, 1, 1), {0, 0, -1}));
  EXPECT_TRUE(near(lit(Poles::b, 2, 1), {1, 0, 0}));
  EXPECT_TRUE(near(lit(Poles::b, 0, 2), {0, -1, 0}));
  EXPECT_TRUE(near(lit(Poles::a, 1, 1), {0, 0, -1}));
  EXPECT_TRUE(near(lit(Poles::a, 2, 1), {0, -1, 0}));
  EXPECT_TRUE(near(lit(Poles::a, 0, 2), {1, 0, 0}));
}

TEST(Photometry, SamplesFallWhereLightIs) {
  // One lit node: nothing beyond its four cells, and the mean direction is the node's.
  PhotometricGrid grid =
      grid_of({[](double c, double g) { return c == 90 && g == 45 ? 10.0 : 0.0; }, 15, 5, 90});
  const Photometry photometry(grid);
  DVec3 mean(0);
  for (int i = 0; i < 4096; ++i) {
    const Vec3 d = photometry.sample(r2_point(i, {0.3f, 0.7f}));
    EXPECT_NEAR(glm::length(d), 1, 1e-6);
    EXPECT_GT(photometry.candela(d), -0.f);
    EXPECT_GT(glm::dot(d, c_gamma_direction(90, 45)), std::cos(16 * kPiD / 180));
    mean += DVec3(d) / 4096.0;
  }
  EXPECT_GT(glm::dot(glm::normalize(mean), DVec3(c_gamma_direction(90, 45))), std::cos(0.5 * kPiD / 180));
  EXPECT_FALSE(photometry.shines_towards({0, 0, 1}));
  EXPECT_TRUE(photometry.shines_towards({0, 1, 0}));
  EXPECT_FALSE(photometry.shines_towards({0, -1, 0}));
}

TEST(BeamAngles, OfAGaussianBeam) {
  // exp(-ln 2 (g / 12)^2): half at 12 degrees, a tenth at 12 sqrt(log2 10).
  const Photometry spot(
      grid_of({[](double, double g) { return 1000 * std::exp2(-g * g / 144); }, 360, 0.25, 90}));
  const BeamAngles beam = beam_angles(spot, 0);
  EXPECT_NEAR(beam.half_deg, 24, 0.02);
  EXPECT_NEAR(beam.tenth_deg, 24 * std::sqrt(std::log2(10)), 0.02);
  // The same upwards.
  const Photometry up(grid_of(
      {[](double, double g) { return 1000 * std::exp2(-(180 - g) * (180 - g) / 144); }, 360, 0.25, 180}));
  EXPECT_NEAR(beam_angles(up, 90).half_deg, 24, 0.05);
  // A wall washer: from 20 to 50 degrees on one side.
  const Photometry washer(
      grid_of({[](double c, double g) { return c < 90 && g >= 20 && g <= 50 ? 10.0 : 0.0; }, 90, 1, 90}));
  EXPECT_NEAR(beam_angles(washer, 0).half_deg, 31, 0.1);
}

TEST(LuminousOpening, ReadsTheSignsOfEveryEdition) {
  using Form = LuminousOpening::Form;
  struct Case {
    DVec3 width_length_height;
    bool from_2002;
    Form form;
    Vec3 size;
  };
  const float w = 1, l = 2, h = 3;
  for (const Case& c :
       {Case{{0, 0, 0}, true, Form::point, {0, 0, 0}},    {{w, l, 0}, false, Form::box, {l, w, 0}},
        {{w, l, h}, true, Form::box, {l, w, h}},          {{-w, 0, 0}, false, Form::cylinder_z, {w, w, 0}},
        {{-w, -w, 0}, true, Form::cylinder_z, {w, w, 0}}, {{-w, -l, 0}, true, Form::cylinder_z, {l, w, 0}},
        {{-w, 0, h}, false, Form::cylinder_z, {w, w, h}}, {{-w, -l, h}, true, Form::cylinder_z, {l, w, h}},
        {{-w, l, h}, false, Form::cylinder_z, {l, w, h}}, {{w, -l, 0}, false, Form::cylinder_z, {l, w, 0}},
        {{-w, 0, -w}, false, Form::ellipsoid, {w, w, w}}, {{-w, 0, -h}, true, Form::cylinder_x, {0, w, h}},
        {{-w, -w, -w}, true, Form::ellipsoid, {w, w, w}}, {{-w, l, -h}, false, Form::ellipsoid, {l, w, h}},
        {{-w, l, -h}, true, Form::cylinder_x, {l, w, h}}, {{w, -l, -h}, false, Form::ellipsoid, {l, w, h}},
        {{w, -l, -h}, true, Form::cylinder_y, {l, w, h}}, {{0, l, -h}, false, Form::cylinder_x, {l, h, h}},
        {{w, 0, -h}, false, Form::cylinder_y, {h, w, h}}, {{0, l, 0}, true, Form::point, {0, 0, 0}},
        {{0, 0, -h}, true, Form::point, {0, 0, 0}}}) {
    const LuminousOpening opening = lm63_opening(c.width_length_height, c.from_2002);
    EXPECT_EQ(opening.form, c.form) << c.width_length_height.x << " " << c.width_length_height.y << " "
                                    << c.width_length_height.z;
    EXPECT_EQ(opening.size_m, c.size) << opening.describe();
  }
  EXPECT_EQ(eulumdat_opening(1.2, 0.3, 0).size_m, Vec3(0.3f, 1.2f, 0));
  EXPECT_EQ(eulumdat_opening(0.2, 0, 0.1).form, Form::cylinder_z);
  EXPECT_EQ(eulumdat_opening(0, 0, 0).form, Form::point);
}

TEST(LuminousOpening, SurfacesAreClosedAndOfTheRightArea) {
  using Form = LuminousOpening::Form;
  const Photometry all_around(grid_of(isotropic(1))), down(grid_of(lambertian(1)));
  struct Case {
    LuminousOpening opening;
    double area;
  };
  const double a = 0.5, b = 0.2, c = 0.1;
  for (const Case& k : {Case{{Form::box, Vec3(a, b, c)}, 2 * (a * b + b * c + c * a)},
                        {{Form::ellipsoid, Vec3(b, b, b)}, kPiD * b * b},
                        {{Form::cylinder_x, Vec3(a, b, b)}, 0},
                        {{Form::cylinder_z, Vec3(a, b, c)}, 0}}) {
    bool both = true;
    const MeshData mesh = opening_mesh(k.opening, all_around, both);
    EXPECT_FALSE(both);
    double area = 0, volume = 0;
    DVec3 sum(0);
    for (const Triangle& t : mesh.triangle) {
      const DVec3 p(mesh.position[t.v[0]]), q(mesh.position[t.v[1]]), r(mesh.position[t.v[2]]);
      const DVec3 n = 0.5 * glm::cross(q - p, r - p);
      area += glm::length(n), sum += n, volume += glm::dot(p, n) / 3;
      EXPECT_GE(glm::dot(p, n), -1e-12) << "convex about the centre";
      EXPECT_GT(glm::dot(DVec3(mesh.normal[t.v[0]]), n), 0);
    }
    EXPECT_LT(glm::length(sum), 1e-6) << "closed";
    if (k.area > 0) {
      EXPECT_NEAR(area, k.area, 1e-6);
    }
    if (k.opening.form == Form::cylinder_z) {
      EXPECT_NEAR(volume, kPiD / 4 * a * b * c, 1e-6);
    }
    if (k.opening.form == Form::cylinder_x) {
      EXPECT_NEAR(volume, kPiD / 4 * a * b * b, 1e-6);
    }
  }
  bool both = false;
  EXPECT_EQ(opening_mesh({Form::cylinder_z, Vec3(b, b, 0)}, down, both).normal[0], Vec3(0, 0, -1));
  EXPECT_FALSE(both);
  EXPECT_LT(opening_mesh({Form::cylinder_z, Vec3(b, b, 0)}, down, both).position[0].z, 0)
      << "before the ceiling";
  opening_mesh({Form::box, Vec3(a, b, 0)}, all_around, both);
  EXPECT_TRUE(both);
}

TEST(Fitting, LuminanceTimesAreaSeenIsTheIntensity) {
  using Form = LuminousOpening::Form;
  for (const LuminousOpening& opening : {LuminousOpening{Form::box, {0.6f, 0.3f, 0.1f}},
                                         {Form::ellipsoid, {0.2f, 0.3f, 0.1f}},
                                         {Form::cylinder_y, {0.1f, 0.5f, 0.1f}},
                                         {Form::cylinder_z, {0.3f, 0.3f, 0}}}) {
    const auto file = luminaire(
        {[](double c, double g) { return 10 + 0.1 * c * (360 - c) / 360 + g; }, 30, 10, 180}, opening);
    const Scene scene = measured_room(file);
    ASSERT_EQ(scene.light.size(), 1u);
    EXPECT_EQ(scene.light[0].kind, Light::Kind::area);
    EXPECT_NEAR(scene.light[0].flux_lm.y, file->photometry->flux_lm(), 1e-3);
    const Fitting& fitting = scene.fitting[0];
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 d = sample_uniform_sphere(r2_point(i, {0.1f, 0.2f}));
      const float area = fitting.projected_area_m2(d);
      ASSERT_GT(area, 0);
      EXPECT_NEAR(fitting.luminance(d).y * area, fitting.intensity_cd(d).y,
                  1e-4 * double(fitting.intensity_cd(d).y));
      sum += double(area) / 1000;
    }
    // Of a convex body, a quarter of its surface (Cauchy); a sheet is seen from both sides.
    const double quarter = scene.light[0].area_m2 / (opening.size_m.z > 0 ? 4.0 : 2.0);
    EXPECT_NEAR(sum, quarter, 0.01 * quarter) << opening.describe();
  }
}

}  // namespace
}  // namespace phos::test
