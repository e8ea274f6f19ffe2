// Direct light of the samples of a pixel in which surfaces meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "splat/direct/lamp_rays.h"

namespace phos::inline splat {

/// Samples of one pixel that show one diffuse surface.
struct EdgeSamples {
  std::size_t pixel = 0;
  std::uint32_t number = 0;  ///< of the surface within the pixel
  std::span<const Ray> ray;  ///< of all samples of the pixel
  std::span<const Hit> hit;
  std::span<const std::uint32_t> sample;  ///< those that show the surface, in order; at least one
  int doublings = 0;                      ///< of the rays of each
};

/// They share their shadow rays: of a lamp with a closed form (LampForm) the share that they see, of
/// others the mean of the light that rays brought. The first of them test the result of a pixel about them
/// that shows the same surface: shadows may be narrower than the pixel. Const, usable from any thread; holds
/// references.
class EdgeLight {
 public:
  /// `rays_each`: from a sample to each lamp with an area.
  EdgeLight(const RayScene& rays, const Luminaires& lights, int rays_each, std::uint64_t seed);

  struct Scratch {
    std::vector<LampVisibility> sight;  // per lamp
    std::vector<Brought> brought;       // per lamp
    std::vector<float> whole, first;    // per lamp: projected solid angle, mean and of one sample
    std::vector<std::uint32_t> shift;
  };
  /// Light of all samples. Where the first of them find `about`, the light of the pixel about them (null:
  /// none), no more rays are sent. The variance is a sample's, such that the sum of as many independent
  /// samples has the variance of the sum of these, which share their rays. It is not zero where all rays
  /// agree, for they may have missed something.
  SharedLight light(const EdgeSamples& samples, const SharedLight* about, Scratch& scratch) const;

 private:
  void send(const EdgeSamples& samples, std::size_t begin, std::size_t end, Scratch& scratch) const;
  float find_whole(const EdgeSamples& samples, std::span<const std::uint32_t> some, Scratch& scratch) const;
  SharedLight sum(const Scratch& scratch) const;

  AimedLamps lamps_;
  int rays_each_;
  std::uint64_t seed_;
};

}  // namespace phos::inline splat
