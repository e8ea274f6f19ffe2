// Direct light of which neighbouring pixels share the shadow rays.
#pragma once

#include <vector>

#include "scene/luminaires.h"
#include "splat/gbuffer.h"
#include "splat/lamp_rays.h"

namespace phos {

/// Interleaved sampling (Keller and Heidrich 2001): the pixels of each 4 x 4 block send different rays of one
/// low-discrepancy set towards a lamp with an area, and each pixel takes what the 25 about it that show its
/// own surface found. Of a lamp with a closed form (LampForm) that is the share of it that is visible: no
/// noise where it is seen whole, or not at all; of others, their mean. One ray each shows where a shadow's
/// edge may be; there each pixel sends `lamp_rays` in all. Shadows are blurred over 4 pixels, which is the
/// price. Lamps without an area: one ray, not shared. `pass` picks the part of the set that this sample of
/// the pixels gets. One entry per pixel; zero where nothing is visible. Same bytes for any number of threads.
std::vector<SharedLight> interleaved_light(const RayScene& rays, const Luminaires& lights,
                                           const GBuffer& gbuffer, const PixelRays& pixel_rays,
                                           const Vec2& subpixel, int lamp_rays, int pass, std::uint64_t seed);

}  // namespace phos
