// A scene of RGB becomes one of bands.
#pragma once

#include "scene/scene.h"
#include "scene/spectral/band_options.h"

namespace phos::inline scene {

/// Before finalize(): every colour of the scene becomes its three values in the triplet's bands (bands.h).
///   - A reflectance with a spectrum: kd of lambert, phong, ward, plastic and metallic-roughness, ks of
///     mirrors, f0 of conductors. Measured data and glass have none of their own to replace.
///   - Light with a spectrum keeps its lumens, lx or cd; its colour is the spectrum's.
///   - All else, textures, vertex colours, f0 of metals and measured data among them, is upsampled
///     (scene/spectral/reflectance.h) each on its own; factors that were multiplied in RGB are multiplied in
///     bands. White light is D65. Where kd + ks of phong and ward would come out above 1, kd is cut; this is
///     counted.
/// Throws Error(usage) for a name that is in the scene not at all or twice, Error(bad_input) for a spectrum
/// that cannot be read, or a reflectance whose data hold nothing of a lamp's light.
void to_bands(Scene& scene, const BandOptions& options);

}  // namespace phos::inline scene
