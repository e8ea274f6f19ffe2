// The scene at one frame, and the light there.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "estimate/estimator.h"
#include "estimate/registry.h"
#include "photon/photon_map.h"
#include "photon/trace.h"
#include "place/radiance_placement.h"
#include "place/two_level.h"
#include "scene/lamp/luminaires.h"
#include "scene/motion/film.h"
#include "scene/rays.h"
#include "temporal/film/cache.h"
#include "temporal/film/options.h"

namespace phos::inline temporal {

/// A scene at one frame and the rays in it.
struct FrameScene {
  FrameScene(const std::string& path, const SceneOptions& options, const std::string& isa, std::int64_t at)
      : frame(at), scene(load_frame(path, options, at)), rays(scene, {isa}) {}
  std::int64_t frame;
  Scene scene;
  RayScene rays;
};

/// Frames by number, made when they are asked for and kept while they are in use or recent.
class FrameScenes {
 public:
  FrameScenes(std::string path, SceneOptions options, std::string isa)
      : path_(std::move(path)), options_(std::move(options)), isa_(std::move(isa)) {}
  std::shared_ptr<const FrameScene> at(std::int64_t frame);
  std::uint64_t loaded() const { return loaded_; }

 private:
  static constexpr std::size_t kKept = 8;
  std::string path_;
  SceneOptions options_;
  std::string isa_;
  std::vector<std::shared_ptr<const FrameScene>> recent_;  // the last used, the newest last
  std::uint64_t loaded_ = 0;
};

/// What light is computed with, at every frame alike.
struct LightOptions {
  RecordOptions records;     ///< resolved
  RadianceOptions radiance;  ///< resolved
  PhotonOptions photons;
  std::uint64_t seed = 0;
};

/// Everything that estimates light at one frame. The same random numbers at every frame: photons of the same
/// paths and rays of the same records differ by the changes of the scene.
class FrameLight {
 public:
  /// `source`: indirect light where gathered rays land, over time; null: photons of this very frame. Holds
  /// references to `options` and `source`.
  FrameLight(std::shared_ptr<const FrameScene> frame, const LightOptions& options, const Film* source);
  ~FrameLight();

  std::int64_t frame() const { return at_->frame; }
  const FrameScene& at() const { return *at_; }
  std::uint64_t seed() const { return options_.seed; }
  const Scene& scene() const { return at_->scene; }
  const RayScene& rays() const { return at_->rays; }
  const Luminaires& lights() const { return lights_; }
  /// Traced when first asked for. Numerical events go to `counters`.
  const PhotonMap& photons(Counters& counters);
  /// Of irradiance records; made when first asked for.
  const Estimator& irradiance(Counters& counters);
  /// Of the coarse records that gathered rays read (two_level.h), from photons.
  const Estimator& source_records(Counters& counters);
  /// Of radiance records of an order.
  const Estimator& radiance(int order, Counters& counters);

 private:
  EstimatorParts parts(const RecordOptions& records, Counters& counters);
  const CoarseLevel& coarse(const RecordOptions& records, Counters& counters);
  std::shared_ptr<const FrameScene> at_;
  const LightOptions& options_;
  const Film* source_;
  Luminaires lights_;
  std::unique_ptr<PhotonMap> photons_;
  std::unique_ptr<CoarseLevel> coarse_;
  std::unique_ptr<Estimator> irradiance_, radiance_, source_records_;
  int radiance_order_ = 0;
};

}  // namespace phos::inline temporal
