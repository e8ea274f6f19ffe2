// How records are made: the options of every way of estimating irradiance.
#pragma once

#include <cstdint>
#include <optional>

#include "core/options.h"
#include "estimate/zone/gradients.h"
#include "photon/density.h"
#include "record/header.h"

namespace phos::inline estimate {

struct RecordOptions;
/// Do its records count photons, and nothing else? They are then of places where photons land.
bool of_photons_alone(const RecordOptions& records);
enum class Estimate {
  hull,    ///< photons over the area of their convex hull (docs/methods.md#c1, #c2)
  kernel,  ///< photons over a disc, or weighted by a kernel: the classical comparison (docs/methods.md#c4)
  gather,  ///< stratified cosine-weighted rays, each lit where it lands
  raster,  ///< the scene drawn on one plane over the place (docs/methods.md#r1)
};
/// The zone that a record serves (Ribardiere et al. 2011 compare the last three).
enum class Footprint {
  circle,           ///< a disc; radius by RecordOptions::radius, gradient and neighbours (docs/methods.md#a7)
  circle_min,       ///< the same by the least distance (their MDIC)
  circle_harmonic,  ///< by the harmonic mean, and shrunk where records about it say otherwise (HMDIC:
                    ///< adaptive caching, Krivanek et al. 2006)
  adaptive,         ///< eight axes, each as long as surroundings and light allow (ARIC)
};
enum class RadiusRule {  ///< docs/methods.md#a7
  harmonic,              ///< harmonic mean distance of the surroundings
  light,                 ///< the same, and no more than the harmonic mean distance that the light comes from
  least,                 ///< least distance of the surroundings
};
enum class LeakTest {
  none,
  ray,  ///< a record serves a point only if the two can see each other
};
enum class GatherFrom {
  cache,    ///< a coarse cache, made from the photons first (two-level caching)
  photons,  ///< the photons about each hit: no coarse cache, ten times the work
};
enum class RasterBorder {
  none,      ///< directions beyond the plane are dark
  coverage,  ///< divided by the share of the hemisphere that the plane covers (Larsen and Christensen 2004)
  stretch,   ///< border pixels stand for directions beyond them (docs/methods.md#r1)
};

/// How diffuse places that pixels show are lit by the lamps.
enum class RasterLight : std::uint8_t {
  traced,      ///< samples of the lamps, each with a shadow ray
  shadow_map,  ///< from places on the lamps, by the scene's depth as drawn from there (docs/methods.md#r3)
};

/// How far surroundings are where light and cameras are at work (place/typical_distance.h), m.
struct TypicalDistance {
  float least_m, most_m;  ///< of several ways to say where that is
  TypicalDistance(float least, float most) : least_m(least), most_m(most) {}
  TypicalDistance(float only) : least_m(only), most_m(only) {}
};

struct RecordOptions {
  Estimate estimate = Estimate::hull;
  double accuracy = 0.2;                                 ///< a: zone of influence = a x radius
  std::optional<double> min_radius_m{}, max_radius_m{};  ///< empty: resolve() sets them
  Quantity paths = Quantity::indirect;
  GradientMode gradients = GradientMode::automatic;
  RadiusRule radius = RadiusRule::harmonic;  ///< of gather and raster
  LeakTest leak_test = LeakTest::none;
  Footprint footprint = Footprint::circle;
  double rho = 0.05;  ///< relative error along an adaptive footprint's axes (docs/methods.md#e6)
  // Photons.
  Kernel kernel = Kernel::disc;
  std::int64_t hemisphere_rings = 8;
  std::int64_t near_photons = 128;                     ///< k of the first query
  std::int64_t min_photons = 100, max_photons = 1000;  ///< aimed at in a zone
  std::int64_t distance_rays = 32;                     ///< 0: distances from photons alone
  std::int64_t probes = 128;
  // Rays.
  std::int64_t rays = 512;        ///< of a hemisphere, at most
  std::optional<double> error{};  ///< relative standard error at which rays are enough; empty: all are sent
  std::int64_t gather_bounces =
      -1;  ///< between the lamp and the record: 1 = surfaces lit by lamps alone; negative: all
  GatherFrom gather_from = GatherFrom::cache;
  double source_accuracy = 0.4;                 ///< a of the coarse cache
  std::optional<double> source_max_radius_m{};  ///< resolve() sets it: max_radius_m, at most a quarter
                                                ///< of the typical distance
  std::int64_t source_photons = 100;            ///< that a zone of the coarse cache should hold at least
  std::int64_t light_samples = 64;              ///< with paths = all: shadow rays to each area light
  std::int64_t raster_side = 64;                ///< pixels of the plane, each way
  RasterBorder raster_border = RasterBorder::stretch;
  /// Light that comes from lamps by mirrors and glass alone is not in the records: neither caustic photons
  /// nor lamps that rays from the record meet after mirrors and glass count (docs/methods.md#g7-5). No
  /// option: so where caustic photons travel with the cache, to be read at each point
  /// (estimate/caustic_light.h).
  bool caustics_apart = false;
  /// Light of lamps' images in flat mirrors, which is direct light (scene/mirror/images.h), is not in records
  /// of indirect light. No option: false only for records that gathered rays read where they land.
  bool images_apart = true;
  RasterLight raster_light = RasterLight::traced;

  /// Fills in absent radii: from a 25th of the least typical distance (1/4 m unless it is positive and
  /// finite) to the whole greatest distance (half for footprints that follow surroundings, because
  /// they do not know which surfaces come into sight beside them),
  /// the estimator's own gradients, and the rule of the radius that a footprint stands for. Throws
  /// Error(usage) if the smaller radius exceeds the larger, or if the estimator has no such gradients or
  /// footprint.
  void resolve(TypicalDistance typical);
};

/// All estimates but --estimate raster.
void declare_options(Options& options, RecordOptions& records);
void declare_raster_options(Options& options, RecordOptions& records,
                            const InFiles& in_files = Adopted::estimate);
/// --footprint, --rho and --direct (another name of --paths).
void declare_footprint_options(Options& options, RecordOptions& records);
/// --footprint and --rho of records that hold no direct light, discs or adaptive.
void declare_radiance_footprint_options(Options& options, RecordOptions& records);
// Some of them, for tools that read no others: the reach of a record, the zones of photons, and rays with the
// light that they read where they land.
void declare_reach_options(Options& options, RecordOptions& records);
void declare_photon_options(Options& options, RecordOptions& records);
void declare_gather_options(Options& options, RecordOptions& records);

}  // namespace phos::inline estimate
