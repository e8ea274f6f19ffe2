// Light of the environment, looked for through the openings that a point sees.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scene/environment.h"
#include "scene/portal_piece.h"
#include "scene/portal_sight.h"

namespace phos {

/// Directions for a point that sees little of the environment: uniform over the solid angle of a portal,
/// chosen by about the light that comes through it to that place; towards the sun, where a portal lies before
/// it; and one in ten (one in two of a map with bright spots) as Environment::sample() has them, so that no
/// light is lost that comes by another way. One density of all of them: unbiased whatever the portals. Const,
/// usable from any thread.
class PortalLight {
 public:
  /// The environment must outlive it.
  /// `sight`: of these portals; null: all are seen from everywhere.
  PortalLight(const Environment& light, std::span<const Portal> portals,
              std::shared_ptr<const PortalSight> sight);

  /// Steered by `u` alone, piece by piece: strata of `u` are strata of each. Where no portal is seen from the
  /// front, as Environment::sample().
  Environment::Sample sample(const Vec3& from, const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction.
  float density(const Vec3& from, const Vec3& direction) const;
  /// Illuminance on a surface that faces what light there is, roughly, lx: through the portals, or from all
  /// around.
  float promise_lx(const Vec3& from) const;

 private:
  struct Chances {
    float sun = 0, stray = 1;
    float portals = 0;               // sum of the promises of the pieces, lx
    std::span<const float> promise;  // of each piece; good until the thread asks again
  };
  Chances chances(const Vec3& from) const;
  float promise_lx(const PortalPiece& piece, const Vec3& from) const;
  static std::size_t choose(const Chances& c, float u, float& rest);
  Environment::Sample sample_of(const Vec3& from, const Vec3& direction, const Chances& c,
                                const PortalPiece* certain) const;
  float density(const Vec3& from, const Vec3& direction, const Chances& c, const PortalPiece* certain) const;

  const Environment* light_;
  std::shared_ptr<const PortalSight> sight_;
  std::vector<PortalPiece> piece_;
  float least_cd_m2_ = 0;  // a piece is not taken for darker
  float stray_ = 0;
};

}  // namespace phos
