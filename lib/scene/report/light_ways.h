// The ways other than straight ones by which lamps can light surfaces: by mirrors, panes, curved glass and
// sharp gloss.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/json.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"

namespace phos::inline scene {

/// Light of a lamp that reaches surfaces by way of such materials alone (paths L S+ D of Heckbert 1990, and
/// L G S* D where the lobe G is sharp). Straight ways, through panes too, are none of these, nor are those
/// over flat mirrors in which lamps have images (scene/mirror/images.h): direct light holds them.
struct LightWay {
  enum class Kind : std::uint8_t {
    mirrored,  ///< by plane mirrors and by reflection at plane panes: images of the lamp
    bent,      ///< by curved mirrors and by glass that refracts: caustics
    gloss,     ///< by a lobe that is sharper than kSharpLobe, first of all
  };
  std::string lamp;  ///< as lamps_of() names it
  Kind kind = Kind::mirrored;
  std::vector<std::string> materials;  ///< names, in order of the light that they send
  std::vector<std::string> by;         ///< the same for people: mirror "wall"
  double share = 0;                    ///< of the lamp's flux; of what hits the scene, or comes through its
                                       ///< portals, where the lamp is infinitely far away
  /// Probability that a cosine-weighted direction from where this light arrives leads back to the lamp: its
  /// projected solid angle over pi, harmonic mean over the light; of a lobe, that solid angle of the lobe if
  /// it is larger. 0: a lamp without extent, which no such ray can hit.
  double hit_share = 0;
};
const char* name_of(LightWay::Kind kind);
/// mirror "wall" and pane "window"
std::string by_text(const LightWay& way);
/// 3.1 % of lamp "sun" by way of mirror "wall"
std::string share_text(const LightWay& way);

/// Is anything in the scene a mirror, smooth glass or sharp gloss? A film that lets light pass is none.
bool sends_light_on(const Scene& scene);

/// The ways of every lamp, lamp by lamp in the order of the scene, that carry kLeastShare of its light or
/// more. Tried with up to kRaysOfALamp rays from each, fewer where lamps are many, but kLeastRaysOfALamp:
/// the same for any number of threads. None, and no ray is sent, where nothing sends_light_on(). Light that
/// leaves the scene counts for nothing.
/// `images`: flat mirrors in which lamps have images count too.
std::vector<LightWay> light_ways(const RayScene& rays, const Luminaires& luminaires, bool images = false);
inline constexpr double kLeastShare = 1e-3;
inline constexpr std::uint32_t kRaysOfALamp = 4096, kLeastRaysOfALamp = 256;

/// [{"lamp":..,"way":"mirrored","materials":[..],"by":[..],"share":..,"hit_share":..}]
Json to_json(const std::vector<LightWay>& ways);
/// The inverse; entries that are no ways are passed over.
std::vector<LightWay> light_ways_from(const Json& json);

}  // namespace phos::inline scene
