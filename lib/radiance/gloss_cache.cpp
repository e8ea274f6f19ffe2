#include "radiance/gloss_cache.h"

#include "hsh/basis.h"
#include "radiance/tree.h"
#include "scene/rays.h"

namespace phos::inline radiance {
namespace {

/// The first bands of a record.
RadianceRecord cut(const RadianceRecord& r, int order) {
  RadianceRecord low = r;
  const auto bands = static_cast<std::size_t>(order), numbers = 3 * bands * bands;
  for (std::vector<float>* v : {&low.light, &low.gradient_x, &low.gradient_y})
    if (!v->empty()) v->resize(numbers);
  low.stderr_light.resize(3 * bands);
  return low;
}

}  // namespace

GlossCache::GlossCache(const Bounds& bounds, double accuracy, GlossTables tables, const RayScene* leak_test)
    : tables_(std::move(tables)), accuracy_(accuracy) {
  for (const int order : tables_.orders()) trees_.emplace_back(bounds, accuracy, order, leak_test);
}

void GlossCache::insert(RadianceRecord record) {
  settle_slopes(record, accuracy_);
  const int order = record.order();
  for (RadianceTree& tree : trees_)
    if (tree.order() == order) return tree.insert(std::move(record));
  for (RadianceTree& tree : trees_)
    if (tree.order() < order) tree.insert(cut(record, tree.order()));
}

std::size_t GlossCache::size() const {
  std::size_t n = 0;
  for (const RadianceTree& tree : trees_) n += tree.size();
  return n;
}

const RadianceTree* GlossCache::tree(int order) const {
  for (const RadianceTree& tree : trees_)
    if (tree.order() == order) return &tree;
  return nullptr;
}

bool GlossCache::serves(const SurfacePoint& point, const Vec3& wo, Worker& worker) const {
  return tables_.lobe(point, wo, worker.lobe);
}

std::optional<GlossyLight> GlossCache::outgoing(const SurfacePoint& point, const Vec3& wo,
                                                Worker& worker) const {
  if (!serves(point, wo, worker)) return {};
  const GlossLobe& lobe = worker.lobe;
  return tree(tables_.order(point.material))
      ->outgoing(point.position, lobe.frame, lobe.coefficients, lobe.least, worker.tree);
}

}  // namespace phos::inline radiance
