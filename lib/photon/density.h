// Irradiance from photons: density estimation on the tangent plane, free of maps and scenes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/vector.h"
#include "photon/hull.h"

namespace phos::inline photon {

/// Is the tangent plane at this offset from the zone's centre (m) on the surface that is measured? Empty:
/// everywhere.
using OnSurface = std::function<bool(const Vec2& offset_m)>;

/// Which estimator (docs/methods.md#c2) the photons of a zone called for.
enum class ZoneKind : std::uint8_t {
  few,     ///< too few photons, or all on a line: sum of flux over the surface in the zone
  full,    ///< lit everywhere: the same (it has the smallest variance)
  hull,    ///< a border, a shadow edge or a hole: photons strictly inside the hull, over the hull's area
           ///< (docs/methods.md#c1)
  dark,    ///< the centre lies in the dark beside a lit region: zero
  kernel,  ///< kernel_irradiance
};

/// Weight of a photon by its distance r from the middle of a disc of radius R (docs/methods.md#c4). Each
/// integrates to one over the disc.
enum class Kernel {
  disc,          ///< 1/(pi R2): all alike
  epanechnikov,  ///< 2/(pi R2) (1 - r2/R2)
  cone,          ///< 3/(pi R2) (1 - r/R)
};

struct DensityOptions {
  int probes = 256;  ///< geometry probes where a zone is in doubt
  int few = 16;      ///< below this the hull is not used
  double dark_photons =
      4.6;                  ///< photons missed between hull and centre that make the centre dark (1 % chance)
  bool centre_lit = false;  ///< a photon landed at the centre itself: it is not dark
};

struct ZoneEstimate {
  ZoneKind kind = ZoneKind::few;
  Rgb irradiance{0};      ///< lx, mean over the area
  Rgb stderr_lx{0};       ///< from the Poisson photons and the probed area
  double area_m2 = 0;     ///< divides the flux; dark: the empty surface between centre and hull
  double area_error = 0;  ///< relative standard error of area_m2 from the probes
  Vec2 centroid_m{0};     ///< of that area, from the zone's centre: where `irradiance` holds to first order
  float edge_m = kInfinity;  ///< distance to the nearest edge of the lit region if surface goes on beyond it
  bool degenerate = false;   ///< enough photons, but no hull
  bool clustered = false;    ///< far from uniform: a smaller zone is called for (docs/methods.md#c3)
  bool probed = false;
  bool centred = true;   ///< the centre is within the area: no border of the lit region leaves it out
  bool partial = false;  ///< part of the disc, or of the hull, is not surface
};

/// Memory kept from zone to zone. `used` tells which photons the estimate counted (others are hull vertices).
struct DensityScratch {
  Hull hull;
  std::vector<std::uint8_t> used;
  std::vector<std::uint8_t> covered;
};

/// Irradiance in a disc of `radius_m` about the origin. `offsets_m` are the photons in it without the one
/// that the zone was centred on; `flux_lm` is per unit of tangent-plane area. No photon: zero, its error too
/// (the caller knows the flux of one photon). Never returns a value that is not finite for finite input.
ZoneEstimate zone_irradiance(std::span<const Vec2> offsets_m, std::span<const Rgb> flux_lm, float radius_m,
                             const OnSurface& on_surface, const DensityOptions& options,
                             DensityScratch& scratch);

/// The classical estimate: flux under a kernel, over the whole disc of `radius_m` as if all of it were lit
/// surface. That is wrong at borders and shadow edges (at a straight border half of the light is lost); it
/// is here for comparison. Where `radius_m` is the distance of the k-th photon, that photon must not be
/// among them: the k - 1 nearer ones give the (k - 1)/(pi r_k^2) that has no bias (docs/methods.md#c4). Error
/// of Poisson photons.
ZoneEstimate kernel_irradiance(std::span<const Vec2> offsets_m, std::span<const Rgb> flux_lm, float radius_m,
                               Kernel kernel, DensityScratch& scratch);

/// Weight of a kernel relative to the weight of the disc, at a distance of `r` radii (0 to 1): its mean over
/// the disc is 1.
double kernel_weight(Kernel kernel, double r);

/// Fraction of a disc that lies beyond a chord at signed distance h (in radii) from the centre.
double cap_fraction(double h);

/// Mean distance to the surroundings from photons, m (docs/methods.md#c6): harmonic, weighted by solid angle
/// over the cells of a 4 x 13 grid (by flux below 50 photons), and never more than the flux-weighted one.
/// `directions` are local (z = normal), `weights` any measure of flux. Infinity if there is none, or if all
/// come from infinitely far.
float mean_distance_m(std::span<const Vec3> directions, std::span<const float> weights,
                      std::span<const float> distances_m);

}  // namespace phos::inline photon
