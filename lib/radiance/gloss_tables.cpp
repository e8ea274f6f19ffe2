#include "radiance/gloss_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/error.h"
#include "core/options.h"
#include "core/text/quantity.h"
#include "radiance/brdf/projection.h"
#include "scene/material/bsdf.h"
#include "scene/material/models.h"
#include "scene/rays.h"

namespace phos::inline radiance {
namespace {

/// Does any place of a material have a vertex colour other than white?
bool coloured(const Scene& scene, std::uint32_t material) {
  if (scene.colour.empty()) return false;
  for (const Instance& instance : scene.instance) {
    if (instance.material != material) continue;
    for (std::uint32_t t = 0; t < instance.triangle_count; ++t)
      for (const std::uint32_t v : scene.triangle[instance.first_triangle + t].v)
        if (Rgb(scene.colour[v]) != Rgb(1)) return true;
  }
  return false;
}

/// Do textures or vertex colours change the lobe from place to place? (What they change of a Lambert part
/// under a coat is left out: it shows at grazing angles alone.)
bool lobe_varies(const Scene& scene, std::uint32_t material) {
  const Material& m = scene.material[material];
  const ModelRow& row = row_of(m);
  if (row.gltf_core && (m.metallic_roughness.used() || (m.anisotropy > 0 && m.anisotropy_map.used())))
    return true;
  return row.base_in_gloss && row.base_in_gloss(m) && (m.base_colour.used() || coloured(scene, material));
}

/// 1/sr: the part that the lobe may take from the Lambert part.
Rgb least_of(const Scene& scene, std::uint32_t material) {
  if (!row_of(scene.material[material]).takes_from_lambert) return Rgb(0);
  return -Bsdf(scene, material).diffuse_reflectance() / kPi;
}

GlossChoice choice_of(const BrdfTable& table) {
  const BrdfSummary s = summarize(table);
  GlossChoice choice{table.material_index, table.order, s.traced_share, ""};
  if (table.order == 0) {
    choice.why = "no order within bounds holds its lobe towards any direction";
    return choice;
  }
  choice.why = s.least_order == s.greatest_order ? text("order ", s.least_order)
                                                 : text("orders ", s.least_order, " to ", s.greatest_order);
  choice.why += text(s.least_order == s.greatest_order ? " leaves" : " leave", " out at most ",
                     percent_to_tenths(s.worst_error),
                     s.traced_share > 0 ? " of the other lobes' energy" : " of a lobe's energy");
  if (!table.note.empty()) choice.why += text("; ", table.note);
  return choice;
}

}  // namespace

void declare_options(Options& options, GlossBy& by) {
  options.choice<GlossBy>(
      "gloss", by, {{"traced", GlossBy::traced}, {"cached", GlossBy::cached}, {"auto", GlossBy::automatic}},
      "method for reflections on glossy surfaces: traced: rays; cached: radiance records, even where they "
      "blur the reflection; auto: radiance records wherever harmonics hold the material's lobe, rays "
      "elsewhere");
}

GlossTables::GlossTables(const Scene& scene, std::span<const BrdfTable> tables, GlossBy by,
                         const BrdfTableOptions& options, Counters& counters)
    : table_of_(scene.material.size(), -1) {
  BrdfTableOptions own = options;
  if (by == GlossBy::cached) own.too_sharp = TooSharp::cut;
  int most = 0;
  for (const std::uint32_t material : glossy_materials(scene)) {
    if (by == GlossBy::traced) {
      choices_.push_back({material, 0, 1, "all gloss is to be traced"});
      continue;
    }
    if (by == GlossBy::automatic && lobe_varies(scene, material)) {
      choices_.push_back({material, 0, 1, "textures or colours change its lobe from place to place"});
      continue;
    }
    const auto given = std::find_if(tables.begin(), tables.end(),
                                    [&](const BrdfTable& t) { return t.material_index == material; });
    const bool serves =
        given != tables.end() && !(by == GlossBy::cached && summarize(*given).traced_share > 0);
    BrdfTable table = serves ? *given : project_brdf(scene, material, own, counters);
    choices_.push_back(choice_of(table));
    if (table.order == 0) continue;
    most = std::max(most, table.order);
    table_of_[material] = static_cast<std::int32_t>(tables_.size());
    tables_.push_back(std::move(table));
    least_.push_back(least_of(scene, material));
  }
  for (int n = 1; n <= most; ++n)
    turns_.emplace_back(n, HshRotation::zero_fill, std::numbers::pi_v<float> / 2);
}

const BrdfTable* GlossTables::table(std::uint32_t material) const {
  if (material >= table_of_.size() || table_of_[material] < 0) return nullptr;
  return &tables_[static_cast<std::size_t>(table_of_[material])];
}

int GlossTables::order(std::uint32_t material) const {
  const BrdfTable* found = table(material);
  return found ? found->order : 0;
}

std::vector<int> GlossTables::orders() const {
  std::set<int> all;
  for (const BrdfTable& t : tables_) all.insert(t.order);
  return {all.begin(), all.end()};
}

bool GlossTables::lobe(const SurfacePoint& point, const Vec3& wo, GlossLobe& lobe) const {
  const BrdfTable* found = table(point.material);
  if (!found || !(glm::dot(wo, point.geometric_normal) > 0)) return false;
  lobe.frame = make_frame(point.smooth_normal);
  lobe.least = least_[static_cast<std::size_t>(table_of_[point.material])];
  const bool level = point.normal == point.smooth_normal;
  const Frame shading{point.tangent, glm::cross(point.normal, point.tangent), point.normal};
  // An isotropic lobe is the same in all frames of its normal.
  const bool turned = !level || !found->isotropic;
  const Vec3 local = (turned ? shading : lobe.frame).to_local(wo);
  if (!(local.z > 0) || !(glm::dot(point.normal, point.smooth_normal) > 0)) return false;
  lobe.order = BrdfLookup(*found).coefficients(local, lobe.coefficients);
  if (lobe.order == 0) return false;
  if (!turned) return true;
  const ZyzAngles angles = rotation_angles(shading, lobe.frame);
  if (level) {
    rotate_about_z(lobe.coefficients, angles.alpha + angles.gamma, 3);
  } else {
    const std::vector<float> own = lobe.coefficients;
    turns_[static_cast<std::size_t>(lobe.order - 1)].rotate(angles, own, lobe.coefficients, 3);
  }
  return true;
}

}  // namespace phos::inline radiance
