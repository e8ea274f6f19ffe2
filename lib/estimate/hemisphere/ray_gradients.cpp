#include "estimate/hemisphere/ray_gradients.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "estimate/hemisphere/hemisphere.h"

namespace phos::inline estimate {
namespace {

using DVec2 = glm::dvec2;

constexpr double kJump = 1.3;      // farther by more than this: perhaps another surface
constexpr double kTangent = 0.02;  // of the distance of two hits: on each other's tangent plane

/// Sums of light x direction on the tangent plane, one row per channel.
struct Sum {
  DVec2 rows[3]{DVec2(0), DVec2(0), DVec2(0)};
  void add(const DVec3& light, const DVec2& direction) {
    for (int c = 0; c < 3; ++c) rows[c] += light[c] * direction;
  }
  void to(Vec3 (&world)[3], const Frame& frame) const {
    for (int c = 0; c < 3; ++c) world[c] = frame.to_world(Vec3(Vec2(rows[c]), 0));
  }
};

DVec2 tangent_part(const Vec3& world, const Frame& frame) {
  return {static_cast<double>(glm::dot(world, frame.x)), static_cast<double>(glm::dot(world, frame.y))};
}

/// A stratified hemisphere as the cell formulas want it.
class Cells {
 public:
  Cells(const Hemisphere& h, float least_m) : h_(h), nearness_(h.size()) {
    const float least = std::max(least_m, std::numeric_limits<float>::min());
    for (std::size_t i = 0; i < h.size(); ++i)
      nearness_[i] = 1 / static_cast<double>(std::max(h.distance_m[i], least));
    for (int k = 0; k < h.slices; ++k) {
      const double edge = k * slice_angle(), centre = (k + 0.5) * slice_angle();
      outward_.emplace_back(std::cos(centre), std::sin(centre));
      across_edge_.emplace_back(-std::sin(edge), std::cos(edge));
    }
  }
  int rings() const { return h_.rings; }
  int slices() const { return h_.slices; }
  double slice_angle() const { return 2 * std::numbers::pi / h_.slices; }
  /// Sine and cosine of theta at the lower edge of a ring; `ring` may be rings(), or a half more: the middle.
  double sine(double ring) const { return std::sqrt(ring / h_.rings); }
  double cosine(double ring) const { return std::sqrt(1 - ring / h_.rings); }
  std::size_t at(int ring, int slice) const { return h_.at(ring, slice); }
  DVec3 light(std::size_t cell) const { return DVec3(h_.radiance[cell]); }
  double nearness(std::size_t cell) const { return nearness_[cell]; }  ///< 1/m
  const DVec2& outward(int slice) const { return outward_[static_cast<std::size_t>(slice)]; }
  const DVec2& across_edge(int slice) const { return across_edge_[static_cast<std::size_t>(slice)]; }

  /// Calls wall(before, cell, length, direction) for each pair of neighbours. As the receiver moves along
  /// `direction`, a surface at 1/r beyond the wall between them sweeps length x 1/r of projected solid angle
  /// per metre, out of `before` and into `cell`.
  template <typename Wall>
  void for_each_wall(const Wall& wall) const {
    for (int k = 0; k < slices(); ++k) {
      for (int j = 0; j < rings(); ++j) {
        const double c = cosine(j);
        if (j > 0) wall(at(j - 1, k), at(j, k), slice_angle() * sine(j) * c * c, outward(k));
        wall(at(j, k - 1), at(j, k), sine(j + 1) - sine(j), across_edge(k));
      }
    }
  }

 private:
  const Hemisphere& h_;
  std::vector<double> nearness_;
  std::vector<DVec2> outward_, across_edge_;
};

/// docs/methods.md#b1: ring means of the tangent, slice means of the direction.
Sum rotation(const Cells& cells) {
  const double half = cells.slice_angle() / 2, mean = std::sin(half) / half;
  const double cell_sr = std::numbers::pi / (cells.rings() * cells.slices());
  Sum sum;
  for (int j = 0; j < cells.rings(); ++j) {
    const double weight = cell_sr * mean * ring_tangent(j, cells.rings());
    for (int k = 0; k < cells.slices(); ++k) {
      const DVec2& u = cells.outward(k);
      sum.add(weight * cells.light(cells.at(j, k)), {-u.y, u.x});
    }
  }
  return sum;
}

Sum rotation_unstructured(const Hemisphere& h) {
  Sum sum;
  for (std::size_t i = 0; i < h.size(); ++i)
    sum.add(DVec3(h.radiance[i]) * static_cast<double>(h.projected_sr[i]),
            tangent_part(rotation_term(h.direction[i], h.frame.z), h.frame));
  return sum;
}

/// docs/methods.md#b4.
Sum analytic(const Hemisphere& h, float least_m) {
  const float least = std::max(least_m, std::numeric_limits<float>::min());
  Sum sum;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const Vec3 term = translation_term(h.direction[i], h.hit_normal[i], 1, h.frame.z);
    const double weight =
        static_cast<double>(h.projected_sr[i]) / static_cast<double>(std::max(h.distance_m[i], least));
    sum.add(weight * DVec3(h.radiance[i]), tangent_part(term, h.frame));
  }
  return sum;
}

/// docs/methods.md#b2.
Sum ward_heckbert(const Cells& cells) {
  Sum sum;
  cells.for_each_wall([&](std::size_t before, std::size_t cell, double length, const DVec2& direction) {
    const double speed = length * std::max(cells.nearness(before), cells.nearness(cell));
    sum.add(speed * (cells.light(cell) - cells.light(before)), direction);
  });
  return sum;
}

/// docs/methods.md#b3: moving walls change a cell's solid angle, and its own distance the cosine at its
/// middle.
Sum krivanek(const Cells& cells) {
  Sum sum;
  for (int k = 0; k < cells.slices(); ++k) {
    for (int j = 0; j < cells.rings(); ++j) {
      const std::size_t cell = cells.at(j, k), before = cells.at(j, k - 1);
      const double sine = cells.sine(j + 0.5), cosine = cells.cosine(j + 0.5);
      const double height = cells.cosine(j) - cells.cosine(j + 1);
      const double solid_angle = cells.slice_angle() * height;
      sum.add(solid_angle * sine * cosine * cells.nearness(cell) * cells.light(cell), cells.outward(k));
      sum.add(height / sine * cosine * std::max(cells.nearness(before), cells.nearness(cell)) *
                  (cells.light(cell) - cells.light(before)),
              cells.across_edge(k));
      if (j == 0) continue;
      const std::size_t inner = cells.at(j - 1, k);
      sum.add(cells.slice_angle() * cells.sine(j) * cells.cosine(j) *
                  std::max(cells.nearness(inner), cells.nearness(cell)) *
                  (cosine * cells.light(cell) - cells.cosine(j - 0.5) * cells.light(inner)),
              cells.outward(k));
    }
  }
  return sum;
}

/// Is hit `at` in front of or on the tangent plane of hit `of`? An escaped ray has hit something infinitely
/// far.
bool in_front(const Hemisphere& h, std::size_t at, std::size_t of) {
  if (std::isinf(h.distance_m[of])) return true;
  const DVec3 normal(h.hit_normal[of]);
  if (std::isinf(h.distance_m[at])) return glm::dot(normal, DVec3(h.direction[at])) >= -kTangent;
  const auto hit = [&](std::size_t i) {
    return DVec3(h.direction[i]) * static_cast<double>(h.distance_m[i]);
  };
  const DVec3 step = hit(at) - hit(of);
  return glm::dot(normal, step) >= -kTangent * glm::length(step);
}

struct Occlusion {
  Sum light;
  DVec2 even{0};
};

/// docs/methods.md#b5: at an edge before which lies something near, that moves with the near thing.
Occlusion occlusion(const Hemisphere& h, const Cells& cells, float least_m) {
  Occlusion sum;
  cells.for_each_wall([&](std::size_t before, std::size_t cell, double length, const DVec2& direction) {
    if (!one_hides_other(h, before, cell, least_m)) return;
    const double a = cells.nearness(before), b = cells.nearness(cell), swept = length * std::fabs(a - b);
    const DVec3 far = a >= b ? cells.light(cell) : -cells.light(before);
    sum.light.add(swept * far, direction);
    sum.even += (a >= b ? swept : -swept) * std::numbers::inv_pi * direction;
  });
  return sum;
}

}  // namespace

bool one_hides_other(const Hemisphere& h, std::size_t a, std::size_t b, float least_m) {
  const auto far = [&](std::size_t i) {
    return static_cast<double>(std::max({h.distance_m[i], least_m, std::numeric_limits<float>::min()}));
  };
  const double ra = far(a), rb = far(b);
  return std::max(ra, rb) > kJump * std::min(ra, rb) && !(in_front(h, a, b) && in_front(h, b, a));
}

Gradients ray_gradients(const Hemisphere& h, GradientMode mode, float least_m) {
  Gradients g;
  if (mode == GradientMode::none) return g;
  if (!h.stratified() || h.measure == Measure::solid) {
    PHOS_CHECK(mode == GradientMode::analytic, "no cells of equal projected solid angle: ", name_of(mode));
    rotation_unstructured(h).to(g.rotation, h.frame);
    analytic(h, least_m).to(g.translation, h.frame);
    return g;
  }
  const Cells cells(h, least_m);
  rotation(cells).to(g.rotation, h.frame);
  Sum translation;
  switch (mode) {
    case GradientMode::analytic:
      translation = analytic(h, least_m);
      break;
    case GradientMode::ward_heckbert:
      translation = ward_heckbert(cells);
      break;
    case GradientMode::krivanek:
      translation = krivanek(cells);
      break;
    case GradientMode::hybrid: {
      translation = analytic(h, least_m);
      const Sum edges = occlusion(h, cells, least_m).light;
      for (int c = 0; c < 3; ++c) translation.rows[c] += edges.rows[c];
      break;
    }
    default:
      PHOS_CHECK(false, "not a gradient of rays: ", name_of(mode));
  }
  translation.to(g.translation, h.frame);
  return g;
}

OcclusionGradient occlusion_gradient(const Hemisphere& h, float least_m) {
  PHOS_CHECK(h.stratified() && h.measure != Measure::solid, "no cells of equal projected solid angle");
  const Occlusion sum = occlusion(h, Cells(h, least_m), least_m);
  OcclusionGradient g;
  sum.light.to(g.light, h.frame);
  g.even = h.frame.to_world(Vec3(Vec2(sum.even), 0));
  return g;
}

}  // namespace phos::inline estimate
