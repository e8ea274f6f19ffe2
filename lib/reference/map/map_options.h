// How a reference reads a photon map.
#pragma once

#include <cstdint>

#include "core/options.h"

namespace phos::inline reference {

struct MapOptions {
  std::int64_t photons_in_disc = 100;  ///< the k of PhotonDiscs
  std::int64_t gather_rays = 16;       ///< of a sample of FinalGather
};

/// The options of the command line, which are recorded where they are given (or adopted).
void declare_options(Options& options, MapOptions& map);

}  // namespace phos::inline reference
