// Interpolation between radiance records.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "core/vector.h"
#include "radiance/cache.h"
#include "record/tree.h"

namespace phos::inline scene {
class RayScene;
}

namespace phos::inline radiance {

/// Light that leaves a point by its glossy lobe.
struct GlossyLight {
  Rgb radiance{0};   ///< cd/m2; harmonics that ring below the least are cut off
  Rgb stderr_cd{0};  ///< cd/m2, of the mean of records (blended_error)
  float weight = 0;  ///< sum of weights; 0: a miss
};

/// Lookup structure over radiance records, with the weights and the acceptance of RecordTree. Point queries
/// in any order and from any thread; records are added serially.
class RadianceTree {
 public:
  /// Of records of one order; throws Error(usage) unless 1 <= order <= HshRotator::kMaxOrder. With
  /// `leak_test`, a record is valid only where no surface stands between it and the point (the tree holds a
  /// reference).
  RadianceTree(const Bounds& bounds, double accuracy, int order, const RayScene* leak_test = nullptr);
  ~RadianceTree();
  RadianceTree(RadianceTree&&) noexcept;
  int order() const;
  std::size_t size() const;
  const RadianceRecord& operator[](std::size_t record) const;
  void insert(RadianceRecord record);
  /// Their irradiance, their radii and the places that they cover.
  const RecordTree& irradiance() const;

  /// Memory of one thread, with the result of the last lookup.
  struct Worker {
    std::vector<const IrradianceRecord*> found;
    std::vector<float> sum, turned;
    std::vector<float> light;  ///< interpolate(): [order^2][3] of the order and in the frame asked for
    std::vector<float>
        stderr_light;  ///< [order][3], as far as it does not average out (disagreement left out)
  };
  /// Sets worker.light to the light that arrives at p in `frame` (z its normal, unit), to `order` bands (at
  /// most those of the records; bands above are cut off before records are turned, which is exact between
  /// equal normals and costs about 1% of the light that leaves where they differ by 20 degrees): the sum of w
  /// R (c + dx g_x + dy g_y) / sum of w, where a step towards p that would change a record by more than its
  /// own energy is shortened to that. Returns the sum of weights; 0: no record is valid, all is 0.
  float interpolate(const Vec3& p, const Frame& frame, int order, Worker& worker) const;
  /// Light that leaves p through a lobe, [order^2][3] in `frame`: the lobe times the result of interpolate().
  /// The least is `least` (1/sr, 0 or below) times the irradiance. Where records are turned it is the lobe
  /// that is turned to each of them (transposed), at half the cost where it has no colour.
  GlossyLight outgoing(const Vec3& p, const Frame& frame, std::span<const float> lobe, const Rgb& least,
                       Worker& worker) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace phos::inline radiance
