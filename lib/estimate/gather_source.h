// The light that gathered rays read where they land.
#pragma once

namespace phos::inline record {
class FarRecords;
class RecordTree;
}  // namespace phos::inline record
namespace phos::inline radiance {
class GlossCache;
}

namespace phos::inline estimate {

class CausticLight;
class Estimator;
struct RecordSite;

/// What lights the places that rays find, besides the lamps.
struct GatherSource {
  const RecordTree* indirect = nullptr;  ///< cache of indirect light; null: none, rays show the first bounce
  const FarRecords* far = nullptr;       ///< answers where that cache has no record near enough (counted)
  const Estimator* fallback =
      nullptr;  ///< estimates indirect light where neither has a record (counted); null: dark
  bool holds_direct =
      false;  ///< the cache holds light straight from the lamps too: none is sampled where rays land
  /// The cache and `fallback` lack the light that lamps send by flat mirrors alone, which is direct light at
  /// their records (scene/mirror/images.h): it is sampled where rays land.
  bool lacks_images = false;
  /// Radiance records: the light of glossy lobes that they serve, but for lamps; null: none. Where no record
  /// is near enough (counted), gloss is followed as elsewhere.
  const GlossCache* gloss = nullptr;
  /// Caustic light, where `indirect` holds none; null: it is in it.
  const CausticLight* caustics = nullptr;
  const CausticLight* gloss_caustics = nullptr;  ///< the same of `gloss`
  // The noise of that light (SourceNoise).
  double photon_lm = 0;     ///< luminance that one photon of the source carries, lm; 0: it is taken as exact
  double zone_photons = 0;  ///< that its zones hold; with photon_lm: how wide they are
  double common = 0;        ///< relative variance of the whole source together
  /// Records of `indirect` tell their common error, which differs from place to place: paths that part
  /// (Photons::family) light the places beside a window most. `common` is then for places without a record.
  bool tell_common = false;
  double usual_lx = 0;  ///< luminance of `indirect`, mean over surfaces; 0: unknown

  /// The part of a site's own lower bound of the radius that counts, for errors of bright places weigh more
  /// in a picture: (2 usual_lx / E)^1/2 where E, which `indirect` has there, is more than twice usual; 1/4 at
  /// least, 1 where E is not known. Records then lie as dense as light is bright: at most half again as many
  /// in all as with the bound alone. It does not ask the record's own E: one that is too bright by the noise
  /// of its rays would have less weight than one that is too dark, and pictures of few rays would be too
  /// dark.
  float least_share(const RecordSite& site) const;
};

}  // namespace phos::inline estimate
