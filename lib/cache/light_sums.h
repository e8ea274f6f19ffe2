// Sums of harmonics over directions that carry light, and how they change as the place moves.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/vector.h"
#include "hsh/basis.h"

namespace phos {

/// Directions that carry light, in the frame of a record, as many as are summed at once: the tables of order
/// 10 fit the nearest caches. Those that are not set carry nothing.
struct LightBlock {
  static constexpr std::size_t kSize = 64;
  using Row = std::array<float, kSize>;
  /// By colour.
  using RgbRows = std::array<Row, 3>;

  LightBlock() { z.fill(1); }

  Row x{}, y{}, z{};
  RgbRows value{};              ///< light that a harmonic weighs
  RgbRows per_m{};              ///< the same over the distance of what it comes from
  std::array<Row, 2> normal{};  ///< tangential part of the normal there over its cosine with the direction

  void set_direction(std::size_t k, const Vec3& w) { x[k] = w.x, y[k] = w.y, z[k] = w.z; }
  static void set(RgbRows& rows, std::size_t k, const Rgb& light) {
    for (std::size_t c = 0; c < 3; ++c) rows[c][k] = light[static_cast<int>(c)];
  }
};

/// Light that comes into sight at edges of what hides it, by direction, per metre of movement along x and y.
struct LightEdges {
  LightEdges() { z.fill(1); }
  LightBlock::Row x{}, y{}, z{};
  LightBlock::RgbRows along[2]{};
  std::size_t size = 0;
};

/// As the place moves, light falls with this power of the distance, besides the cosine of what it comes from.
enum class Falloff {
  solid = 3,      ///< light is radiance x solid angle
  projected = 4,  ///< and x the cosine of the place's own surface, which falls too
};

/// Sums over blocks, in double; for one thread.
class LightSums {
 public:
  explicit LightSums(int order);
  void clear();

  void add_values(const LightBlock& block);
  /// And the slopes of each term: value / r ((n_a / cos + power w_a) H - G_a), G the surface gradient of H.
  void add_with_slopes(const LightBlock& block, Falloff falloff);
  /// The same by differences between places displaced to either side, what the light comes from kept.
  void add_with_differences(const LightBlock& block, Falloff falloff);
  void add_edges(const LightEdges& edges);

  std::vector<double> light, slope[2];  ///< [order^2][3]; per metre along x and y

 private:
  void evaluate(const LightBlock::Row& x, const LightBlock::Row& y, const LightBlock::Row& z);

  HarmonicBasis<float> basis_;
  std::size_t count_;
  std::vector<float> h_, hx_, hy_;  // [count][block]
};

}  // namespace phos
