// The closed forms that the analytic tests compare with, against a table made by quadrature
// (data/golden/irradiance).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/scenes.h"

namespace {

using namespace phos;

/// Value of one row; inputs in the order of the table.
double closed_form(const std::string& name, const std::vector<double>& in) {
  const double pi = std::numbers::pi;
  if (name == "point_over_plane") return test::point_over_plane_lx(in[0], in[1], in[2]);
  if (name == "rectangle_parallel")
    return pi * in[0] * test::corner_form_factor_parallel(in[1], in[2], in[3]);
  if (name == "rectangle_perpendicular")
    return pi * in[0] * test::corner_form_factor_perpendicular(in[1], in[2], in[3]);
  if (name == "furnace") return test::furnace_lx(in[0], in[1]);
  if (name == "furnace_bounces") return test::furnace_lx(in[0], in[1], static_cast<int>(in[2]));
  if (name == "sphere") return test::closed_room_mean_lx(in[1], 4 * pi * in[2] * in[2], in[0]);
  if (name == "cube") return test::closed_room_mean_lx(in[0], 6 * in[1] * in[1], in[2]);
  ADD_FAILURE() << "unknown case " << name;
  return 0;
}

TEST(ReferenceClosedForms, AgreeWithTheTable) {
  std::ifstream file(PHOS_SOURCE "/data/golden/irradiance/closed_forms.csv");
  ASSERT_TRUE(file) << "data/golden/irradiance/closed_forms.csv";
  std::string line;
  int rows = 0;
  while (std::getline(file, line)) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream fields(line);
    std::string name, field;
    std::getline(fields, name, ',');
    std::vector<double> numbers;
    while (std::getline(fields, field, ',')) numbers.push_back(std::stod(field));
    const double expected = numbers.back();
    numbers.pop_back();
    EXPECT_NEAR(closed_form(name, numbers) / expected, 1, 1e-12) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 32);
}

/// The scenes ask those forms for the right corners: signed corner terms against the whole, seen from beneath
/// its centre.
TEST(ReferenceClosedForms, ScenesUseThem) {
  const test::AnalyticScene over = test::rectangle_light_parallel(2, 3, 1.5f, 1000);
  EXPECT_NEAR(over.checks[0].irradiance_lx, 590.882481095204, 1e-9);
  EXPECT_NEAR(over.checks[1].irradiance_lx,
              4 * std::numbers::pi * 1000 * test::corner_form_factor_parallel(1, 1.5, 1.5), 1e-9);
  const test::AnalyticScene beside = test::rectangle_light_perpendicular(2, 3, 1000);
  EXPECT_NEAR(beside.checks[0].irradiance_lx, 343.4179785728428, 1e-9);
  EXPECT_NEAR(beside.checks[1].irradiance_lx,
              2 * std::numbers::pi * 1000 * test::corner_form_factor_perpendicular(1, 3, 1.5), 1e-9);
  EXPECT_NEAR(test::furnace(0.9f).mean_irradiance_lx, 10, 1e-5);
}

/// Walls face inwards, areas and lamps are what the formulas take them for.
TEST(ReferenceClosedForms, ScenesAreWhatTheySay) {
  for (const int triangles : {20, 320, 1280}) {
    const test::AnalyticScene s = test::integrating_sphere(0.5f, triangles);
    ASSERT_EQ(s.scene.triangle.size(), static_cast<std::size_t>(triangles));
    double area = 0;
    for (std::uint32_t t = 0; t < s.scene.triangle.size(); ++t) {
      area += area_m2(s.scene, t);
      EXPECT_LT(glm::dot(geometric_normal(s.scene, t), s.scene.position[s.scene.triangle[t].v[0]]), 0);
    }
    EXPECT_NEAR(area, s.area_m2, 1e-5 * area);
    EXPECT_LT(area, 4 * std::numbers::pi);
  }
  for (const test::AnalyticScene& s : {test::furnace(0.5f), test::uniform_box(0.5f)}) {
    for (std::uint32_t t = 0; t < s.scene.triangle.size(); ++t) {
      const Vec3 inwards = s.scene.bounds.centre() - s.scene.position[s.scene.triangle[t].v[0]];
      EXPECT_GT(glm::dot(geometric_normal(s.scene, t), inwards), 0) << s.name;
    }
    EXPECT_EQ(s.scene.light.size(), 1u);
    EXPECT_NEAR(s.scene.bounds.size().x, 2, 1e-6);
  }
  for (const test::AnalyticScene& s : test::all_point_scenes()) {
    EXPECT_FALSE(s.checks.empty()) << s.name;
    EXPECT_EQ(s.scene.camera.size(), 1u) << s.name;
    const test::AnalyticScene twice = scaled(s, 2);
    EXPECT_EQ(twice.scene.light.size(), s.scene.light.size()) << s.name;
    EXPECT_NEAR(twice.scene.bounds.diagonal_m(), 2 * s.scene.bounds.diagonal_m(), 1e-4) << s.name;
  }
}

}  // namespace
