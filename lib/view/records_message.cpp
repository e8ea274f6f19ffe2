#include "view/records_message.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "splat/cpu/splatter_kernel.h"
#include "view/message/writer.h"

namespace phos::inline view {

void add_records(std::span<const IrradianceRecord> records, MessageWriter& message) {
  std::vector<float> position, inverse_radius, normal, front_limit, irradiance, weight, stderr_lx, over_limit,
      turn, translation;
  const auto add = [](std::vector<float>& values, const auto& array) {
    values.insert(values.end(), std::begin(array), std::end(array));
  };
  for (const IrradianceRecord& record : records) {
    const PackedRecord p = pack_record(record);
    add(position, p.position), add(normal, p.normal), add(irradiance, p.irradiance),
        add(stderr_lx, p.stderr_lx);
    inverse_radius.push_back(p.inverse_radius), front_limit.push_back(p.front_limit_m);
    weight.push_back(p.weight);
    over_limit.push_back(std::min(p.over_limit_m, std::numeric_limits<float>::max()));
    for (int c = 0; c < 3; ++c) add(turn, p.turn[c]), add(translation, p.translation[c]);
  }
  message.add("record", "position", position);
  message.add("record", "inverse_radius", inverse_radius);
  message.add("record", "normal", normal);
  message.add("record", "front_limit", front_limit);
  message.add("record", "irradiance", irradiance);
  message.add("record", "weight", weight);
  message.add("record", "stderr", stderr_lx);
  message.add("record", "over_limit", over_limit);
  message.add("record", "turn", turn);
  message.add("record", "translation", translation);
}

std::string records_message(const IrradianceCache& cache, double accuracy) {
  PHOS_CHECK(!any_footprint(cache.records), "records with footprints");
  std::vector<IrradianceRecord> serving;
  std::copy_if(cache.records.begin(), cache.records.end(), std::back_inserter(serving),
               [](const IrradianceRecord& r) { return r.radius_m > 0; });
  MessageWriter message(MessageKind::records);
  message.add("cache", "accuracy", std::vector<float>{static_cast<float>(accuracy)});
  message.add("cache", "holds_direct", std::vector<std::uint32_t>{cache.quantity == Quantity::all ? 1u : 0u});
  add_records(serving, message);
  return message.message();
}

}  // namespace phos::inline view
