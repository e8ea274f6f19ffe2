// Where records are wanted, as the command line says it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/options.h"

namespace phos::inline place {

enum class Place {
  automatic,  ///< given points, or photons, or every surface: the first that there is
  photons,    ///< where photons landed
  given,      ///< given points that no record covers yet
  every,      ///< every given point, covered or not
  view,       ///< the surfaces that a camera sees
  surface,    ///< every surface of the scene, lit or not
};

struct PlacementOptions {
  std::int64_t max_candidates = 0;  ///< photons tried; 0: all
  std::int64_t passes = 4;  ///< over the candidates; later ones cover what neighbour clamping uncovered
  Place place = Place::automatic;
  std::string camera{};                ///< of view: "" = the scene's first
  std::int64_t width = 0, height = 0;  ///< of view, pixels; 0: as resolve_size() says
  /// Of view: as the camera sees it. Not given: 1 / accuracy, which makes no record serve less than a pixel.
  std::optional<double> min_radius_pixels{};
  double max_radius_pixels = 0;  ///< of view; 0: no bound
  std::string part{};            ///< of every: "k/n", or empty: all
  /// Of surface, by gathered rays: root mean square error aimed at, of the mean; empty: radii by the rules of
  /// RecordOptions alone.
  std::optional<double> error{};
};

void declare_options(Options& options, PlacementOptions& placement);

/// All but --part and --placement-error.
void declare_place_options(Options& options, PlacementOptions& placement);

}  // namespace phos::inline place
