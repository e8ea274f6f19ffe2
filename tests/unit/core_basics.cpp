#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "core/counters.h"
#include "core/error.h"
#include "core/json.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/sampling.h"
#include "core/vector.h"

namespace phos {
namespace {

TEST(Random, FirstBlockIsPhiloxOfTheCounter) {
  // Known answer of Philox4x32-10 for counter 0, key 0 (Random123 kat_vectors), reached by stage 0.
  RandomStream r(0, static_cast<Stage>(0), 0);
  EXPECT_EQ(r.bits(), 0x6627e8d5u);
  EXPECT_EQ(r.bits(), 0xe169c58du);
  EXPECT_EQ(r.bits(), 0xbc57ac4cu);
  EXPECT_EQ(r.bits(), 0x9b00dbd8u);
}

TEST(Random, BouncesDoNotShiftEachOther) {
  RandomStream a(7, Stage::test, 3), b(7, Stage::test, 3);
  a.start_bounce(1), b.start_bounce(1);
  for (int i = 0; i < 100; ++i) a.bits();
  a.start_bounce(2), b.start_bounce(2);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.bits(), b.bits());
}

TEST(Random, StreamsDiffer) {
  std::set<std::uint32_t> first;
  for (std::uint64_t seed : {0ull, 1ull, 1ull << 40})
    for (std::uint64_t item : {0ull, 1ull, 1ull << 40})
      for (const Stage stage : {Stage::emission, Stage::test})
        first.insert(RandomStream(seed, stage, item).bits());
  EXPECT_EQ(first.size(), 18u);
}

TEST(Random, UniformIsInRangeWithTheRightMoments) {
  RandomStream r(1, Stage::test, 0);
  double sum = 0, squares = 0;
  constexpr int n = 100000;
  for (int i = 0; i < n; ++i) {
    r.start_bounce(static_cast<std::uint32_t>(i % 60000));
    const float u = i % 2 == 0 ? r.uniform() : static_cast<float>(r.uniform_double());
    ASSERT_GE(u, 0.f);
    ASSERT_LE(u, 1.f);
    sum += u, squares += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 4 / std::sqrt(12. * n));
  EXPECT_NEAR(squares / n, 1 / 3., 4 * std::sqrt(4 / 45. / n));
}

TEST(Vector, OctahedralErrorIsSmallEverywhere) {
  RandomStream r(2, Stage::test, 0);
  float worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = sample_uniform_sphere(r.uniform2());
    worst = std::max(worst, glm::length(decode_octahedral(encode_octahedral(n)) - n));
  }
  EXPECT_LT(worst, 1e-4f);
  for (int axis = 0; axis < 3; ++axis)
    for (const float sign : {-1.f, 1.f}) {
      Vec3 n(0);
      n[axis] = sign;
      EXPECT_NEAR(glm::dot(decode_octahedral(encode_octahedral(n)), n), 1, 1e-6);
    }
  EXPECT_EQ(decode_octahedral(encode_octahedral(Vec3(0))).z, 1.f);
}

TEST(Vector, FrameIsOrthonormalAndRightHanded) {
  RandomStream r(3, Stage::test, 0);
  for (int i = 0; i < 2000; ++i) {
    Vec3 n = sample_uniform_sphere(r.uniform2());
    if (i == 0) n = {0, 0, -1};
    const Frame f = make_frame(n);
    EXPECT_NEAR(glm::dot(f.x, f.y), 0, 1e-5);
    EXPECT_NEAR(glm::length(f.x), 1, 1e-5);
    EXPECT_NEAR(glm::length(glm::cross(f.x, f.y) - n), 0, 1e-5);
    EXPECT_NEAR(glm::length(f.to_world(f.to_local(Vec3(1, 2, 3))) - Vec3(1, 2, 3)), 0, 1e-4);
  }
}

TEST(Vector, NormalizedSurvivesExtremes) {
  for (const float s : {1e-30f, 1e-6f, 1.f, 1e30f})
    EXPECT_NEAR(glm::length(normalized_or_zero(Vec3(s, -s, 2 * s))), 1, 1e-6);
  EXPECT_EQ(normalized_or_zero(Vec3(0)), Vec3(0));
  for (const float none : {std::nanf(""), kInfinity, -kInfinity})
    for (int c = 0; c < 3; ++c) {
      Vec3 v(0, 1, 2);
      v[c] = none;
      EXPECT_EQ(normalized_or_zero(v), Vec3(0)) << none << " in " << c;
    }
}

TEST(Sampling, MeansMatchTheirDensities) {
  RandomStream r(4, Stage::test, 0);
  Vec3 cosine(0), cone(0), power(0);
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    r.start_bounce(static_cast<std::uint32_t>(i));
    cosine += sample_cosine_hemisphere(r.uniform2());
    cone += sample_uniform_cone(r.uniform2(), 0.5f);
    power += sample_power_cosine(r.uniform2(), 20);
  }
  EXPECT_NEAR(cosine.z / n, 2. / 3, 4 * 0.24 / std::sqrt(n));
  EXPECT_NEAR(cone.z / n, 0.75, 4 * 0.145 / std::sqrt(n));
  EXPECT_NEAR(power.z / n, 21. / 22, 4 * 0.05 / std::sqrt(n));
  EXPECT_NEAR(cosine.x / n, 0, 4 * 0.5 / std::sqrt(n));
}

TEST(Sampling, R2PointsKeepApartFromAnyStart) {
  // Roberts 2018: on the torus n points keep about 0.55 / sqrt(n) apart (random ones: 0.5 / n).
  for (const Vec2& shift : {Vec2(0), Vec2(0.5f), Vec2(0x1.fffffep-1f)}) {
    std::vector<Vec2> p;
    for (int i = 0; i < 500; ++i) {
      p.push_back(r2_point(i, shift));
      ASSERT_TRUE(p.back().x >= 0 && p.back().x < 1 && p.back().y >= 0 && p.back().y < 1) << i;
    }
    EXPECT_EQ(p[0], shift);
    float nearest = 1;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec2 way = glm::abs(p[i] - p[j]);
        nearest = std::min(nearest, glm::length(glm::min(way, 1.f - way)));
      }
    EXPECT_GT(nearest, 0.5f / std::sqrt(500.f));
  }
}

TEST(Sampling, SobolPointsHaveOneInEachElementaryInterval) {
  for (const std::uint32_t shift : {0u, 0x80000000u, 0xdeadbeefu}) {
    for (int log_n = 0; log_n <= 8; ++log_n) {
      const int n = 1 << log_n;
      for (const int first : {0, n, 5 * n}) {
        for (int wide = 0; wide <= log_n; ++wide) {
          const int columns = 1 << wide, rows = n / columns;
          std::vector<int> found(static_cast<std::size_t>(n));
          for (int i = first; i < first + n; ++i) {
            const Vec2 p = sobol_point(i, shift, ~shift);
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1) << i;
            ++found[static_cast<std::size_t>(static_cast<int>(p.y * static_cast<float>(rows)) * columns +
                                             static_cast<int>(p.x * static_cast<float>(columns)))];
          }
          for (const int count : found) ASSERT_EQ(count, 1) << n << " from " << first << ", " << columns;
        }
      }
    }
  }
}

/// The largest gap between n of them, around the unit circle: at most (golden ratio + 1) / n.
TEST(Sampling, GoldenPointsLeaveNoGap) {
  for (const std::uint32_t shift : {0u, 0xdeadbeefu}) {
    std::vector<float> sorted;
    for (int n = 1; n <= 300; ++n) {
      sorted.push_back(golden_point(n - 1, shift));
      ASSERT_TRUE(sorted.back() >= 0 && sorted.back() < 1) << n;
      std::sort(sorted.begin(), sorted.end());
      float gap = 1 + sorted.front() - sorted.back();
      for (std::size_t i = 1; i < sorted.size(); ++i) gap = std::max(gap, sorted[i] - sorted[i - 1]);
      EXPECT_LT(gap, 2.62f / static_cast<float>(n)) << n;
    }
  }
}

TEST(Parallel, ReduceJoinsInOrderForAnyThreads) {
  std::vector<double> results;
  for (const int threads : {1, 2, 5}) {
    set_threads(threads);
    results.push_back(parallel_reduce(
        100001, 64, 0.,
        [](std::size_t a, std::size_t b) {
          double s = 0;
          for (std::size_t i = a; i < b; ++i) s += 1 / (1. + static_cast<double>(i));
          return s;
        },
        [](double& total, double part) { total += part; }));
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
  set_threads(0);
}

TEST(Parallel, PassesExceptionsOn) {
  EXPECT_THROW(parallel_for(1000, 10,
                            [](std::size_t i) {
                              if (i == 500) throw Error(ExitCode::bad_input, "x", "y");
                            }),
               Error);
  parallel_for(0, 10, [](std::size_t) { FAIL(); });
}

TEST(Parallel, FlushesDenormalsInEveryThread) {
  set_threads(2);
  std::vector<float> out(4096, 1);
  volatile float tiny = 1e-30f;
  parallel_for(out.size(), 1, [&](std::size_t i) { out[i] = tiny * 1e-10f; });
  for (const float v : out) ASSERT_EQ(v, 0.f);
}

TEST(Counters, CountAndMerge) {
  Counters a, b;
  a.add("degenerate hull", 2), b.add("degenerate hull"), b.add("other");
  a.merge(b);
  EXPECT_EQ(a["degenerate hull"], 3u);
  EXPECT_EQ(a["never"], 0u);
}

TEST(Json, PrintsShortestAndSorted) {
  Json j;
  j["b"] = 0.1f, j["a"] = Json::Array{1, "x\n\"", true, Json()};
  j["c"] = 1e30;
  EXPECT_EQ(j.dump(), R"({"a":[1,"x\n\"",true,null],"b":0.1,"c":1e+30})");
  EXPECT_EQ(Json(std::nan("")).dump(), "null");
  EXPECT_THROW(j.as_array(), std::runtime_error);
}

TEST(CheckDeath, PrintsValues) {
  const int n = -1;
  EXPECT_DEATH(PHOS_CHECK(n > 0, "n = ", n), "n = -1");
}

}  // namespace
}  // namespace phos
