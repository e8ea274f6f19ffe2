// The light of a film beside a record and between two frames, by the formula.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "scene/lamp/form.h"
#include "support/film_records.h"
#include "support/golden_table.h"

namespace phos::test {
namespace {

using D = glm::dvec3;

/// Irradiance by a square of radiance 50 at z = 2, its middle at x = -2 + 0.05 t.
double under_square(const D& p, const D& n, double t) {
  const double x = -2 + 0.05 * t;
  std::vector<D> corners{{x - 0.5, -0.5, 2}, {x + 0.5, -0.5, 2}, {x + 0.5, 0.5, 2}, {x - 0.5, 0.5, 2}};
  for (D& corner : corners) corner -= p;
  return 50 * std::fabs(projected_solid_angle(corners, n));
}

IrradianceRecord square_record(double t) {
  constexpr double h = 1e-3;
  const D up(0, 0, 1);
  const auto slope = [&](const D& e) {
    return (under_square(h * e, up, t) - under_square(-h * e, up, t)) / (2 * h);
  };
  const auto tilt = [&](const D& e) {
    const auto towards = [&](double s) {
      return under_square(D(0), s * std::sin(h) * e + std::cos(h) * up, t);
    };
    return (towards(1) - towards(-1)) / (2 * h);
  };
  IrradianceRecord r;
  r.radius_m = 10;
  r.irradiance = Rgb(static_cast<float>(under_square(D(0), up, t)));
  for (int c = 0; c < 3; ++c) {
    r.translation_gradient[c] = Vec3(D(slope({1, 0, 0}), slope({0, 1, 0}), 0));
    r.rotation_gradient[c] = Vec3(D(-tilt({0, 1, 0}), tilt({1, 0, 0}), 0));
  }
  return r;
}

TEST(Film, ExtrapolationInSpaceAndTimeIsThatOfTheTable) {
  FilmRecord a, b;
  a.life.birth = 10, a.life.end = 14, b.life.birth = 14, b.life.end = 18;
  a.record = square_record(10), b.record = square_record(14);
  a.change = change_between(a, b);
  const Film film = film_of(TemporalGradients::interpolated, {a, b});
  const IrradianceRecord now = cache_at(film, 12, {}).records.at(0);
  const Vec3 p(0.2f, 0.1f, 0), n(std::sin(0.1f), 0, std::cos(0.1f));
  std::map<std::string, double> table;
  for (auto& row : golden("F_eq511.csv")) table[row["form"]] = std::stod(row["E"]);
  ASSERT_EQ(table.size(), 6u);
  EXPECT_NEAR(under_square(D(p), D(n), 12), table["truth"], 1e-6);
  EXPECT_NEAR(extrapolate(now, p, n).x, table["corrected"], 1e-4);
}

}  // namespace
}  // namespace phos::test
