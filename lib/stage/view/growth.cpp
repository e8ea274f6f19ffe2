#include "stage/view/growth.h"

#include <algorithm>
#include <utility>

#include "core/interrupt.h"
#include "estimate/record_ways.h"
#include "file/adoption.h"
#include "photon/caustic_map.h"
#include "place/points_on_surfaces.h"
#include "place/typical_distance.h"
#include "splat/caches.h"
#include "stage/chosen_estimator.h"
#include "temporal/film/file.h"
#include "view/limits.h"

namespace phos::stage {
namespace {

bool holds_photons(const std::string& path) {
  return is_container(path) && Container::open(path).kind() == FileKind::photons;
}

bool is_lobes(const Container& file) { return file.kind() == FileKind::brdf; }

std::size_t growing_among(const std::vector<Container>& files) {
  const auto found = std::find_if(files.begin(), files.end(), [](const Container& file) {
    return file.kind() == FileKind::irradiance && !is_film(file);
  });
  if (found != files.end()) return static_cast<std::size_t>(found - files.begin());
  throw Error(ExitCode::usage, "CACHE",
              "films and radiance caches do not grow; give an irradiance cache of one time too");
}

/// What an estimator is made from, and the cache that it makes records for.
struct Workshop {
  Workshop(const RayScene& rays, const RecordInputs& inputs, const RecordOptions& resolved,
           std::uint64_t seed, const IrradianceCache& covering, float beside_m)
      : estimator(rays, inputs, resolved, seed), cache(covering, *estimator, rays, resolved, beside_m) {}
  ChosenEstimator estimator;
  GrownCache cache;
};

}  // namespace

void take_photons(std::vector<std::string>& paths, std::string& photons) {
  std::vector<std::string> rest;
  for (const std::string& path : paths) {
    if (!holds_photons(path)) {
      rest.push_back(path);
      continue;
    }
    if (!photons.empty())
      throw Error(ExitCode::usage, path, text("is a second photon map beside ", photons, "; give one"));
    photons = path;
  }
  if (rest.empty())
    photons.clear();
  else
    paths = rest;
}

WalkGrowth::WalkGrowth(Tool& tool, const WalkFiles& paths, const std::vector<Container>& files,
                       const RayScene& rays, const IrradianceCache& drawn, const GrowthCommand& asked)
    : tool_(tool),
      rays_(rays),
      asked_(asked),
      files_(files),
      grows_(growing_among(files)),
      options_("phos-irradiance", "", ""),
      drawn_accuracy_(drawn.accuracy) {
  const Scene& scene = rays.scene();
  RecordOptions& records = command_.records;
  const std::string& path = paths.caches[grows_];
  const Container& file = files[grows_];
  RecordFiles from{paths.scene, paths.photons, paths.photons.empty() ? path : "", "", ""};
  if (file.provenance().inputs.contains("gloss"))
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (is_radiance(files[i]) && from.radiance.empty()) from.radiance = paths.caches[i];
      if (is_lobes(files[i])) from.brdf = paths.caches[i];
    }
  const Container earlier = open_to_add(path, FileKind::irradiance, from, scene, asked.allow_mismatch);
  declare_options(options_, records);
  declare_raster_options(options_, records);
  declare_footprint_options(options_, records);
  adopt_estimate(options_, earlier);
  if (records.footprint == Footprint::adaptive || records.estimate == Estimate::raster)
    throw Error(ExitCode::usage, path,
                text("does not grow, as it was made with ",
                     records.footprint == Footprint::adaptive ? "--footprint adaptive" : "--estimate raster",
                     "; give a cache of photons or of gathered rays, with circular footprints"));
  if (paths.photons.empty() && of_photons_alone(records)) {
    records.estimate = Estimate::gather, records.gradients = GradientMode::automatic;
    without_photons_ = true;
  }
  inputs_ = open_record_inputs(from, scene, asked.allow_mismatch);
  const IrradianceCache cache = read_irradiance(earlier);
  quantity_ = cache.quantity, accuracy_ = cache.accuracy;
  caustics_ = caustics_of_run(inputs_, scene, &cache, path);
  records.caustics_apart = caustics_ != nullptr;
  PlacementOptions anywhere;
  anywhere.place = Place::given;
  const TypicalDistance typical = typical_distance(
      rays, anywhere, {inputs_.photons ? &*inputs_.photons : nullptr, false, {}, tool.seed()});
  records.resolve(typical);
  beside_m_ = kOnSurface * typical.least_m;
  if (asked.save.empty()) return;
  missed_ = tell_unsampled_kept(tool, path, unsampled_in(earlier.provenance()),
                                tell_missed_ways(tool, rays, records));
  tool.set_variant("of a walk");
  tool.add_input("irradiance", path);
  if (!from.photons.empty()) tool.add_input("photons", from.photons);
  if (!from.source.empty()) tool.add_input("source", from.source);
  if (!from.radiance.empty()) tool.add_input("gloss", from.radiance);
}

Json WalkGrowth::facts() const {
  Json facts = Json::Object{};
  facts["records_per_frame"] = asked_.records_per_frame;
  facts["accuracy"] = drawn_accuracy_;
  facts["least_share"] = kLeastShareAsked;
  facts["save"] = !asked_.save.empty();
  return facts;
}

std::shared_ptr<GrownCache> WalkGrowth::make() const {
  IrradianceCache covering = read_caches({files_[grows_]}, rays_.scene()).irradiance;
  std::vector<Container> others = files_;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(grows_));
  std::erase_if(others, is_lobes);
  if (!others.empty()) append(covering, read_caches(others, rays_.scene()).irradiance);
  const auto made =
      std::make_shared<Workshop>(rays_, inputs_, command_.records, tool_.seed(), covering, beside_m_);
  return {made, &made->cache};
}

void WalkGrowth::start() {
  if (without_photons_)
    tool_.say("new records are gathered by rays, which read the caches, because no photons are given");
  GrowerParts parts;
  parts.scene = rays_.scene().bounds;
  parts.most_points = static_cast<std::size_t>(asked_.records_per_frame);
  parts.reach = accuracy_ / drawn_accuracy_;
  parts.make = [this] { return make(); };
  if (!asked_.save.empty()) parts.save = [this](const Grown& grown) { save(grown); };
  parts.warn = [this](const std::string& line) { tool_.warn(line); };
  grower_ = std::make_unique<Grower>(std::move(parts));
}

void WalkGrowth::refresh(SensorCaches& caches) {
  const std::uint32_t serial = grower_->serial();
  if (serial == read_serial_) return;
  IrradianceCache grown{grower_->grown().records, accuracy_, rays_.scene().hash, quantity_, caustics_};
  if (read_serial_ == 0)
    caches.add(grown, "the new records");
  else
    caches.replace_last(grown, "the new records");
  read_serial_ = serial;
}

void WalkGrowth::finish() {
  if (!grower_) return;
  grower_->stop();
  const Grown grown = grower_->grown();
  tool_.counters().merge(grown.counters);
  tool_.stat("records_new", grown.records.size());
  if (asked_.save.empty()) return;
  take_interrupt();
  save(grown);
}

void WalkGrowth::save(const Grown& grown) const {
  IrradianceCache cache = read_irradiance(files_[grows_]);
  cache.records.insert(cache.records.end(), grown.records.begin(), grown.records.end());
  cache.scene_hash = rays_.scene().hash;
  cache.caustics = caustics_;
  Provenance own = tool_.provenance(FileKind::irradiance, rays_.scene().hash, rays_.scene().parts);
  const Json estimate = options_.recorded();
  for (const auto& [name, value] : estimate.as_object()) own.parameters[name] = value;
  own.counters = grown.counters;
  note_unsampled(own, missed_);
  write_irradiance(asked_.save, cache, own);
  tool_.say(
      text(asked_.save, ": ", cache.records.size(), " records, ", grown.records.size(), " of them new"));
}

}  // namespace phos::stage
