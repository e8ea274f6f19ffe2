// Counter-based random numbers: Philox 4x32-10 (Salmon et al. 2011, Random123).
// A number depends on (seed, stage, item, bounce, dimension) and nothing else: not on threads, shards or
// order.
#pragma once

#include <array>
#include <cstdint>

#include "core/vector.h"

namespace phos {

/// Separates the streams of stages that use the same seed. Never renumber: files depend on it.
enum class Stage : std::uint32_t {
  emission = 1,
  photon_path = 2,
  placement = 3,
  record = 4,
  camera = 5,
  direct_light = 6,
  specular = 7,
  reference = 8,
  pilot = 9,
  edge_light = 10,
  near_light = 11,
  mirror_image = 12,
  through_portal = 13,
  test = 1000,
};

/// The numbers of one item (photon path, pixel sample, record). Cheap to construct; not shared between
/// threads.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, Stage stage, std::uint64_t item)
      : seed_(seed), item_(item), stage_(stage) {}

  /// Starts the numbers of a bounce (0 .. 65535) at its dimension 0, so that a path's later bounces do not
  /// shift when an earlier one draws more.
  void start_bounce(std::uint32_t bounce) { bounce_ = bounce, block_ = 0, used_ = 4; }

  /// 32 random bits.
  std::uint32_t bits() {
    if (used_ == 4) refill();
    return buffer_[used_++];
  }
  /// Uniform in [0, 1): a multiple of 2^-24.
  float uniform() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }
  Vec2 uniform2() {
    const float a = uniform();
    return {a, uniform()};
  }
  /// Uniform in [0, 1) with 53 bits.
  double uniform_double() {
    const std::uint64_t a = bits();
    return static_cast<double>((a << 21) ^ (bits() >> 11)) * 0x1p-53;
  }

 private:
  void refill();
  std::uint64_t seed_, item_;
  Stage stage_;
  std::uint32_t bounce_ = 0, block_ = 0, used_ = 4;
  std::array<std::uint32_t, 4> buffer_{};
};

}  // namespace phos
