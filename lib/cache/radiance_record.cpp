#include "cache/radiance_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "cache/radiance_error.h"
#include "cache/record_of.h"
#include "core/error.h"
#include "core/sampling.h"
#include "hsh/basis.h"
#include "hsh/rotation.h"

namespace phos {
namespace {

/// Rays whose harmonics are made at once: the tables of order 10 fit the nearest caches.
constexpr std::size_t kBlock = 64;
/// Least cosine of an emitter in a gradient, which it divides.
constexpr float kLeastCosine = 0.05f;
/// Of the distance of a hit: how far the numeric gradient moves the place to either side. Differences of this
/// step are right to its square, and their rounding is 1e-7 of its inverse.
constexpr float kStep = 1.f / 128;

using Row = std::array<float, kBlock>;
/// Weights of the rays of a block, by colour.
using RgbRows = std::array<Row, 3>;

void set(RgbRows& rows, std::size_t k, const Rgb& value) {
  for (int c = 0; c < 3; ++c) rows[static_cast<std::size_t>(c)][k] = value[c];
}

/// Four floats that one instruction takes.
using Lanes = float __attribute__((vector_size(16)));
constexpr std::size_t kLanes = 4;

Lanes load(const float* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
void add(const Lanes (&lanes)[3], double* sums) {
  for (std::size_t c = 0; c < 3; ++c)
    sums[c] += static_cast<double>((lanes[c][0] + lanes[c][1]) + (lanes[c][2] + lanes[c][3]));
}

/// Adds the sum of harmonic x weight over a block to each colour.
void add_products(const float* harmonic, const RgbRows& weights, double* sums) {
  Lanes sum[3] = {};
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const Lanes h = load(harmonic + k);
    for (std::size_t c = 0; c < 3; ++c) sum[c] += h * load(&weights[c][k]);
  }
  add(sum, sums);
}

/// What one harmonic over a block adds to its coefficient and to the slopes of it along x and y: the harmonic
/// weighs `value` and `along`, its own slopes weigh -per_m.
void add_with_slopes(const float* harmonic, const float* slope_x, const float* slope_y, const RgbRows& value,
                     const RgbRows (&along)[2], const RgbRows& per_m, double* sums, double* x, double* y) {
  Lanes of_value[3] = {}, of_x[3] = {}, of_y[3] = {};
  for (std::size_t k = 0; k < kBlock; k += kLanes) {
    const Lanes h = load(harmonic + k), hx = load(slope_x + k), hy = load(slope_y + k);
    for (std::size_t c = 0; c < 3; ++c) {
      const Lanes weight = load(&per_m[c][k]);
      of_value[c] += h * load(&value[c][k]);
      of_x[c] += h * load(&along[0][c][k]) - hx * weight;
      of_y[c] += h * load(&along[1][c][k]) - hy * weight;
    }
  }
  add(of_value, sums), add(of_x, x), add(of_y, y);
}

/// Rays of a block in the frame of the hemisphere. Those that are missing from the last block carry nothing.
struct Block {
  Row x, y, z;
  RgbRows value;              ///< L omega
  RgbRows per_m;              ///< L omega / r
  std::array<Row, 2> normal;  ///< tangential part of the hit's normal over its cosine with the ray

  Block(const Hemisphere& h, std::size_t first, float least_m) {
    for (std::size_t k = 0; k < kBlock; ++k) {
      const std::size_t i = first + k;
      const bool there = i < h.size();
      const Vec3 w = there ? h.frame.to_local(h.direction[i]) : Vec3(0, 0, 1);
      const Vec3 n = there ? h.frame.to_local(h.hit_normal[i]) : Vec3(0, 0, -1);
      const Rgb light = there ? h.solid_sr(i) * h.radiance[i] : Rgb(0);
      const float cosine = std::max(kLeastCosine, -glm::dot(n, w));
      x[k] = w.x, y[k] = w.y, z[k] = w.z;
      set(value, k, light);
      set(per_m, k, there ? light / std::max(h.distance_m[i], least_m) : Rgb(0));
      normal[0][k] = n.x / cosine, normal[1][k] = n.y / cosine;
    }
  }
};

/// Light that comes into sight at edges of what hides it, by direction, per metre of movement along x and y.
struct Edges {
  Row x{}, y{}, z{};
  RgbRows along[2]{};
  std::size_t size = 0;
  void clear() { *this = {}, z.fill(1); }
};

std::vector<float> narrowed(const std::vector<double>& v) { return {v.begin(), v.end()}; }

float harmonic_mean_m(const Hemisphere& h) {
  double weights = 0, nearness = 0;
  for (std::size_t i = 0; i < h.size(); ++i) {
    const auto weight = static_cast<double>(h.solid_sr(i));
    weights += weight, nearness += weight / std::fabs(static_cast<double>(h.distance_m[i]));  // -0 is 0
  }
  return nearness > 0 ? static_cast<float>(weights / nearness) : kInfinity;
}

}  // namespace

struct RadianceProjector::Impl {
  explicit Impl(int order)
      : basis(order), count(static_cast<std::size_t>(harmonic_count(order))), error(order) {}
  HarmonicBasis<float> basis;
  std::size_t count;
  std::vector<float> h = std::vector<float>(count * kBlock), hx = h, hy = h;
  std::vector<double> light, gradient[2];
  RadianceError error;

  const float* row(const std::vector<float>& table, std::size_t i) const { return table.data() + i * kBlock; }

  void values(const Block& block) {
    basis.evaluate_batch(BasisKind::hsh, kBlock, block.x.data(), block.y.data(), block.z.data(), h.data());
    for (std::size_t i = 0; i < count; ++i) add_products(row(h, i), block.value, &light[3 * i]);
  }

  /// L omega / r ((n_a / cos + 3 w_a) H - G_a), with the sign of n as on the side that shines.
  void analytic(const Block& block) {
    basis.evaluate_batch(BasisKind::hsh, kBlock, block.x.data(), block.y.data(), block.z.data(), h.data(),
                         hx.data(), hy.data(), nullptr);
    RgbRows along[2];
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t k = 0; k < kBlock; ++k) {
        along[0][c][k] = block.per_m[c][k] * (block.normal[0][k] + 3 * block.x[k]);
        along[1][c][k] = block.per_m[c][k] * (block.normal[1][k] + 3 * block.y[k]);
      }
    }
    for (std::size_t i = 0; i < count; ++i)
      add_with_slopes(row(h, i), row(hx, i), row(hy, i), block.value, along, block.per_m, &light[3 * i],
                      &gradient[0][3 * i], &gradient[1][3 * i]);
  }

  /// From a place moved by kStep of a hit's distance along an axis, the hit lies in another direction, and
  /// its solid angle is (1 + step n_a / cos) / (distance ratio)^3 of what it was.
  void numeric(const Block& block) {
    values(block);
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const float step : {kStep, -kStep}) {
        Block moved = block;
        for (std::size_t k = 0; k < kBlock; ++k) {
          Vec3 w(block.x[k], block.y[k], block.z[k]);
          w[static_cast<int>(axis)] -= step;
          const float far = glm::length(w);
          moved.x[k] = w.x / far, moved.y[k] = w.y / far, moved.z[k] = w.z / far;
          const float seen = (1 + step * block.normal[axis][k]) / (far * far * far);
          for (std::size_t c = 0; c < 3; ++c) moved.value[c][k] = block.per_m[c][k] * seen / (2 * step);
        }
        basis.evaluate_batch(BasisKind::hsh, kBlock, moved.x.data(), moved.y.data(), moved.z.data(),
                             h.data());
        for (std::size_t i = 0; i < count; ++i) add_products(row(h, i), moved.value, &gradient[axis][3 * i]);
      }
    }
  }

  /// Adds what is at the edges, and forgets it.
  void take(Edges& edges) {
    if (edges.size == 0) return;
    basis.evaluate_batch(BasisKind::hsh, kBlock, edges.x.data(), edges.y.data(), edges.z.data(), h.data());
    for (std::size_t i = 0; i < count; ++i)
      for (const std::size_t axis : {0u, 1u})
        add_products(row(h, i), edges.along[axis], &gradient[axis][3 * i]);
    edges.clear();
  }

  /// The edge between what is near and what is far moves with the near: what the analytic gradient takes to
  /// move with the far is short of the difference, as solid angle: length of the edge across the movement x
  /// difference of 1/r.
  void occlusion(const Hemisphere& seen, float least_m) {
    Edges edges;
    edges.clear();
    const auto edge = [&](std::size_t before, std::size_t cell, const Vec3& w, float length,
                          const Vec2& across) {
      if (!one_hides_other(seen, before, cell, least_m)) return;
      const float a = 1 / std::max(seen.distance_m[before], least_m),
                  b = 1 / std::max(seen.distance_m[cell], least_m);
      const Rgb far = a >= b ? seen.radiance[cell] : -seen.radiance[before];
      const Rgb shown = length * std::fabs(a - b) * far;
      edges.x[edges.size] = w.x, edges.y[edges.size] = w.y, edges.z[edges.size] = w.z;
      set(edges.along[0], edges.size, across.x * shown), set(edges.along[1], edges.size, across.y * shown);
      if (++edges.size == kBlock) take(edges);
    };
    const auto slice_count = static_cast<float>(seen.slices);
    const auto cosine = [&](float ring) { return 1 - ring / static_cast<float>(seen.rings); };
    const auto sine = [&](float c) { return std::sqrt(std::max(0.f, (1 - c) * (1 + c))); };
    for (int j = 0; j < seen.rings; ++j) {
      const auto ring = static_cast<float>(j);
      const float upper = cosine(ring), middle = cosine(ring + 0.5f), lower = cosine(ring + 1);
      // Of the arc from the upper to the lower edge.
      const float arc = std::atan2(sine(lower), lower) - std::atan2(sine(upper), upper);
      for (int k = 0; k < seen.slices; ++k) {
        const Vec2 centre = cos_sin((static_cast<float>(k) + 0.5f) / slice_count),
                   side = cos_sin(static_cast<float>(k) / slice_count);
        if (j > 0) {
          edge(seen.at(j - 1, k), seen.at(j, k), Vec3(sine(upper) * centre, upper),
               2 * kPi / slice_count * sine(upper) * upper, centre);
        }
        edge(seen.at(j, k - 1), seen.at(j, k), Vec3(sine(middle) * side, middle), arc, {-side.y, side.x});
      }
    }
    take(edges);
  }
};

RadianceProjector::RadianceProjector(int order) {
  if (order < 1 || order > HshRotator::kMaxOrder) {
    throw Error(ExitCode::usage, "",
                text("order ", order, ": radiance records are of order 1 .. ", HshRotator::kMaxOrder));
  }
  impl_ = std::make_unique<Impl>(order);
}
RadianceProjector::~RadianceProjector() = default;

RadianceRecord RadianceProjector::project(const Hemisphere& h, RadianceGradient mode, float least_m) {
  least_m = std::max(least_m, std::numeric_limits<float>::min());
  impl_->light.assign(3 * impl_->count, 0);
  for (auto& g : impl_->gradient) g.assign(3 * impl_->count, 0);
  for (std::size_t first = 0; first < h.size(); first += kBlock) {
    const Block block(h, first, least_m);
    switch (mode) {
      case RadianceGradient::analytic:
      case RadianceGradient::hybrid:
        impl_->analytic(block);
        break;
      case RadianceGradient::numeric:
        impl_->numeric(block);
        break;
      case RadianceGradient::none:
        impl_->values(block);
    }
  }
  if (mode == RadianceGradient::hybrid && h.stratified() && h.measure == Measure::solid)
    impl_->occlusion(h, least_m);
  RadianceRecord record;
  record.frame = h.frame;
  record.distance_m = harmonic_mean_m(h);
  record.light = narrowed(impl_->light);
  if (mode != RadianceGradient::none)
    record.gradient_x = narrowed(impl_->gradient[0]), record.gradient_y = narrowed(impl_->gradient[1]);
  record.stderr_light = impl_->error.of(h);
  return record;
}

float reach_m(const RadianceRecord& record, const Hemisphere& h, const RecordOptions& resolved) {
  const float around_m = resolved.radius == RadiusRule::least ? least_distance_m(h) : record.distance_m;
  const float most_m = std::min(around_m, static_cast<float>(*resolved.max_radius_m));
  // Norms over the coefficients, by colour.
  const auto norm = [](const std::vector<float>& v) {
    DVec3 squares(0);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto x = static_cast<double>(v[i]);
      squares[static_cast<int>(i % 3)] += x * x;
    }
    return glm::sqrt(squares);
  };
  const DVec3 light = norm(record.light), x = norm(record.gradient_x), y = norm(record.gradient_y);
  const Vec3 slope[3] = {Vec3(x[0], y[0], 0), Vec3(x[1], y[1], 0), Vec3(x[2], y[2], 0)};
  return std::max(within_gradient_m(Rgb(light), slope, most_m), std::numeric_limits<float>::min());
}

}  // namespace phos
