#include "splat/picture/gloss.h"

#include <algorithm>

#include "core/error.h"
#include "radiance/gloss_report.h"

namespace phos::inline splat {
namespace {

/// The same light, none in bands that it lacks.
void lengthen(RadianceRecord& r, int order) {
  const auto bands = static_cast<std::size_t>(order), numbers = 3 * bands * bands;
  for (std::vector<float>* v : {&r.light, &r.gradient_x, &r.gradient_y})
    if (!v->empty()) v->resize(numbers);
  r.stderr_light.resize(3 * bands);
}

/// Makes records of fewer bands than some material wants fit to be read by that one.
void fit(RadianceRecord& r, const std::vector<int>& wanted, bool allow_mismatch) {
  const auto next = std::lower_bound(wanted.begin(), wanted.end(), r.order());
  if (next == wanted.end() || *next == r.order()) return;
  if (!allow_mismatch)
    throw Error(ExitCode::mismatch, "",
                text("radiance records of order ", r.order(), ", and lobes need ", *next,
                     ": they were made with other lobes; give the .brdf file that phos-radiance read, rerun "
                     "phos-radiance, or pass --allow-mismatch to cut the lobes"));
  lengthen(r, *next);
}

}  // namespace

PictureGloss gloss_of_picture(const RayScene& rays, SplatCaches& caches, const RenderOptions& render,
                              bool allow_mismatch, Counters& counters) {
  const bool none = caches.radiance.records.empty();
  const GlossBy by = none ? GlossBy::traced : render.gloss;
  const Scene& scene = rays.scene();
  PictureGloss gloss;
  GlossTables tables(scene, caches.brdf, by, {}, counters);
  gloss.report = gloss_report(scene, tables);
  const std::vector<int> wanted = tables.orders();
  if (wanted.empty()) return gloss;
  gloss.projected = caches.brdf.empty();
  gloss.cache.emplace(scene.bounds, *render.gloss_accuracy, std::move(tables),
                      render.leak_test == LeakTest::ray ? &rays : nullptr);
  for (RadianceRecord& r : caches.radiance.records) {
    fit(r, wanted, allow_mismatch);
    gloss.cache->insert(std::move(r));
  }
  caches.radiance.records.clear();
  return gloss;
}

}  // namespace phos::inline splat
