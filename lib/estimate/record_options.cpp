#include "estimate/record_options.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.h"

namespace phos::inline estimate {
namespace {

const Names<Estimate> kEstimates{{"hull", Estimate::hull},
                                 {"kernel", Estimate::kernel},
                                 {"gather", Estimate::gather},
                                 {"raster", Estimate::raster}};
const Names<Quantity> kQuantities{{name_of(Quantity::indirect), Quantity::indirect},
                                  {name_of(Quantity::all), Quantity::all}};
const Names<GradientMode> kGradients{{"auto", GradientMode::automatic},
                                     {"analytic", GradientMode::analytic},
                                     {"hybrid", GradientMode::hybrid},
                                     {"ward-heckbert", GradientMode::ward_heckbert},
                                     {"krivanek", GradientMode::krivanek},
                                     {"hemisphere", GradientMode::hemisphere},
                                     {"positional", GradientMode::positional},
                                     {"blend", GradientMode::blend},
                                     {"none", GradientMode::none}};
const Names<RadiusRule> kRadii{
    {"harmonic", RadiusRule::harmonic}, {"light", RadiusRule::light}, {"least", RadiusRule::least}};
const Names<Footprint> kFootprints{{"circle", Footprint::circle},
                                   {"circle-min", Footprint::circle_min},
                                   {"circle-harmonic", Footprint::circle_harmonic},
                                   {"adaptive", Footprint::adaptive}};
const Names<LeakTest> kLeakTests{{"none", LeakTest::none}, {"ray", LeakTest::ray}};
const Names<Kernel> kKernels{
    {"disc", Kernel::disc}, {"epanechnikov", Kernel::epanechnikov}, {"cone", Kernel::cone}};
const Names<GatherFrom> kSources{{"cache", GatherFrom::cache}, {"photons", GatherFrom::photons}};
const Names<RasterBorder> kBorders{
    {"none", RasterBorder::none}, {"coverage", RasterBorder::coverage}, {"stretch", RasterBorder::stretch}};
const Names<RasterLight> kRasterLights{{"traced", RasterLight::traced},
                                       {"shadow-map", RasterLight::shadow_map}};

}  // namespace

const char* name_of(GradientMode mode) { return name_in(kGradients, mode).c_str(); }

bool of_photons_alone(const RecordOptions& records) {
  return records.estimate == Estimate::hull || records.estimate == Estimate::kernel;
}

void RecordOptions::resolve(TypicalDistance typical) {
  const auto known = [](float m) { return m > 0 && std::isfinite(m) ? static_cast<double>(m) : 0.25; };
  const double least = known(typical.least_m), most = known(typical.most_m);
  if (!min_radius_m) min_radius_m = std::min(least / 25, max_radius_m.value_or(HUGE_VAL));
  if (!max_radius_m)
    max_radius_m = std::max(most / (footprint == Footprint::adaptive ? 2 : 1), *min_radius_m);
  if (*min_radius_m > *max_radius_m) {
    throw Error(
        ExitCode::usage, "--min-radius",
        text(*min_radius_m, " m is more than --max-radius ", *max_radius_m, " m; give a smaller value"));
  }
  source_max_radius_m = std::min(*max_radius_m, std::max(most / 4, *min_radius_m));
  if (gather_bounces == 0) {
    throw Error(ExitCode::usage, "--gather-bounces",
                "0 leaves no indirect light; give 1 for surfaces lit by lamps alone, or -1 for all");
  }
  if (footprint != Footprint::circle && estimate != Estimate::gather)
    throw Error(ExitCode::usage, "--footprint",
                text(name_in(kFootprints, footprint), " needs gathered rays; give --estimate gather"));
  if (footprint == Footprint::circle_min) radius = RadiusRule::least;
  if (footprint == Footprint::circle_harmonic) radius = RadiusRule::harmonic;
  using G = GradientMode;
  const bool photons = of_photons_alone(*this);
  const std::vector<G> allowed =
      photons ? std::vector<G>{G::analytic, G::hemisphere, G::positional, G::blend, G::none}
      : estimate == Estimate::gather
          ? std::vector<G>{G::hybrid, G::analytic, G::ward_heckbert, G::krivanek, G::none}
          : std::vector<G>{G::analytic, G::none};
  if (gradients == G::automatic) gradients = allowed.front();
  if (std::find(allowed.begin(), allowed.end(), gradients) != allowed.end()) return;
  std::string names;
  for (const G g : allowed) names += text(names.empty() ? "" : ", ", name_of(g));
  throw Error(ExitCode::usage, "--gradients",
              text(name_of(gradients), " is not available with --estimate ", name_in(kEstimates, estimate),
                   "; give one of ", names));
}

void declare_reach_options(Options& options, RecordOptions& r) {
  options.number("accuracy", r.accuracy, "A",
                 "error allowed in interpolation: a record serves points within A times its radius; smaller: "
                 "more records",
                 {1e-3, 1, false}, Adopted::estimate);
  options.number("min-radius", r.min_radius_m, "METRES",
                 "smallest radius of a record (default: a 25th of the typical distance, which is the median, "
                 "over lit or seen places, of the harmonic mean distance to the surroundings)",
                 kPositive, Adopted::estimate);
  options.number(
      "max-radius", r.max_radius_m, "METRES",
      "largest radius of a record (default: the typical distance, or half the typical distance with "
      "--footprint adaptive); coarse records that rays read have at most a quarter of the typical distance",
      kPositive, Adopted::estimate);
  options.choice<LeakTest>("leak-test", r.leak_test, kLeakTests,
                           "ray: a record serves a point only if the two see each other, so that no light "
                           "leaks through thin walls; none: no test",
                           Adopted::estimate);
}

void declare_photon_options(Options& options, RecordOptions& r) {
  options.integer("near-photons", r.near_photons, "N",
                  "number of photons in the first query, which tells the distance to the surroundings",
                  {8, 4096}, Adopted::estimate);
  options.integer("min-photons", r.min_photons, "N",
                  "least number of photons in the zone of a record, as far as the surroundings allow; no two "
                  "records are closer to each other than half such a zone",
                  {1, 1e6}, Adopted::estimate);
  options.integer("max-photons", r.max_photons, "N", "largest number of photons in the zone of a record",
                  {16, 1e7}, Adopted::estimate);
  options.integer("distance-rays", r.distance_rays, "N",
                  "number of rays that look for dark surroundings, which hold no photons; 0: photons alone "
                  "tell the distance",
                  {0, 4096}, Adopted::estimate);
  options.integer(
      "probes", r.probes, "N",
      "number of short rays that look for the surface where a zone is in doubt, as at borders and in corners",
      {16, 65536}, Adopted::estimate);
}

void declare_gather_options(Options& options, RecordOptions& r) {
  options.integer(
      "rays", r.rays, "N",
      "number of rays over the hemisphere of a record, rounded down to whole rings (12, 27, 52, 80, ...)",
      {12, 1048576}, Adopted::estimate);
  options.integer(
      "gather-bounces", r.gather_bounces, "N",
      "reflections between lamp and record: 1: surfaces lit by lamps alone; -1: all; 0 is refused", {-1, 1},
      Adopted::estimate);
  options.choice<GatherFrom>(
      "gather-from", r.gather_from, kSources,
      "source of the indirect light where rays land: cache: a coarse cache, made from the photons first; "
      "photons: the photons there (ten times the work). A cache among the inputs is read instead. A ray that "
      "lands nearer than half a zone's radius is followed by another from there, unless lamps without area "
      "meet mirrors or glass",
      Adopted::estimate);
  options.number("source-accuracy", r.source_accuracy, "A", "--accuracy of the coarse cache",
                 {1e-3, 1, false}, Adopted::estimate);
  options.integer("source-photons", r.source_photons, "N",
                  "least number of photons in the zone of a record of the coarse cache", {16, 1e6},
                  Adopted::estimate);
  options.choice<RadiusRule>("radius", r.radius, kRadii,
                             "distance that gives the radius of a record: harmonic: the harmonic mean "
                             "distance to the surroundings; light: the same, or the harmonic mean distance "
                             "to the origin of the light where that is shorter; least: the least distance",
                             Adopted::estimate);
}

void declare_options(Options& options, RecordOptions& r) {
  options.section("Records");
  options.choice<Estimate>(
      "estimate", r.estimate, kEstimates,
      "method: hull: photons over their convex hull; kernel: photons under a kernel; gather: rays over the "
      "hemisphere, lit where they land; raster: the scene drawn on a plane above the record",
      Adopted::estimate);
  declare_reach_options(options, r);
  options.choice<Quantity>(
      "paths", r.paths, kQuantities,
      "light that the records hold: indirect: no light straight from a lamp; all: that light too",
      Adopted::estimate);
  options.choice<GradientMode>(
      "gradients", r.gradients, kGradients,
      "method for the change of light about a record: with --estimate hull or kernel analytic (auto), "
      "hemisphere, positional, blend, none; with gather hybrid (auto), analytic, ward-heckbert, krivanek, "
      "none; with raster analytic (auto), none",
      Adopted::estimate);
  options.section("Estimates from photons");
  options.choice<Kernel>("kernel", r.kernel, kKernels, "kernel of --estimate kernel", Adopted::estimate);
  options.integer("hemisphere-rings", r.hemisphere_rings, "N",
                  "with --gradients hemisphere: rings of the discretised hemisphere", {1, 64},
                  Adopted::estimate);
  declare_photon_options(options, r);
  options.section("Estimates from rays");
  declare_gather_options(options, r);
  options.number(
      "error", r.error, "E",
      "relative standard error at which a record takes no more rays (default: every record takes all --rays)",
      kPositive, Adopted::estimate);
  options.integer("light-samples", r.light_samples, "N",
                  "with --paths all: shadow rays from a record to each area light", {1, 65536},
                  Adopted::estimate);
}

namespace {

void declare_zones(Options& options, RecordOptions& r, const Names<Footprint>& footprints,
                   const std::string& footprint, const std::string& axes) {
  options.section("Zones of records");
  options.choice<Footprint>(
      "footprint", r.footprint, footprints,
      "zone that a record serves: circle: a disc. With --estimate gather also " + footprint,
      {Recorded::unless_default, Adopted::estimate});
  options.number("rho", r.rho, "R",
                 "with --footprint adaptive: relative error of light along an axis, which is " + axes,
                 {1e-3, 1, false}, {Recorded::unless_default, Adopted::estimate});
}

}  // namespace

void declare_footprint_options(Options& options, RecordOptions& r) {
  declare_zones(
      options, r, kFootprints,
      "circle-min: a disc by the least distance; circle-harmonic: a disc by the harmonic mean "
      "distance, which shrinks where neighbouring records disagree; adaptive: eight axes, each with "
      "its length and its change of light (half the records, each at more cost)",
      "halved until the error is met; give at most 0.05 where direct light is cached, or shadows are "
      "missed");
  options.choice<Quantity>(
      "direct", r.paths, {{"traced", Quantity::indirect}, {"cached", Quantity::all}},
      "light straight from the lamps: traced: by shadow rays from each seen point; cached: in the records, "
      "the same as --paths all (pays for many or large lamps, with --footprint adaptive)",
      Recorded::no);
  options.another_name("direct", "paths");
}

void declare_radiance_footprint_options(Options& options, RecordOptions& r) {
  declare_zones(options, r, {{"circle", Footprint::circle}, {"adaptive", Footprint::adaptive}},
                "adaptive: eight axes, each with its length", "shortened until the error is met");
}

void declare_raster_options(Options& options, RecordOptions& r, const InFiles& in_files) {
  options.integer("raster-side", r.raster_side, "PIXELS",
                  "with --estimate raster: side of the plane on which the scene is drawn", {8, 1024},
                  in_files);
  options.choice<RasterBorder>("raster-border", r.raster_border, kBorders,
                               "with --estimate raster: light of directions beyond the plane: none: no "
                               "light; coverage: the mean of the plane; stretch: its border pixels",
                               in_files);
  options.choice<RasterLight>(
      "raster-light", r.raster_light, kRasterLights,
      "with --estimate raster: method that lights the seen places from the lamps: traced: by shadow rays; "
      "shadow-map: by shadow maps, drawn once for all records, of 16 places on each lamp with an area and "
      "the sky (without noise; sharp detail of shadows is lost; diffuse places alone)",
      {Recorded::unless_default, in_files.adopted});
}

}  // namespace phos::inline estimate
