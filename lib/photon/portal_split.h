// Light that is scattered outside of rooms and goes on through portals, in photons of like flux.
#pragma once

#include <span>
#include <vector>

#include "core/random.h"
#include "scene/material/bsdf.h"
#include "scene/opening/portal_piece.h"

namespace phos::inline photon {

/// Few of the environment's paths that are not aimed at portals meet one after they were scattered by the
/// ground or a house opposite, and they carry thousands of times as much as those that are aimed. In place of
/// one that goes through a portal straight from where it was scattered, several are sent there, each of about
/// the flux of an aimed one.
class PortalSplit {
 public:
  /// `unit_lm`: luminous flux of an aimed photon, lm.
  PortalSplit(std::span<const Portal> portals, double unit_lm);

  /// Distance at which a ray first crosses a portal the way that light counts, m; infinity: it crosses none.
  float first_crossing_m(const Vec3& origin, const Vec3& direction) const;

  struct Child {
    Vec3 direction{0};
    Rgb weight{0};  ///< of the flux that met the surface
  };
  /// Children of the light that meets a surface from wo with `flux_lm`, in place of the light that is
  /// scattered towards portals: the expected sum of their weights is the light that the surface scatters
  /// there. Draws from `random`.
  void children(const SurfacePoint& point, const Bsdf& bsdf, const Vec3& wo, const Rgb& flux_lm,
                RandomStream& random, std::vector<Child>& out) const;

 private:
  std::vector<PortalPiece> piece_;
  double unit_lm_;
};

}  // namespace phos::inline photon
