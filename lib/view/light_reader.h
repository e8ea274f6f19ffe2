// The light where a ray of the page lands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "sense/sensors.h"

namespace phos::inline view {

/// The light of a group of lamps: the scene in which these alone shine, and caches of it, which hold a record
/// at least. Holds references.
struct GroupLight {
  const RayScene& rays;
  const Luminaires& lights;
  const SensorCaches& caches;
};

/// The groups of a set of caches, at least one. All scenes have the same surfaces.
using GroupLights = std::vector<GroupLight>;

/// Reads light as phos-sense does at a sensor: from the records of the caches, with shadow rays. The light of
/// groups is added up with the weights of the question, errors as independent.
class LightReader {
 public:
  /// `sets` are those that a question may choose.
  LightReader(std::vector<GroupLights> sets, const SensorOptions& options)
      : sets_(std::move(sets)), options_(options) {}

  /// The reading that answers a question (view/message/format.h). Throws Error(bad_input) for a message that
  /// is none, for a ray without a direction, for a set that is not there, and for weights that are below 0 or
  /// not one for each group.
  std::string answer(std::string_view question) const;

 private:
  std::vector<GroupLights> sets_;
  SensorOptions options_;
};

}  // namespace phos::inline view
