#include "hsh/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.h"
#include "core/random.h"
#include "hsh/projection.h"
#include "hsh/turn/hsh_turn.h"
#include "hsh/turn/kernel.h"
#include "support/golden_table.h"

namespace phos {
namespace {

using Coefficients = std::vector<float>;
constexpr HshRotation kMethods[] = {HshRotation::via_sh, HshRotation::digon, HshRotation::zero_fill,
                                    HshRotation::constant_fill, HshRotation::even_fill};

const std::string kGolden = std::string(PHOS_SOURCE) + "/data/golden/hsh/";
const std::map<std::string, HshRotation> kGoldenMethod = {
    {"zero_fill", HshRotation::zero_fill},
    {"const_horizon_fill", HshRotation::constant_fill},
    {"even_mirror_fill", HshRotation::even_fill},
};

float number(const std::map<std::string, std::string>& row, const std::string& column) {
  return static_cast<float>(std::stod(row.at(column)));
}

Coefficients random_coefficients(int order, std::uint64_t item, int channels = 1) {
  RandomStream random(1, Stage::test, item);
  Coefficients c;
  for (int l = 0; l < order; ++l)
    for (int i = 0; i < (2 * l + 1) * channels; ++i)
      c.push_back((2 * random.uniform() - 1) / static_cast<float>(1 + l));
  return c;
}

std::vector<double> in_double(std::span<const float> c) { return {c.begin(), c.end()}; }

/// A frame turned at random.
Frame random_frame(std::uint64_t item) {
  RandomStream random(2, Stage::test, item);
  const float z = 2 * random.uniform() - 1, phi = 2 * kPi * random.uniform(),
              turn = 2 * kPi * random.uniform();
  const float rho = std::sqrt(1 - z * z);
  Frame f = make_frame({rho * std::cos(phi), rho * std::sin(phi), z});
  const Vec3 x = f.x * std::cos(turn) + f.y * std::sin(turn);
  return {x, glm::cross(f.z, x), f.z};
}

DVec3 about_z(const DVec3& v, double a) {
  return {v.x * std::cos(a) - v.y * std::sin(a), v.x * std::sin(a) + v.y * std::cos(a), v.z};
}
DVec3 about_y(const DVec3& v, double b) {
  return {v.x * std::cos(b) + v.z * std::sin(b), v.y, -v.x * std::sin(b) + v.z * std::cos(b)};
}
DVec3 turned(const ZyzAngles& a, const DVec3& v) {
  return about_z(about_y(about_z(v, a.alpha), a.beta), a.gamma);
}
DVec3 turned_back(const ZyzAngles& a, const DVec3& v) {
  return about_z(about_y(about_z(v, -a.gamma), -a.beta), -a.alpha);
}

TEST(RotationAngles, RebuildTheRotation) {
  std::vector<std::pair<Frame, Frame>> pairs;
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Frame from = random_frame(i);
    pairs.emplace_back(from, random_frame(1000 + i));
    pairs.emplace_back(from, from);
    pairs.emplace_back(from, Frame{-from.x, from.y, -from.z});       // upside down
    pairs.emplace_back(from, Frame{from.y, -from.x, from.z});        // about z alone
    for (const float small : {1e-7f, 3e-7f, 1e-6f, 1e-5f, 1e-3f}) {  // next to 0
      const Vec3 z = glm::normalize(from.z + small * from.x);
      const Vec3 y = glm::normalize(glm::cross(z, from.x));
      pairs.emplace_back(from, Frame{glm::cross(y, z), y, z});
    }
  }
  for (const auto& [from, to] : pairs) {
    const ZyzAngles a = rotation_angles(from, to);
    EXPECT_GE(a.beta, 0);
    EXPECT_LE(a.beta, kPi);
    for (const Vec3& local : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
      const Vec3 expected = to.to_local(from.to_world(local));
      EXPECT_LT(glm::length(turned(a, local) - DVec3(expected)), 3e-6) << a.beta;
    }
  }
}

TEST(RotationAngles, AreOneTurnAboutZNextToThePoles) {
  const Frame f;
  const float c = std::cos(0.7f), s = std::sin(0.7f);
  const ZyzAngles same = rotation_angles(Frame{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}, f);
  EXPECT_EQ(same.gamma, 0);
  EXPECT_EQ(same.beta, 0);
  EXPECT_NEAR(same.alpha, 0.7f, 1e-6f);
  const ZyzAngles under = rotation_angles(f, Frame{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}});
  EXPECT_EQ(under.gamma, 0);
  EXPECT_EQ(under.beta, kPi);
}

TEST(RotateAboutZ, TurnsTheFunction) {
  for (const BasisKind kind : {BasisKind::sh, BasisKind::hsh}) {
    for (const float angle : {-7.f, -0.3f, 0.f, 1.f, 3.2f}) {
      const Coefficients c = random_coefficients(7, 3);
      Coefficients r = c;
      rotate_about_z(r, angle);
      for (std::uint64_t i = 0; i < 20; ++i) {
        Vec3 v = random_frame(i).z;
        v.z = kind == BasisKind::hsh ? std::fabs(v.z) : v.z;
        const DVec3 back = about_z(v, -angle);
        EXPECT_NEAR(reconstruct(in_double(r), kind, v.x, v.y, v.z),
                    reconstruct(in_double(c), kind, back.x, back.y, back.z), 1e-5);
      }
    }
  }
}

TEST(ShRotation, IsThatOfTheGoldenTable) {
  const auto rows = test::read_table(kGolden + "sh_rotation_order6.csv");
  ASSERT_GT(rows.size(), 150u);
  Coefficients unit(36), column(36);
  for (const auto& row : rows) {
    const ZyzAngles angles{number(row, "alpha"), number(row, "beta"), number(row, "gamma")};
    std::fill(unit.begin(), unit.end(), 0.f);
    unit[std::stoul(row.at("col"))] = 1;
    ShRotation(6, angles).rotate(unit, column);
    EXPECT_NEAR(column[std::stoul(row.at("row"))], std::stod(row.at("value")), 1e-6)
        << row.at("row") << " " << row.at("col");
  }
}

/// (R f)(w) = f(R^-1 w), energy of each band kept, to order 100.
TEST(ShRotation, IsExact) {
  for (const int order : {1, 2, 6, 20, 100}) {
    const Coefficients c = random_coefficients(order, 5);
    Coefficients r(c.size());
    for (const ZyzAngles& a : {ZyzAngles{0.3f, 0.02f, 1}, {1, 0.9f, -2}, {0, 2.9f, 0}, {2, kPi, 1}}) {
      ShRotation(order, a).rotate(c, r);
      const double scale = std::sqrt(static_cast<double>(order));
      for (std::uint64_t i = 0; i < 10; ++i) {
        const DVec3 v = random_frame(i).z, back = turned_back(a, v);
        EXPECT_NEAR(reconstruct(in_double(r), BasisKind::sh, v.x, v.y, v.z),
                    reconstruct(in_double(c), BasisKind::sh, back.x, back.y, back.z), 1e-5 * scale)
            << order << " " << a.beta;
      }
      const std::vector<double> before = energy_by_band(in_double(c)), after = energy_by_band(in_double(r));
      for (std::size_t l = 0; l < before.size(); ++l) EXPECT_NEAR(after[l] / before[l], 1, 1e-5) << l;
    }
  }
}

TEST(HshTurn, IsThatOfTheGoldenTable) {
  const auto rows = test::read_table(kGolden + "rotation_matrix_order5.csv");
  ASSERT_GT(rows.size(), 900u);
  std::map<HshRotation, Turn> made;
  for (const auto& row : rows) {
    const HshRotation method = kGoldenMethod.at(row.at("kind"));
    const double beta = std::stod(row.at("beta_deg")) * std::numbers::pi / 180;
    if (!made.contains(method)) made.emplace(method, hsh_turn(5, method, beta));
    const Turn& turn = made.at(method);
    const auto place = [](int index) {
      const int l = static_cast<int>(std::sqrt(index)), m = index - l * l - l;
      return std::pair{m >= 0, m >= 0 ? Turn::cosine_index(l, m) : Turn::sine_index(l, -m)};
    };
    const auto [cosine, i] = place(std::stoi(row.at("row")));
    const auto [same, j] = place(std::stoi(row.at("col")));
    ASSERT_EQ(cosine, same);  // cosines and sines do not mix
    const double value = cosine ? turn.cosine[i * turn.cosines() + j] : turn.sine[i * turn.sines() + j];
    EXPECT_NEAR(value, std::stod(row.at("value")), 1e-12)
        << row.at("kind") << " " << row.at("row") << " " << row.at("col");
  }
}

/// Another order has another quadrature, and shares the first rows and columns.
TEST(HshTurn, IsConverged) {
  for (const HshRotation method : kMethods) {
    if (method == HshRotation::via_sh) continue;  // twice the order, another matrix
    for (const double degrees : {0.1, 1., 7., 45., 89., 120., 179.}) {
      const double beta = degrees * std::numbers::pi / 180;
      const Turn small = hsh_turn(8, method, beta), large = hsh_turn(12, method, beta);
      double worst = 0;
      for (std::size_t i = 0; i < small.cosines(); ++i)
        for (std::size_t j = 0; j < small.cosines(); ++j)
          worst = std::max(worst, std::fabs(small.cosine[i * small.cosines() + j] -
                                            large.cosine[i * large.cosines() + j]));
      for (std::size_t i = 0; i < small.sines(); ++i)
        for (std::size_t j = 0; j < small.sines(); ++j)
          worst = std::max(worst,
                           std::fabs(small.sine[i * small.sines() + j] - large.sine[i * large.sines() + j]));
      EXPECT_LT(worst, 1e-10) << static_cast<int>(method) << " at " << degrees;
    }
  }
}

TEST(HshRotator, GivesTheGoldenExamples) {
  const auto rows = test::read_table(kGolden + "rotation_examples_order5.csv");
  ASSERT_EQ(rows.size(), 48u);
  std::map<std::string, Coefficients> inputs;
  for (const auto& row : rows) {
    Coefficients c, out(25);
    for (int i = 0; i < 25; ++i) c.push_back(number(row, text("c", i)));
    if (row.at("method") == "input") {
      inputs[row.at("input")] = c;
      continue;
    }
    const ZyzAngles angles{number(row, "alpha"), number(row, "beta_deg") * kPi / 180, number(row, "gamma")};
    for (const float max_beta : {0.f, 1.f}) {  // exactly, and from tables
      HshRotator(5, kGoldenMethod.at(row.at("method")), max_beta)
          .rotate(angles, inputs.at(row.at("input")), out);
      for (std::size_t i = 0; i < 25; ++i)
        EXPECT_NEAR(out[i], c[i], 2e-6) << row.at("input") << " " << row.at("method") << " " << angles.beta;
    }
  }
}

TEST(HshRotator, KeepsAConstantWithTheConstantFill) {
  for (const HshRotation method : {HshRotation::constant_fill, HshRotation::even_fill}) {
    const HshRotator rotator(8, method);
    Coefficients one(64, 0.f), out(64);
    one[0] = 1;
    for (const float beta : {0.f, 0.003f, 0.01f, 0.1234f, 0.5f, 0.55f, 1.f, 2.f, kPi}) {
      rotator.rotate({0.4f, beta, 2}, one, out);
      for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(out[i], one[i], 1e-6) << beta << " " << i;
    }
  }
}

/// Uniform light loses (1 - cos beta) / 2 of its irradiance where nothing is below the old horizon.
TEST(HshRotator, DarkensAConstantWithTheZeroFill) {
  const HshRotator rotator(6, HshRotation::zero_fill, 0);
  Coefficients one(36, 0.f), out(36);
  one[0] = std::sqrt(2 * kPi);
  for (const float beta : {0.1f, 0.35f, 1.f, 2.f, 3.f}) {
    rotator.rotate({0, beta, 0}, one, out);
    const float irradiance = std::sqrt(kPi / 2) * out[0] + std::sqrt(kPi / 6) * out[2];
    EXPECT_NEAR(irradiance, kPi * (1 - (1 - std::cos(beta)) / 2), 1e-5) << beta;
  }
}

/// A narrow lobe that stays above the horizon is the same lobe elsewhere; every method but the digon's is
/// right then.
TEST(HshRotator, TurnsALobe) {
  const auto lobe = [](const DVec3& axis) {
    return [axis](double x, double y, double z) {
      return std::pow(std::max(0., glm::dot(axis, DVec3(x, y, z))), 30);
    };
  };
  constexpr int kOrder = 14;
  const Quadrature q = hemisphere_quadrature(40, 64);
  const DVec3 axis = glm::normalize(DVec3(0.1, 0.15, 1));
  const auto project_float = [&](const DirectionalFunction& f) {
    const std::vector<double> c = project(f, BasisKind::hsh, kOrder, q);
    return Coefficients(c.begin(), c.end());
  };
  const Coefficients from = project_float(lobe(axis));
  Coefficients out(from.size());
  for (const HshRotation method : kMethods) {
    if (method == HshRotation::digon) continue;
    for (const ZyzAngles& a : {ZyzAngles{0, 0.2f, 0}, {2, 0.3f, -1}}) {
      HshRotator(kOrder, method).rotate(a, from, out);
      const Coefficients expected = project_float(lobe(turned(a, axis)));
      double off = 0, size = 0;
      for (std::size_t i = 0; i < out.size(); ++i) {
        off += (out[i] - expected[i]) * (out[i] - expected[i]);
        size += expected[i] * expected[i];
      }
      EXPECT_LT(std::sqrt(off / size), 0.01) << static_cast<int>(method) << " " << a.beta;
    }
  }
}

/// Between whole degrees the matrices are interpolated: what that costs smooth radiance, the mean of many.
TEST(HshRotator, InterpolatesWell) {
  const HshRotator tabled(10), exact(10, HshRotation::constant_fill, 0);
  std::map<float, double> mean;
  for (const float degrees : {0.5f, 1.5f, 10.5f, 20.5f, 30.5f, 17.f}) {
    const ZyzAngles angles{0, degrees * kPi / 180, 0};
    for (std::uint64_t i = 0; i < 10; ++i) {
      Coefficients c = random_coefficients(10, 100 + i), a(100), b(100);
      for (std::size_t k = 0; k < 100; ++k)
        c[k] /= std::sqrt(1 + std::floor(std::sqrt(static_cast<float>(k))));
      c[0] = 2;
      tabled.rotate(angles, c, a);
      exact.rotate(angles, c, b);
      double off = 0, size = 0;
      for (std::size_t k = 0; k < 100; ++k) off += (a[k] - b[k]) * (a[k] - b[k]), size += b[k] * b[k];
      mean[degrees] += 0.1 * std::sqrt(off / size);
    }
  }
  EXPECT_NEAR(mean[0.5f], 1.5e-3, 1e-3);  // the matrix grows as beta + beta^(3/2) at 0
  for (const float degrees : {1.5f, 10.5f, 20.5f, 30.5f}) EXPECT_LT(mean[degrees], 1.5e-3) << degrees;
  EXPECT_LT(mean[17.f], 1e-6);
}

/// The product of a packed matrix, by every kernel, is that of the sums written out, to the bit.
TEST(TurnKernel, GivesTheSameBitsOnEveryMachine) {
  const PackedTurn a = pack(hsh_turn(9, HshRotation::constant_fill, 0.2)),
                   b = pack(hsh_turn(9, HshRotation::constant_fill, 0.3));
  constexpr std::size_t kStride = PackedTurn::kMaxRows, kPanel = PackedTurn::kPanel;
  const std::size_t n = static_cast<std::size_t>(a.cosines);
  std::vector<float> x(3 * kStride, 0.f);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::sin(static_cast<float>(i));
  std::vector<TurnKernel*> kernels{turn_plain, best_turn_kernel()};
#ifdef PHOS_HSH_AVX2
  EXPECT_TRUE(best_turn_kernel() == turn_avx2 || best_turn_kernel() == turn_plain);
#endif
  for (TurnKernel* const kernel : kernels) {
    for (const int vectors : {1, 3}) {
      std::vector<float> y(3 * kStride, -1.f);
      kernel(a.cosine.data(), b.cosine.data(), a.cosines, 0.3f, 0.7f, vectors, x.data(), y.data());
      for (std::size_t v = 0; v < static_cast<std::size_t>(vectors); ++v) {
        for (std::size_t row = 0; row < n; ++row) {
          float sum = 0;
          for (std::size_t column = 0; column < n; ++column) {
            const std::size_t at = row / kPanel * n + column, r = row % kPanel;
            sum += (0.3f * a.cosine[at].row[r] + 0.7f * b.cosine[at].row[r]) * x[v * kStride + column];
          }
          EXPECT_EQ(y[v * kStride + row], sum);
        }
      }
    }
  }
}

TEST(HshRotator, GivesEachChannelTheSameBits) {
  for (const int channels : {2, 3, 5}) {
    const HshRotator rotator(6);
    const Coefficients in = random_coefficients(6, 7, channels);
    Coefficients out(in.size()), one(36), alone(36);
    for (const float beta : {0.0001f, 0.2f, 1.f}) {
      rotator.rotate({0.3f, beta, 1}, in, out, channels);
      for (int c = 0; c < channels; ++c) {
        const auto at = [&](std::size_t i) {
          return i * static_cast<std::size_t>(channels) + static_cast<std::size_t>(c);
        };
        for (std::size_t i = 0; i < 36; ++i) one[i] = in[at(i)];
        rotator.rotate({0.3f, beta, 1}, one, alone);
        for (std::size_t i = 0; i < 36; ++i) EXPECT_EQ(alone[i], out[at(i)]);
      }
    }
  }
}

/// Turning what a function is multiplied by is the same as turning the function, by tables or without.
TEST(HshRotator, Transposed) {
  constexpr int kOrder = 6;
  std::vector<float> f, g;
  for (int i = 0; i < kOrder * kOrder; ++i)
    f.push_back(std::sin(static_cast<float>(i))), g.push_back(std::cos(3 * static_cast<float>(i)));
  for (const auto method : {HshRotation::constant_fill, HshRotation::zero_fill}) {
    const HshRotator rotator(kOrder, method);
    for (const float beta : {0.f, 0.001f, 0.013f, 0.3f, 0.7f, 1.7f}) {
      const ZyzAngles angles{0.4f, beta, -1.1f};
      std::vector<float> turned(f.size()), back(f.size());
      rotator.rotate(angles, f, turned);
      rotator.rotate_transposed(angles, g, back);
      double a = 0, b = 0;
      for (std::size_t i = 0; i < f.size(); ++i) {
        a += static_cast<double>(g[i]) * static_cast<double>(turned[i]);
        b += static_cast<double>(back[i]) * static_cast<double>(f[i]);
      }
      EXPECT_NEAR(a, b, 2e-5) << beta;
    }
  }
}

}  // namespace
}  // namespace phos
