// Direct light of which neighbouring pixels share the shadow rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scene/lamp/luminaires.h"
#include "splat/direct/lamp_rays.h"
#include "splat/gbuffer.h"

namespace phos::inline splat {

/// Of a pixel's rays to a lamp with an area.
struct RayShare {
  int rays = 1;    ///< of this pass, at least 1
  int pass = 0;    ///< of which this is the one, from 0: which part of the set it gets
  int passes = 1;  ///< samples of a pixel in all
  /// Per pixel, how often the number of its rays is doubled; empty: never. The way in which pixels take
  /// results of others goes by the rays before that: twice the rays then always have less noise.
  std::span<const std::uint8_t> doublings{};
};

/// Interleaved sampling (Keller and Heidrich 2001): the pixels of each 4 x 4 block send different rays of one
/// low-discrepancy set towards a lamp with an area, and each pixel takes the results of the 25 pixels about
/// it that show its own surface. Of a lamp with a closed form (LampForm) the result is the visible share: no
/// noise where the lamp is seen whole, or not at all; of others, the mean light. One ray each, or one in 16,
/// shows where a shadow's edge may be; there each pixel sends all of its `share.rays`. The result about a
/// pixel is drawn towards the results of nearer pixels and its own where these differ by more than noise
/// (James and Stein 1961), so that shadows blur by no more than noise would hide. A pixel takes its own alone
/// where they know the share to 1 %, or are 64 in all of passes of fewer than 16 each (of a lamp without
/// closed form: 4096, of which 16 are of each pass). So the error goes to zero with more rays, but for
/// shadows that the rays which look for them miss: of a lamp seen almost whole, or almost not, up to 1.5 % of
/// the lamp, and nothing where passes have one ray. The light of one pass may lie a little below 0. The
/// variance of a mean is the variance by independent rays times the share that is left, as pixels 4 apart
/// show, whose rays go to one part of the lamp. Lamps without an area: one ray, not shared. One entry per
/// pixel; zero where nothing is visible. Same bytes for any number of threads.
std::vector<SharedLight> interleaved_light(const RayScene& rays, const Luminaires& lights,
                                           const GBuffer& gbuffer, const PixelRays& pixel_rays,
                                           const Vec2& subpixel, const RayShare& share, std::uint64_t seed);

}  // namespace phos::inline splat
