#include "view/gloss_message.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "hsh/basis.h"
#include "record/weight.h"
#include "view/message/writer.h"

namespace phos::inline view {
namespace {

using Floats = std::vector<float>;
using Numbers = std::vector<std::uint32_t>;

void add(Floats& values, const Vec3& v) { values.insert(values.end(), {v.x, v.y, v.z}); }
void add(Floats& values, const float* rgb) { values.insert(values.end(), rgb, rgb + 3); }

const BrdfTable* table_of(const GlossCache* cache, std::uint32_t material) {
  const BrdfTable* table = cache ? cache->tables().table(material) : nullptr;
  return table && table->isotropic ? table : nullptr;
}

void add_lobes(const Scene& scene, const GlossCache* cache, MessageWriter& message) {
  Numbers material, order, first_row, rows, bands, first_number;
  Floats value;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) {
    const BrdfTable* table = table_of(cache, m);
    if (!table) continue;
    material.push_back(m), order.push_back(static_cast<std::uint32_t>(table->order));
    first_row.push_back(static_cast<std::uint32_t>(bands.size()));
    rows.push_back(static_cast<std::uint32_t>(table->resolution));
    const auto numbers = 3 * static_cast<std::size_t>(harmonic_count(table->order));
    for (std::size_t e = 0; e < table->entries(); ++e) {
      bands.push_back(table->orders[e]);
      first_number.push_back(static_cast<std::uint32_t>(value.size() / 3));
      const float* c = &table->coefficients[e * numbers];
      for (int l = 0; l < table->order; ++l)
        for (int k = 0; k <= l; ++k) add(value, c + 3 * harmonic_index(l, k));
    }
  }
  message.add("lobe", "material", material);
  message.add("lobe", "order", order);
  message.add("lobe", "first_row", first_row);
  message.add("lobe", "row_count", rows);
  message.add("lobe_row", "bands", bands);
  message.add("lobe_row", "first_number", first_number);
  message.add("lobe_number", "value", value);
}

/// The trees that isotropic lobes read.
Numbers orders_read(const Scene& scene, const GlossCache* cache) {
  Numbers orders;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m)
    if (const BrdfTable* table = table_of(cache, m))
      orders.push_back(static_cast<std::uint32_t>(table->order));
  std::sort(orders.begin(), orders.end());
  orders.erase(std::unique(orders.begin(), orders.end()), orders.end());
  return orders;
}

void add_records(const Scene& scene, const GlossCache* cache, MessageWriter& message) {
  Floats position, inverse_radius, normal, front_limit, axis_x, over_limit, steepness, weight, number;
  Numbers order, first_number;
  constexpr float kMost = std::numeric_limits<float>::max();
  for (const std::uint32_t n : orders_read(scene, cache)) {
    const RadianceTree& tree = *cache->tree(static_cast<int>(n));
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const RadianceRecord& r = tree[i];
      PHOS_CHECK(!r.footprint_m, "records with footprints");
      if (!(r.radius_m > 0)) continue;  // serves nothing
      add(position, r.position), add(normal, r.frame.z), add(axis_x, r.frame.x);
      inverse_radius.push_back(std::min(1 / r.radius_m, kMost));
      front_limit.push_back(-kFrontTolerance * r.radius_m);
      over_limit.push_back(std::min(over_limit_m(r.distance_m, r.radius_m), kMost));
      steepness.push_back(steepness_per_m(r)), weight.push_back(r.weight);
      order.push_back(n), first_number.push_back(static_cast<std::uint32_t>(number.size() / 3));
      const float none[3] = {};
      for (std::size_t k = 0; k < r.light.size(); k += 3) {
        add(number, &r.light[k]);
        for (const std::vector<float>* slope : {&r.gradient_x, &r.gradient_y})
          add(number, slope->empty() ? none : &(*slope)[k]);
      }
    }
  }
  message.add("record", "position", position);
  message.add("record", "inverse_radius", inverse_radius);
  message.add("record", "normal", normal);
  message.add("record", "front_limit", front_limit);
  message.add("record", "axis_x", axis_x);
  message.add("record", "over_limit", over_limit);
  message.add("record", "steepness", steepness);
  message.add("record", "weight", weight);
  message.add("record", "order", order);
  message.add("record", "first_number", first_number);
  message.add("number", "value", number);
}

}  // namespace

std::string gloss_message(const Scene& scene, const GlossCache* cache, double accuracy) {
  MessageWriter message(MessageKind::gloss);
  message.add("cache", "accuracy", Floats{static_cast<float>(accuracy)});
  add_lobes(scene, cache, message);
  add_records(scene, cache, message);
  return message.message();
}

bool reads_records(const GlossCache* cache, std::uint32_t material) { return table_of(cache, material); }

bool has_gloss_records(const Scene& scene, const GlossCache* cache) {
  for (const std::uint32_t order : orders_read(scene, cache))
    if (cache->tree(static_cast<int>(order))->size() > 0) return true;
  return false;
}

}  // namespace phos::inline view
