// The light where a ray of the page lands.
#pragma once

#include <string>
#include <string_view>

#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "sense/sensors.h"

namespace phos::inline view {

/// Reads light as phos-sense does at a sensor: from the records of the caches, with shadow rays. Holds
/// references.
class LightReader {
 public:
  /// Caches must hold a record at least.
  LightReader(const RayScene& rays, const Luminaires& lights, const SensorCaches& caches,
              const SensorOptions& options)
      : rays_(rays), lights_(lights), caches_(caches), options_(options) {}

  /// The reading that answers a question (view/message/format.h). Throws Error(bad_input) for a message that
  /// is none, and for a ray without a direction.
  std::string answer(std::string_view question) const;

 private:
  const RayScene& rays_;
  const Luminaires& lights_;
  const SensorCaches& caches_;
  SensorOptions options_;
};

}  // namespace phos::inline view
