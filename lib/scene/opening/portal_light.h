// Light of the environment, looked for through the openings that a point sees.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "scene/opening/blind.h"
#include "scene/opening/portal_piece.h"
#include "scene/opening/portal_sight.h"
#include "scene/sky/environment.h"

namespace phos::inline scene {

/// Directions for a point that sees little of the environment: uniform over the solid angle of a portal, or
/// of a gap of a blind, chosen by about the light that comes through it to that place (through portals behind
/// blinds a tenth as often as through their gaps); towards the sun, where a portal lies before it; and one in
/// ten (one in two of a map with bright spots) as Environment::sample() has them, so that no light is lost
/// that comes by another way. One density of all of them: unbiased whatever the portals. Const, usable from
/// any thread.
class PortalLight {
 public:
  /// The environment must outlive it.
  /// `sight`: of these portals; null: all are seen from everywhere. The blinds are copied.
  PortalLight(const Environment& light, std::span<const Portal> portals,
              std::shared_ptr<const PortalSight> sight, std::span<const Blind> blinds = {});

  /// Steered by `u` alone, piece by piece: strata of `u` are strata of each. Where no portal is seen from the
  /// front, as Environment::sample().
  Environment::Sample sample(const Vec3& from, const Vec2& u) const;
  /// Density per sr with which sample() chooses a direction.
  float density(const Vec3& from, const Vec3& direction) const;
  /// Illuminance on a surface that faces the light, roughly, lx: through the portals, or from all
  /// around.
  float promise_lx(const Vec3& from) const;

 private:
  struct SeenGap {
    const Blind* blind = nullptr;
    Blind::Gap gap;
  };
  struct Chances {
    float sun = 0, stray = 1;
    float sum = 0;  // of the promises, lx
    // Of each piece, then of each gap that is seen; good until the thread asks again.
    std::span<const float> promise;
    std::span<const SeenGap> gap;
  };
  static constexpr std::size_t kNone = ~std::size_t{0};
  Chances chances(const Vec3& from) const;
  float promise_lx(const PortalPiece& piece, const Vec3& from) const;
  float promise_lx(const SeenGap& seen) const;
  void prefer_gaps(const Vec3& from, std::vector<float>& promise) const;
  float share_behind_blinds(const PortalPiece& piece, const Vec3& from) const;
  static std::size_t choose(const Chances& c, float u, float& rest);
  /// `certain`: of the promises; the direction goes through that one, whatever its rounding says.
  Environment::Sample sample_of(const Vec3& from, const Vec3& direction, const Chances& c,
                                std::size_t certain) const;
  float density(const Vec3& from, const Vec3& direction, const Chances& c, std::size_t certain) const;

  const Environment* light_;
  std::shared_ptr<const PortalSight> sight_;
  std::vector<PortalPiece> piece_;
  std::vector<Blind> blind_;
  float least_cd_m2_ = 0;  // a piece is not taken for darker
  float stray_ = 0;
};

}  // namespace phos::inline scene
