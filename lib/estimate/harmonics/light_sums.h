// Sums of harmonics over directions that carry light, and how they change as the place moves.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/vector.h"
#include "estimate/harmonics/light_products.h"
#include "hsh/basis.h"
#include "hsh/slopes.h"

namespace phos::inline estimate {

/// Light that arrives from one direction, in the frame of a record.
struct DirectedLight {
  Vec3 direction{0, 0, 1};  ///< unit
  Rgb value{0};             ///< light that a harmonic weighs
  Rgb per_m{0};             ///< the light over the distance of its source
  Vec2 normal{0};           ///< tangential part of the normal there over its cosine with the direction
};

/// How slopes are found.
enum class SlopesBy {
  none,
  terms,        ///< of each term: value / r ((n_a / cos + power w_a) H - G_a), G the surface gradient of H
  differences,  ///< between places displaced to either side, with the sources of light kept
};

/// As the place moves, light falls with this power of the distance, besides the cosine at its source.
enum class Falloff {
  solid = 3,      ///< light is radiance x solid angle
  projected = 4,  ///< and x the cosine of the place's own surface, which falls too
};

/// Sums of harmonics, in double over blocks of directions in float; for one thread. start(), add the
/// light, finish().
class LightSums {
 public:
  explicit LightSums(int order);
  void start(SlopesBy slopes, Falloff falloff);
  void add(const DirectedLight& light);
  /// Light that comes into sight at an edge of an occluder, per metre of movement along x and y.
  void add_edge(const Vec3& direction, const Rgb& along_x, const Rgb& along_y);
  void finish();

  std::vector<double> light, slope[2];  ///< [order^2][3], once finished; per metre along x and y, or 0

 private:
  /// Directions that wait for their sums; those that are not set weigh nothing.
  template <std::size_t kWeights>
  struct Block {
    std::array<float, kLightBlock> x, y, z;
    alignas(32) std::array<std::array<float, kWeights>, kLightBlock> weight;
    std::size_t size = 0;
    std::vector<double> sums;  // [count][kWeights]
    void clear();
    void start(std::size_t count);
    /// Returns where its weights go.
    std::array<float, kWeights>& next(const Vec3& direction);
  };
  template <std::size_t kWeights>
  void flush(const HarmonicBasis<float>& basis, Block<kWeights>& block);
  void add_differences(const DirectedLight& light);

  HarmonicBasis<float> basis_, slope_basis_;  // the latter of one band more
  HshSlopes slopes_of_;
  std::vector<float> harmonics_;  // [count][kLightBlock]
  SlopesBy slopes_ = SlopesBy::none;
  float power_ = 0;
  Block<8> values_;   // light alone
  Block<8> edges_;    // slopes along x and y
  Block<16> sloped_;  // light, what slopes along x and y have of H, and what p and q of HshSlopes weigh
};

}  // namespace phos::inline estimate
