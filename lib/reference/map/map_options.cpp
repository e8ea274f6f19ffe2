#include "reference/map/map_options.h"

namespace phos::inline reference {

void declare_options(Options& options, MapOptions& map) {
  options.section("Photon map");
  options.integer(
      "photons-in-disc", map.photons_in_disc, "N",
      "of --method final-gather and photons: light of a point is that of so many photons nearest to "
      "it, less one, over the area of the disc that reaches to the last; more is less noise and more "
      "blur",
      {2, 1e6}, Recorded::if_given);
  options.integer("gather-rays", map.gather_rays, "N",
                  "of --method final-gather: rays of a hemisphere, for each of --samples", {1, 1e6},
                  Recorded::if_given);
}

}  // namespace phos::inline reference
