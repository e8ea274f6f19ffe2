// Materials that reflect light into few directions, and whether a scene has any.
#pragma once

#include "scene/scene.h"

namespace phos::inline scene {

/// Does a material reflect light within a few degrees about one direction, or in that direction alone: a
/// mirror, smooth glass (a pane reflects too), gloss of a GGX or Ward roughness below 0.1, or of a Phong
/// exponent above 200? Roughness maps are left out: the material's own roughness counts. False for measured
/// tables.
bool reflects_sharply(const Material& material);

/// The same of a mirror, smooth glass, or a pane: is there a direction into which light goes as a ray, other
/// than straight on?
bool reflects_as_mirror(const Material& material);

/// Does a material reflect or refract light as a mirror or smooth glass does, its textures at their mean?
/// Films and sheets that pass light straight and reflect none do not.
bool turns_light(const Scene& scene, std::uint32_t material);
/// Share of light from 60 degrees off the normal that it turns so, of the colour that it turns most. About
/// 0.17 of a clear pane, nearly 1 of solid glass.
float turned_share(const Scene& scene, std::uint32_t material);
/// Does any material, so that light of a lamp can reach surfaces by way of mirrors or glass (caustic light)?
bool casts_caustics(const Scene& scene);

/// A lobe is sharp if a cosine-weighted ray falls into it, towards a lamp, with less than this probability:
/// so that 64 rays find it less than ten times. Of GGX: roughness alpha below 0.11.
inline constexpr double kSharpLobe = 10.0 / 64;
/// That probability: solid angle that would hold the lobe if it were even, 1 / integral of its square
/// density, over pi. 12 ax ay for GGX, 8 ax ay for Ward, 2 (2n + 1) / (n + 1)^2 for Phong; 1 for a material
/// without a lobe, and for measured ones.
double lobe_hit_share(const Scene& scene, const Material& material);

/// Is there a curved mirror, curved glass, or solid glass: something that gathers light, however small it is?
bool gathers_light(const Scene& scene);

/// Has the scene light that reaches a diffuse surface by way of a mirror, of glass that bends or reflects it,
/// or of sharp gloss? Path tracing finds such light only where its paths hit a lamp by chance, and light
/// of point lamps not at all. True wherever there is a lamp and a material that reflects_sharply().
bool has_caustic_ways(const Scene& scene);

}  // namespace phos::inline scene
