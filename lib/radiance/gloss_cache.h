// Radiance records of a scene, and the lobes that read them.
#pragma once

#include <optional>
#include <vector>

#include "radiance/cache.h"
#include "radiance/gloss_tables.h"
#include "radiance/tree.h"

namespace phos::inline radiance {

/// Lookups of the gloss of surfaces, at the eye and where secondary rays land. Materials that want equal
/// orders share their records; a record of fewer bands than a material wants does not serve it, one of an
/// order that no material wants serves all that want fewer bands. Const once filled, usable from any thread,
/// each with a worker of its own.
class GlossCache {
 public:
  GlossCache(const Bounds& bounds, double accuracy, GlossTables tables, const RayScene* leak_test = nullptr);
  /// Its slopes are those that pay at the cache's accuracy (settle_slopes).
  void insert(RadianceRecord record);
  /// Of records in all trees; one that serves no material is not kept.
  std::size_t size() const;
  const GlossTables& tables() const { return tables_; }
  /// The records of one order; null: there is none.
  const RadianceTree* tree(int order) const;

  struct Worker {
    GlossLobe lobe;
    RadianceTree::Worker tree;
  };
  /// Is the lobe of this point towards wo (unit, world) read from records? Sets worker.lobe.
  bool serves(const SurfacePoint& point, const Vec3& wo, Worker& worker) const;
  /// Light that leaves along wo through the lobe, but for the light that lamps send straight there. Nothing:
  /// it is to be traced. weight 0: no record reaches the point (a miss).
  std::optional<GlossyLight> outgoing(const SurfacePoint& point, const Vec3& wo, Worker& worker) const;

 private:
  GlossTables tables_;
  double accuracy_;
  std::vector<RadianceTree> trees_;  // of tables_.orders()
};

}  // namespace phos::inline radiance
