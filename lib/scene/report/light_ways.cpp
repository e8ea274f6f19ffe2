#include "scene/report/light_ways.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "scene/lamp/probe.h"
#include "scene/material/bsdf.h"
#include "scene/material/models.h"
#include "scene/material/passage.h"
#include "scene/material/sharp_materials.h"
#include "scene/mirror/images.h"

namespace phos::inline scene {
namespace {

constexpr std::size_t kChunk = 64;
constexpr std::uint32_t kRaysOfAll = 1u << 17;
constexpr std::size_t kMostEvents = 12;
/// Lines of one lamp ray, with all rays that follow.
constexpr std::uint32_t kMostTurns = 4096;
/// Share of a ray's first light: less than that is not followed.
constexpr double kLeastLeft = 1e-4;
/// Vertex normals of a plane facet lie as near as that to its own (cosine): 2 mrad.
constexpr float kPlane = 1 - 2e-6f;
constexpr std::size_t kKinds = 3;
/// Materials that send less than this part of a way are not named with it.
constexpr double kLeastNamed = 0.05;

double grey(const Rgb& light) { return static_cast<double>(luminance(light)); }

/// What a material did to light on a way; the order is that in which they are told.
struct Deed {
  enum class What : std::uint8_t { mirror, pane, glass, curved_mirror, curved_glass, gloss } what;
  std::uint32_t material = 0;
  bool bends = false;
  auto operator<=>(const Deed&) const = default;
};

const char* noun(Deed::What what) {
  constexpr const char* kNouns[] = {"mirror", "pane", "glass", "curved mirror", "curved glass", "gloss of"};
  return kNouns[static_cast<int>(what)];
}

/// Light on its way by mirrors, glass and sharp gloss alone.
struct Flight {
  Ray ray;
  double flux_lm = 0, way_m = 0;
  ProbeRay lamp;
  std::array<Deed, kMostEvents> deed{};
  std::size_t events = 0;
  // So far over flat mirrors in which the lamp has an image: direct light finds that.
  bool images = false;
  std::int32_t chain = MirrorPlanes::kNone;

  LightWay::Kind kind() const {
    const auto bends = [](const Deed& d) { return d.bends; };
    if (deed[0].what == Deed::What::gloss) return LightWay::Kind::gloss;
    const bool bent = std::any_of(deed.begin(), deed.begin() + static_cast<std::ptrdiff_t>(events), bends);
    return bent ? LightWay::Kind::bent : LightWay::Kind::mirrored;
  }
};

/// What lamp rays tell of one kind of way.
struct Tally {
  double flux_lm = 0, over_hit_share = 0;
  std::map<Deed, double> by;

  void merge(const Tally& other) {
    flux_lm += other.flux_lm, over_hit_share += other.over_hit_share;
    for (const auto& [deed, lm] : other.by) by[deed] += lm;
  }
};

struct Found {
  double started_lm = 0;
  std::array<Tally, kKinds> of;
};

class Finder {
 public:
  Finder(const RayScene& rays, const Luminaires& luminaires, bool images)
      : rays_(rays),
        scene_(rays.scene()),
        mirrors_(luminaires.mirrors()),
        count_images_(images),
        lamp_rays_(scene_, luminaires) {
    for (const Material& m : scene_.material) lobe_.push_back(lobe_hit_share(scene_, m));
  }

  Found find(const Lamp& lamp, std::uint32_t count) const {
    const bool beyond = scene_.light[lamp.light].kind == Light::Kind::environment ||
                        scene_.light[lamp.light].kind == Light::Kind::directional;
    return parallel_reduce<Found>(
        count, kChunk, {},
        [&](std::size_t begin, std::size_t end) {
          Found part;
          for (std::size_t i = begin; i < end; ++i)
            follow_all(lamp, static_cast<std::uint32_t>(i), beyond, part);
          return part;
        },
        [](Found& sum, const Found& part) {
          sum.started_lm += part.started_lm;
          for (std::size_t k = 0; k < kKinds; ++k) sum.of[k].merge(part.of[k]);
        });
  }

 private:
  bool plane(const SurfacePoint& point) const {
    if (scene_.material[point.material].normal.used()) return false;
    const Vec3 n = geometric_normal(scene_, point.triangle);
    const auto& v = scene_.triangle[point.triangle].v;
    return std::all_of(std::begin(v), std::end(v),
                       [&](std::uint32_t i) { return std::fabs(glm::dot(scene_.normal[i], n)) >= kPlane; });
  }

  /// Light arrives at a surface that scatters it, or takes it.
  void land(const Flight& flight, const SurfacePoint& point, Found& found) const {
    if (flight.images && !count_images_) return;
    const double cosine =
        std::fabs(static_cast<double>(glm::dot(point.geometric_normal, flight.ray.direction)));
    const double way_m = flight.way_m + static_cast<double>(point.distance_m);
    double seen_sr = flight.lamp.seen_sr;
    if (flight.lamp.seen_m2 > 0) seen_sr = flight.lamp.seen_m2 / std::max(way_m * way_m, 1e-300);
    const LightWay::Kind kind = flight.kind();
    // A lobe that the lamp lights first is seen lit from as many directions as it has.
    const double lobe = kind == LightWay::Kind::gloss ? lobe_[flight.deed[0].material] : 0;
    const double hit = std::min(1.0, std::max(seen_sr * cosine / std::numbers::pi, lobe));
    Tally& tally = found.of[static_cast<std::size_t>(kind)];
    tally.flux_lm += flight.flux_lm;
    tally.over_hit_share += flight.flux_lm / hit;  // infinite where nothing can hit it
    for (std::size_t e = 0; e < flight.events; ++e) {
      // Named once, however often light comes to it.
      const auto* const end = flight.deed.data() + e;
      if (std::find(flight.deed.data(), end, flight.deed[e]) == end)
        tally.by[flight.deed[e]] += flight.flux_lm;
    }
  }

  void follow_all(const Lamp& lamp, std::uint32_t number, bool beyond, Found& found) const {
    RandomStream random = LampProbe::stream(lamp, number);
    const ProbeRay start = lamp_rays_.sample(lamp, random);
    if (!(start.flux_lm > 0)) return;
    Flight first;
    first.ray = start.ray, first.flux_lm = start.flux_lm, first.lamp = start;
    first.images =
        !mirrors_.empty() && lamp.part != Lamp::Part::sky && has_images(scene_, scene_.light[lamp.light]);
    if (!beyond) found.started_lm += start.flux_lm;
    std::vector<Flight> open{first};
    for (std::uint32_t turn = 0; turn < kMostTurns && !open.empty(); ++turn) {
      const Flight flight = open.back();
      open.pop_back();
      random.start_bounce(turn + 1);
      const bool hit = follow(flight, random, open, found);
      if (beyond && turn == 0 && hit) found.started_lm += start.flux_lm;
    }
  }

  /// Along one line, and all that leaves it. False: there is nothing on it.
  bool follow(Flight flight, RandomStream& random, std::vector<Flight>& open, Found& found) const {
    Way way(rays_, flight.ray);
    SurfacePoint point;
    bool hit = false;
    while (flight.flux_lm > kLeastLeft * flight.lamp.flux_lm && way.next(point)) {
      hit = true;
      const Bsdf bsdf = way.bsdf(point);
      const Vec3 wo = -flight.ray.direction;
      BsdfSample branch[2];
      const int branches = bsdf.specular_branches(wo, branch, TransportMode::flux);
      const bool sharp = bsdf.has_gloss() && lobe_[point.material] < kSharpLobe;
      const bool broad = bsdf.has_diffuse() || bsdf.transmits_diffusely() || (bsdf.has_gloss() && !sharp);
      if (flight.events > 0 && (broad || !bsdf.has_specular())) land(flight, point, found);
      if (sharp && flight.events < kMostEvents) send_gloss(flight, point, bsdf, random, open);
      double straight = 0;
      for (int b = 0; b < branches; ++b) {
        const double weight = grey(branch[b].weight);
        if (branch[b].straight)
          straight += weight;
        else if (flight.events < kMostEvents)
          send(flight, point, branch[b].direction, weight, deed_of(point, bsdf, branch[b]), open);
      }
      flight.flux_lm *= straight;
    }
    return hit;
  }

  Deed deed_of(const SurfacePoint& point, const Bsdf& bsdf, const BsdfSample& branch) const {
    using What = Deed::What;
    const bool flat = plane(point);
    Deed deed{flat ? What::mirror : What::curved_mirror, point.material, !flat || branch.transmitted};
    if (is_solid_glass(scene_.material[point.material]) || branch.transmitted)
      deed.what = flat ? What::glass : What::curved_glass;
    else if (bsdf.passes_straight())
      deed.what = flat ? What::pane : What::curved_glass;
    return deed;
  }

  void send(const Flight& from, const SurfacePoint& point, const Vec3& direction, double weight,
            const Deed& deed, std::vector<Flight>& open) const {
    if (!(weight * from.flux_lm > kLeastLeft * from.lamp.flux_lm)) return;
    Flight next = from;
    next.flux_lm *= weight;
    next.way_m += static_cast<double>(point.distance_m);
    next.ray = {point.leave(direction), direction};
    next.deed[next.events++] = deed;
    if (next.images) {
      const bool reflected = deed.what != Deed::What::gloss && !deed.bends;
      next.chain = reflected ? mirrors_.follow(next.chain, point.triangle, point.front) : MirrorPlanes::kNone;
      next.images = next.chain != MirrorPlanes::kNone;
    }
    open.push_back(next);
  }

  void send_gloss(const Flight& from, const SurfacePoint& point, const Bsdf& bsdf, RandomStream& random,
                  std::vector<Flight>& open) const {
    BsdfSample sample;
    if (!bsdf.sample_gloss(-from.ray.direction, random.uniform2(), sample)) return;
    send(from, point, sample.direction, grey(sample.weight), {Deed::What::gloss, point.material}, open);
  }

  const RayScene& rays_;
  const Scene& scene_;
  const MirrorPlanes& mirrors_;
  bool count_images_;
  LampProbe lamp_rays_;
  std::vector<double> lobe_;  // per material
};

LightWay way_of(const Scene& scene, const Lamp& lamp, LightWay::Kind kind, const Tally& tally,
                double started_lm) {
  LightWay way{lamp.name, kind, {}, {}, tally.flux_lm / started_lm, tally.flux_lm / tally.over_hit_share};
  std::vector<std::pair<double, Deed>> by;
  for (const auto& [deed, lm] : tally.by)
    if (lm >= kLeastNamed * tally.flux_lm) by.emplace_back(-lm, deed);
  std::sort(by.begin(), by.end());
  for (const auto& [lm, deed] : by) {
    const std::string& name = scene.material[deed.material].name;
    if (std::find(way.materials.begin(), way.materials.end(), name) == way.materials.end())
      way.materials.push_back(name);
    const std::string phrase = text(noun(deed.what), " \"", name, "\"");
    if (std::find(way.by.begin(), way.by.end(), phrase) == way.by.end()) way.by.push_back(phrase);
  }
  return way;
}

}  // namespace

const char* name_of(LightWay::Kind kind) {
  constexpr const char* kNames[] = {"mirrored", "bent", "gloss"};
  return kNames[static_cast<int>(kind)];
}

std::string by_text(const LightWay& way) {
  constexpr std::size_t kShown = 3;
  const std::size_t shown = std::min(kShown, way.by.size());
  std::string out;
  for (std::size_t i = 0; i < shown; ++i)
    out.append(i == 0 ? "" : i + 1 == way.by.size() ? " and " : ", ").append(way.by[i]);
  if (way.by.size() > shown) out += text(" and ", way.by.size() - shown, " more");
  return out;
}

std::string share_text(const LightWay& way) {
  constexpr double kDigits = 10;  // of a percent
  const double percent = std::round(100 * kDigits * way.share) / kDigits;
  return text(shortest(static_cast<float>(percent)), " % of lamp \"", way.lamp, "\" by way of ",
              by_text(way));
}

bool sends_light_on(const Scene& scene) {
  std::vector<char> used(scene.material.size());
  for (const Instance& instance : scene.instance)
    if (instance.triangle_count > 0) used[instance.material] = 1;
  for (std::uint32_t m = 0; m < scene.material.size(); ++m) {
    if (!used[m]) continue;
    const Material& material = scene.material[m];
    // At some of its texels it may be smooth.
    const bool by_texel = row_of(material).gltf_core && material.metallic_roughness.used();
    if (by_texel || lobe_hit_share(scene, material) < kSharpLobe || turns_light(scene, m)) return true;
  }
  return false;
}

std::vector<LightWay> light_ways(const RayScene& rays, const Luminaires& luminaires, bool images) {
  const Scene& scene = rays.scene();
  std::vector<LightWay> ways;
  const std::vector<Lamp> lamps = lamps_of(scene);
  if (lamps.empty() || !sends_light_on(scene)) return ways;
  const Finder finder(rays, luminaires, images);
  const auto even = static_cast<std::uint32_t>(kRaysOfAll / lamps.size());
  const std::uint32_t count = std::clamp(even, kLeastRaysOfALamp, kRaysOfALamp);
  for (const Lamp& lamp : lamps) {
    const Found found = finder.find(lamp, count);
    for (std::size_t k = 0; k < kKinds; ++k) {
      if (!(found.of[k].flux_lm > 0) || found.of[k].flux_lm < kLeastShare * found.started_lm) continue;
      ways.push_back(way_of(scene, lamp, static_cast<LightWay::Kind>(k), found.of[k], found.started_lm));
    }
  }
  return ways;
}

Json to_json(const std::vector<LightWay>& ways) {
  Json out = Json::Array{};
  for (const LightWay& way : ways) {
    Json item;
    item["lamp"] = way.lamp, item["way"] = name_of(way.kind);
    Json materials = Json::Array{}, by = Json::Array{};
    for (const std::string& name : way.materials) materials.push_back(name);
    for (const std::string& phrase : way.by) by.push_back(phrase);
    item["materials"] = materials, item["by"] = by;
    item["share"] = way.share, item["hit_share"] = way.hit_share;
    out.push_back(item);
  }
  return out;
}

std::vector<LightWay> light_ways_from(const Json& json) {
  std::vector<LightWay> ways;
  if (!json.is_array()) return ways;
  const auto word = [](const Json& item, const char* key) {
    const Json* value = item.find(key);
    return value && value->is_string() ? value->as_string() : std::string();
  };
  const auto number = [](const Json& item, const char* key) {
    const Json* value = item.find(key);
    return value && value->is_number() ? value->as_number() : 0;
  };
  const auto words = [](const Json& item, const char* key) {
    std::vector<std::string> out;
    const Json* list = item.find(key);
    if (!list || !list->is_array()) return out;
    for (const Json& value : list->as_array())
      if (value.is_string()) out.push_back(value.as_string());
    return out;
  };
  for (const Json& item : json.as_array()) {
    if (!item.is_object()) continue;
    LightWay way{word(item, "lamp"), LightWay::Kind::mirrored, words(item, "materials"),
                 words(item, "by"),  number(item, "share"),    number(item, "hit_share")};
    for (const LightWay::Kind kind : {LightWay::Kind::bent, LightWay::Kind::gloss})
      if (word(item, "way") == name_of(kind)) way.kind = kind;
    ways.push_back(way);
  }
  return ways;
}

}  // namespace phos::inline scene
