// Limits of scenes and pictures of them: see core/facts/limit.h.
#pragma once

#include "core/facts/limit.h"

namespace phos::inline scene {

inline constexpr Limit kMostVertices{"vertices of a scene", 0x7fffffff, "exit code 3"};
inline constexpr Limit kMostPictureSide{"pixels of a side of a picture (`--width`, `--height`)", 65536,
                                        "exit code 2"};
inline constexpr Limit kMostPicturePixels{"pixels of a picture", 1 << 28, "exit code 2"};
inline constexpr Limit kMostTextureSide{"pixels of a side of a texture", 1 << 15,
                                        "a warning; the material's factor is used alone"};
inline constexpr Limit kMostTexturePixels{"pixels of a texture", 1 << 26,
                                          "a warning; the material's factor is used alone"};
inline constexpr Limit kMostPhotometryAngles{"planes of a EULUMDAT file, and angles in each", 100000,
                                             "exit code 3"};
inline constexpr Limit kMostMirrorPlanes{
    "planes of flat mirrors and panes in which direct light looks for images of lamps", 32,
    "the planes of least area and reflectance are left to photons"};
inline constexpr Limit kMostMirrorChains{"chains of reflections over planes of flat mirrors and panes", 256,
                                         "the chains of least light are left to photons"};
inline constexpr Limit kMostSlats{"slats of the blinds that phos finds by their shape", 4096,
                                  "no blind is found; `--portals` names the openings"};

inline constexpr const Limit* kSceneLimits[] = {
    &kMostVertices,         &kMostPictureSide,  &kMostPicturePixels, &kMostTextureSide, &kMostTexturePixels,
    &kMostPhotometryAngles, &kMostMirrorPlanes, &kMostMirrorChains,  &kMostSlats};

}  // namespace phos::inline scene
