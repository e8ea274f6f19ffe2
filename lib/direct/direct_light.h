// Light straight from the lamps at a point.
#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "core/sequence_error.h"
#include "scene/lamp/luminaires.h"
#include "scene/rays.h"
#include "scene/receiver.h"

namespace phos::inline direct {

/// One visible sample of a lamp.
struct LampSample {
  Vec3 direction{0};             ///< unit, towards the lamp
  float distance_m = kInfinity;  ///< infinity: a directional light or the environment
  Vec3 normal{0};     ///< of the lamp's surface, on the side that shines; minus direction for lamps without
  Rgb irradiance{0};  ///< its contribution: cosine, density and number of samples included; they sum to E, lx
  std::uint32_t light = 0;
  std::uint32_t number = 0;   ///< of this sample among the light's, from 0
  std::int32_t mirrors = -1;  ///< chain of flat mirrors that the light came over (MirrorPlanes); -1: none
  PointOrder::Kind points = PointOrder::Kind::r2;  ///< that the light's samples are
};

/// Samples of every lamp that can be seen from the receiver, straight or through panes: `samples`
/// low-discrepancy ones of each area light and of the environment, one of each other; and the same of the
/// images that lamps have in flat mirrors. Replaces `out`.
void sample_lamps(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver, int samples,
                  RandomStream& random, std::vector<LampSample>& out);
/// A light, and the number of its samples.
struct LightSamples {
  std::uint32_t light = 0;
  int samples = 0;  ///< 0: none; of a light without extent never more than one
};

/// Samples of the lights that `counts` names, as sample_lamps() above. Area lights that a point of the square
/// alone chooses (Luminaires::by_u_alone()) are sampled by `points`. Sobol' points in sets of 4^k err less
/// than as many of R2 (256 on a rectangle that is near: a third), and their stated error is the true one or
/// more from 64 on, the one of R2 only from 96 on.
void sample_lamps(const RayScene& rays, const Luminaires& lights, const SurfacePoint& receiver,
                  std::span<const LightSamples> counts, PointOrder::Kind points, RandomStream& random,
                  std::vector<LampSample>& out);

/// Points by which light i is sampled where `wanted` are: these points, or the points that its kind takes.
PointOrder::Kind points_of(const Scene& scene, const Luminaires& lights, std::size_t i,
                           PointOrder::Kind wanted);

/// Sum of such samples of one point, and its variance by channel (sequence_variance), which is the variance
/// of the samples of lights with an extent.
struct LampSum {
  DVec3 irradiance{0}, variance{0};  ///< lx, lx^2
};
LampSum sum_of(std::span<const LampSample> lamps, int samples, const Luminaires& lights);
/// sum_of() the samples of each light counts[k], its images in mirrors included.
std::vector<LampSum> sums_of(std::span<const LampSample> lamps, std::span<const LightSamples> counts,
                             const Luminaires& lights);

/// Their irradiance alone, lx.
DVec3 light_of(std::span<const LampSample> lamps);

struct DirectIrradiance {
  Rgb irradiance{0};  ///< lx
  Rgb stderr_lx{0};   ///< root of LampSum::variance
};
DirectIrradiance direct_irradiance(const RayScene& rays, const Luminaires& lights,
                                   const SurfacePoint& receiver, int samples, RandomStream& random);

}  // namespace phos::inline direct
