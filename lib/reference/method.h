// By which paths a reference is computed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/options.h"
#include "scene/report/light_ways.h"

namespace phos::inline reference {

class MapLight;
struct MapScene;
struct MapOptions;

enum class ReferenceMethod : std::uint8_t {
  automatic,      ///< bidirectional where path tracing leaves light out, else path
  path,           ///< from the eye or sensor (eye_path_tracer.h)
  bidirectional,  ///< from both ends (bidirectional.h)
  final_gather,   ///< gathering at every pixel over a photon map (map/final_gather.h)
  photons,        ///< the photon map itself (map/photon_view.h)
};

/// The table: one row a method.
struct ReferenceMethodRow {
  ReferenceMethod method;
  const char* name;
  const char* summary;  ///< for the help of --method
  /// The light of a method that reads a photon map; null of those that read none.
  std::unique_ptr<MapLight> (*map_light)(const MapScene& scene, const MapOptions& options) = nullptr;
  const char* error_of = "";      ///< the errors that its standard error holds, and others; "": all errors
  bool error_by_samples = true;   ///< does more --samples make its standard error less?
  bool shares_samples = true;     ///< can it take more samples of one pixel than of another?
  bool gloss_by_photons = false;  ///< is gloss that an eye sees lit by photons alone?

  bool reads_map() const { return map_light != nullptr; }
};
std::span<const ReferenceMethodRow> reference_methods();
const ReferenceMethodRow& row_of(ReferenceMethod method);

enum class MethodChoice : std::uint8_t { without_map, all };
/// The option --method: `help`, and for MethodChoice::all the summaries of the table after it.
void declare_method(Options& options, ReferenceMethod& method, const std::string& help,
                    MethodChoice choice = MethodChoice::without_map);

/// Is the method bidirectional, `automatic` resolved: where something casts caustics, or path tracing with so
/// many samples leaves out one of these ways?
bool is_bidirectional(ReferenceMethod method, const Scene& scene, const std::vector<LightWay>& ways,
                      double samples);

}  // namespace phos::inline reference
