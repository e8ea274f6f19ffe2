// The growing cache of a walk: chosen among the caches, grown as its file says, saved.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/json.h"
#include "core/options.h"
#include "file/container.h"
#include "file/tool.h"
#include "scene/rays.h"
#include "scene/report/light_ways.h"
#include "sense/sensors.h"
#include "stage/irradiance.h"
#include "stage/record_inputs.h"
#include "view/growth/grower.h"

namespace phos::stage {

/// The files of a walk.
struct WalkFiles {
  std::string scene;
  std::vector<std::string> caches;
  std::string photons;  ///< "": none
};
/// Takes the photon map out of the paths, unless nothing else is among them, to be refused where caches are
/// opened. Throws Error(usage) for a second photon map.
void take_photons(std::vector<std::string>& paths, std::string& photons);

struct GrowthCommand {
  std::int64_t records_per_frame = 100;  ///< 0: the cache does not grow
  std::string save;                      ///< "": nowhere
  std::string photons;                   ///< "": none; taken from the caches of the command
  bool allow_mismatch = false;
};

/// New records are made as phos-irradiance --add-to makes them: as the first irradiance cache says, from the
/// photons. Without photons rays read the caches where they land, also where that cache counts photons.
class WalkGrowth {
 public:
  /// `files`: the caches; `drawn`: their records as the page draws them. Throws Error(usage) where no cache
  /// can grow, and the errors of phos-irradiance --add-to. Holds references.
  WalkGrowth(Tool& tool, const WalkFiles& paths, const std::vector<Container>& files, const RayScene& rays,
             const IrradianceCache& drawn, const GrowthCommand& asked);

  /// How the page is to ask.
  Json facts() const;
  /// Starts the thread that makes records.
  void start();
  std::string answer(std::string_view wish) { return grower_->answer(wish); }
  /// Lets these caches, which hold the same files, have the new records too.
  void refresh(SensorCaches& caches);
  /// Ends the thread, and saves, though the program has been interrupted. Nothing where it has not started.
  void finish();

 private:
  std::shared_ptr<GrownCache> make() const;
  void save(const Grown& grown) const;

  Tool& tool_;
  const RayScene& rays_;
  GrowthCommand asked_;
  const std::vector<Container>& files_;
  std::size_t grows_;  // of the files
  Options options_;    // of records, as the cache states them
  IrradianceCommand command_;
  RecordInputs inputs_;
  bool without_photons_ = false;  // though the cache counts them
  std::shared_ptr<const CausticPhotons> caustics_;
  std::vector<LightWay> missed_;
  Quantity quantity_ = Quantity::indirect;
  double accuracy_ = 0, drawn_accuracy_ = 0;
  float beside_m_ = 0;
  std::uint32_t read_serial_ = 0;  // of refresh()
  std::unique_ptr<Grower> grower_;
};

}  // namespace phos::stage
