// Direct light of which neighbouring pixels share the shadow rays.
#pragma once

#include <vector>

#include "cache/shading.h"
#include "splat/gbuffer.h"

namespace phos {

/// Illuminance of a diffuse visible surface, and the variance of that, lx and lx^2.
struct SharedLight {
  Rgb illuminance{0}, variance{0};
};

/// Interleaved sampling (Keller and Heidrich 2001): the pixels of each 4 x 4 block send different rays of one
/// low-discrepancy set towards a lamp, `rays` each, and each pixel takes the mean over the 16 about it of
/// those that show its own surface (same material, normals within 6 degrees, one plane). The noise is that of
/// 16 times the rays; a shadow's edge is blurred over 4 pixels, which is its price. `pass` of `passes` picks
/// the part of the set that this sample of the pixels gets. One entry per pixel; zero where nothing is
/// visible.
std::vector<SharedLight> interleaved_light(const RayScene& rays, const Shading& shading,
                                           const GBuffer& gbuffer, const PixelRays& pixel_rays,
                                           const Vec2& subpixel, int lamp_rays, int pass, int passes,
                                           std::uint64_t seed);

}  // namespace phos
