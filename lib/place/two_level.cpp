#include "place/two_level.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "estimate/caustic_light.h"
#include "estimate/density.h"
#include "estimate/gather_source.h"
#include "estimate/record_options.h"
#include "photon/caustic_map.h"
#include "photon/photon_map.h"
#include "place/placement.h"
#include "radiance/gloss_cache.h"
#include "record/far_records.h"
#include "record/irradiance_cache.h"
#include "record/tree.h"
#include "scene/rays.h"

namespace phos::inline place {
namespace {

/// Records are read somewhat beyond the reach at which they were placed, so that few places have none; not as
/// far as pictures read them, for rays average over many places anyway, and lookups are their cost.
constexpr double kReadBeyond = 1.2;

/// Records of photons that carry more than so many times the median are not usual ones.
constexpr double kUsual = 32;

/// Of the zone that a record describes.
double area_m2(const IrradianceRecord& r) {
  const auto radius_m = static_cast<double>(r.radius_m);
  const double share = r.footprint ? static_cast<double>(r.footprint->share_of_disc()) : 1;
  return std::numbers::pi * radius_m * radius_m * share;
}

/// Of a record's variance at most so much is taken for common: where nothing was left, there were no photons.
constexpr double kMostCommon = 0.999;

/// Coarse records are of photons, however the fine ones are made (coarse_options()): no table of estimators
/// is asked, which would choose by the options and wants lamps, of which this level knows none.
std::unique_ptr<Estimator> of_photons(const PhotonMap& photons, const RayScene& rays,
                                      const RecordOptions& coarse, std::uint64_t seed) {
  return std::make_unique<DensityEstimator>(photons, rays, coarse, seed);
}

/// Where rays land; null: records hold it.
std::unique_ptr<CausticLight> caustic_light(const RayScene& rays,
                                            const std::shared_ptr<const CausticPhotons>& photons) {
  if (!photons) return nullptr;
  return std::make_unique<CausticLight>(rays, std::make_shared<CausticMap>(*photons), kGatherCaustics);
}

}  // namespace

RecordOptions coarse_options(const RecordOptions& fine) {
  RecordOptions coarse = fine;
  coarse.estimate = Estimate::hull;
  coarse.gradients = GradientMode::analytic;
  coarse.leak_test = LeakTest::none;
  coarse.footprint = Footprint::circle;
  // In the dark, zones with photons enough would be so large that light is not even in them (indirect light
  // of Sponza would be 0.5 % too faint; it is 0.1 %). Fewer photons are noisier there, which rays average
  // out.
  PHOS_CHECK(fine.source_max_radius_m, "resolve() first");
  coarse.max_radius_m = fine.source_max_radius_m;
  coarse.accuracy = fine.source_accuracy;
  coarse.min_photons = fine.source_photons;
  coarse.max_photons = 4 * fine.source_photons;
  coarse.paths = Quantity::indirect;
  coarse.images_apart = false;
  coarse.caustics_apart = false;  // where rays land, all light counts that is not straight from a lamp
  return coarse;
}

EquivalentPhotons equivalent_photons(std::span<const IrradianceRecord> records, double accuracy) {
  struct OfRecord {
    double noise = 0, light = 0, error = 0;
    double part = 0;  // of its variance, in common
    double area = 0;
    double photon_lm() const { return noise / light; }
    auto operator<=>(const OfRecord&) const = default;
  };
  std::vector<OfRecord> noisy;
  double light_of_exact = 0, squares_of_exact = 0, flux = 0;
  for (const IrradianceRecord& r : records) {
    const auto error = static_cast<double>(luminance(r.stderr_lx)),
               lux = static_cast<double>(luminance(r.irradiance));
    const double noise = accuracy * accuracy * area_m2(r) * error * error;
    if (noise > 0 && lux > 0)
      noisy.push_back({noise, lux, error, std::min(common_part(r.shared), kMostCommon), area_m2(r)});
    else
      light_of_exact += lux, squares_of_exact += lux * lux, flux += lux * area_m2(r);
  }
  if (noisy.empty()) return {};
  const auto middle = noisy.begin() + static_cast<std::ptrdiff_t>(noisy.size() / 2);
  std::nth_element(noisy.begin(), middle, noisy.end(),
                   [](const OfRecord& a, const OfRecord& b) { return a.photon_lm() < b.photon_lm(); });
  const double most_lm = kUsual * middle->photon_lm();
  // Sums run in one order everywhere: nth_element() leaves another in each library.
  std::sort(noisy.begin(), noisy.end(), [](const OfRecord& a, const OfRecord& b) {
    return a.photon_lm() != b.photon_lm() ? a.photon_lm() < b.photon_lm() : a < b;
  });
  double noise = 0, light = light_of_exact, squares = squares_of_exact, errors = 0, alone = 0, common = 0;
  for (const OfRecord& r : noisy) {
    if (r.photon_lm() > most_lm) break;
    noise += r.noise, light += r.light, squares += r.light * r.light, errors += r.error * r.error;
    alone += (1 - r.part) * r.noise;
    flux += r.light * r.area, common += std::sqrt(r.part) * r.error * r.area;
  }
  // As wide as zones are: what records have in common makes their photons seem fewer, not their zones wider.
  const double share = alone / noise;
  return {share * noise / light, squares / errors / share, common * common / (flux * flux)};
}

double mean_irradiance_lx(std::span<const IrradianceRecord> records) {
  double flux = 0, area = 0;
  for (const IrradianceRecord& r : records) {
    flux += area_m2(r) * static_cast<double>(luminance(r.irradiance)), area += area_m2(r);
  }
  return area > 0 ? flux / area : 0;
}

CoarseLevel::CoarseLevel(const RayScene& rays, const PhotonMap& photons, const RecordOptions& resolved,
                         std::uint64_t seed) {
  const RecordOptions coarse = coarse_options(resolved);
  photons_ = of_photons(photons, rays, coarse, seed);
  noise_ = photon_noise(photons, false);
  tell_common_ = !photons.family.empty();
  zone_photons_ = 2 * static_cast<double>(coarse.min_photons);  // min_photons to 4 times as many
  if (resolved.gather_from == GatherFrom::photons) return;
  IrradianceCache cache;
  cache.accuracy = coarse.accuracy;
  Counters own;
  // One pass: places that neighbours uncover are within reach of records that are read beyond theirs.
  place_records(cache, *photons_, rays, coarse, {.passes = 1},
                photon_candidates(photons, coarse.paths, seed, kCoarseCandidates), own);
  read(rays, cache);
}

CoarseLevel::CoarseLevel(const RayScene& rays, const IrradianceCache& earlier, const PhotonMap* photons,
                         const RecordOptions& resolved, std::uint64_t seed) {
  RecordOptions coarse = coarse_options(resolved);
  coarse.caustics_apart = earlier.caustics != nullptr;  // as of the records beside it
  if (earlier.quantity == Quantity::all) coarse.paths = Quantity::all;
  coarse.images_apart = true;
  if (photons) photons_ = of_photons(*photons, rays, coarse, seed);
  read(rays, earlier);
  caustics_ = caustic_light(rays, earlier.caustics);
  const EquivalentPhotons equivalent = equivalent_photons(earlier.records, earlier.accuracy);
  noise_.photon_lm = equivalent.photon_lm, zone_photons_ = equivalent.of_a_zone;
  noise_.common = equivalent.common;
  if (photons) noise_.common = photon_noise(*photons, earlier.quantity == Quantity::all).common;
  tell_common_ = photons ? !photons->family.empty() : equivalent.common > 0;
  holds_direct_ = earlier.quantity == Quantity::all;
  lacks_images_ = !holds_direct_;
}

void CoarseLevel::read(const RayScene& rays, const IrradianceCache& cache) {
  tree_ = std::make_unique<RecordTree>(rays.scene().bounds, kReadBeyond * cache.accuracy);
  for (const IrradianceRecord& r : cache.records) tree_->insert(r);
  far_ = std::make_unique<FarRecords>(*tree_);
  usual_lx_ = mean_irradiance_lx(cache.records);
}

void CoarseLevel::add(GlossCache gloss, const RayScene& rays,
                      const std::shared_ptr<const CausticPhotons>& caustics) {
  gloss_ = std::make_unique<GlossCache>(std::move(gloss));
  gloss_caustics_ = caustic_light(rays, caustics);
}

CoarseLevel::CoarseLevel() = default;
CoarseLevel::~CoarseLevel() = default;
CoarseLevel::CoarseLevel(CoarseLevel&&) noexcept = default;

GatherSource CoarseLevel::source() const {
  return {.indirect = tree_.get(),
          .far = far_.get(),
          .fallback = photons_.get(),
          .holds_direct = holds_direct_,
          .lacks_images = lacks_images_,
          .gloss = gloss_.get(),
          .caustics = caustics_.get(),
          .gloss_caustics = gloss_caustics_.get(),
          .photon_lm = noise_.photon_lm,
          .zone_photons = zone_photons_,
          .common = noise_.common,
          .tell_common = tell_common_,
          .usual_lx = usual_lx_};
}
std::size_t CoarseLevel::records() const { return tree_ ? tree_->size() : 0; }

}  // namespace phos::inline place
