// Records of films: of no surface, and on a triangle that moves and turns.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "support/films.h"

namespace phos::test {

inline constexpr TemporalGradients kAllGradients[] = {
    TemporalGradients::none, TemporalGradients::extrapolated, TemporalGradients::interpolated};

/// Lit by the same light, in no scene.
inline FilmRecord still(std::int32_t birth, std::int32_t end, std::uint32_t chain = 0) {
  FilmRecord r;
  r.record.irradiance = Rgb(10, 20, 30);
  r.record.radius_m = r.record.distance_m = 1;
  r.life.birth = birth, r.life.end = end, r.life.chain = chain;
  return r;
}

inline Film film_of(TemporalGradients gradients, std::vector<FilmRecord> records) {
  return {film_info(gradients), Quantity::indirect, std::move(records)};
}

/// The triangle's turn and move.
inline const glm::quat kTurn = glm::angleAxis(0.7f, glm::normalize(Vec3(1, -2, 3)));
inline const Vec3 kMove(5, -1, 2);

/// Born on the triangle where it lies flat.
inline Life on_triangle(std::int32_t birth, std::int32_t end, const Scene& at_birth) {
  Life life;
  life.birth = birth, life.end = end;
  life.anchor = {0, 0.25f, 0.5f};
  life.turn = pose_of(at_birth, life.anchor)->turn;
  return life;
}

inline void expect_near(const Vec3& a, const Vec3& b, float within = 1e-6f) {
  EXPECT_LT(glm::length(a - b), within * std::max(1.f, glm::length(b)))
      << a.x << " " << a.y << " " << a.z << ", not " << b.x << " " << b.y << " " << b.z;
}

}  // namespace phos::test
