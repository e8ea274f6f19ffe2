#include "reference/method.h"

#include <algorithm>

#include "core/error.h"
#include "reference/map/final_gather.h"
#include "reference/map/photon_view.h"
#include "scene/material/sharp_materials.h"
#include "scene/report/unsampled.h"

namespace phos::inline reference {
namespace {

template <class Light>
std::unique_ptr<MapLight> make_light(const MapScene& scene, const MapOptions& options) {
  return std::make_unique<Light>(scene, options);
}

constexpr ReferenceMethodRow kMethods[] = {
    {.method = ReferenceMethod::automatic,
     .name = "auto",
     .summary = "bidirectional where the scene has mirrors, smooth glass or sharp gloss, else path"},
    {.method = ReferenceMethod::path,
     .name = "path",
     .summary = "from the eye alone, which does not find what comes from small lamps by mirrors and glass"},
    {.method = ReferenceMethod::bidirectional,
     .name = "bidirectional",
     .summary = "from eye and lamps",
     .shares_samples = false},
    {.method = ReferenceMethod::final_gather,
     .name = "final-gather",
     .summary =
         "at every pixel shadow rays, caustic photons, and rays that are lit by photons where they land",
     .map_light = make_light<FinalGather>,
     .error_of =
         "that of gathering and of caustic photons: it holds neither the noise of the photons where rays "
         "land nor the blur of discs"},
    {.method = ReferenceMethod::photons,
     .name = "photons",
     .summary = "the light of the photons about each visible point",
     .map_light = make_light<PhotonView>,
     .error_of = "that of the number of photons: it does not hold the blur of discs",
     .error_by_samples = false,
     .gloss_by_photons = true},
};

}  // namespace

std::span<const ReferenceMethodRow> reference_methods() { return kMethods; }

const ReferenceMethodRow& row_of(ReferenceMethod method) {
  const auto* found = std::find_if(std::begin(kMethods), std::end(kMethods),
                                   [&](const ReferenceMethodRow& row) { return row.method == method; });
  PHOS_CHECK(found != std::end(kMethods), "method ", static_cast<int>(method));
  return *found;
}

void declare_method(Options& options, ReferenceMethod& method, const std::string& help, MethodChoice choice) {
  Names<ReferenceMethod> names;
  std::string all = help;
  for (const ReferenceMethodRow& row : kMethods) {
    if (choice == MethodChoice::without_map && row.reads_map()) continue;
    names.emplace_back(row.name, row.method);
    if (choice == MethodChoice::all) all += text(all.empty() ? "" : "; ", row.name, ": ", row.summary);
  }
  options.choice<ReferenceMethod>("method", method, names, all);
}

bool is_bidirectional(ReferenceMethod method, const Scene& scene, const std::vector<LightWay>& ways,
                      double samples) {
  if (method != ReferenceMethod::automatic) return method == ReferenceMethod::bidirectional;
  return (!scene.light.empty() && gathers_light(scene)) ||
         !unsampled(ways, Sampler::path_tracing, samples).empty();
}

}  // namespace phos::inline reference
